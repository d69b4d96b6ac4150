// The mesh of a container: watertight, exact in area and volume, of good shape, and what it refuses.

#include "geocontainer_mpm/geotextile/mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "fixture.h"
#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::geotextile::testing {
namespace {

SheetLayout ellipse(double half_width, double half_height, int corners = 720)
{
  SheetLayout outline;
  outline.closed = true;
  for (int k = 0; k < corners; ++k)
    outline.points.emplace_back(half_width * std::cos(2.0 * pi * k / corners),
                                half_height * std::sin(2.0 * pi * k / corners));
  return outline;
}

/// Somewhere, with corners, some of them pointing inwards; either sense.
SheetLayout jagged(Chance& chance)
{
  SheetLayout outline;
  outline.closed = true;
  const Vec2 middle = chance.vector<2>(5.0);
  const int corners = chance.whole(5, 12), sense = chance.whole(0, 1) == 0 ? 1 : -1;
  for (int k = 0; k < corners; ++k) {
    const double angle = sense * 2.0 * pi * (k + chance(0.0, 0.5)) / corners, r = chance(0.8, 1.2);
    outline.points.emplace_back(middle + r * Vec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

double volume(const TriangleMesh& mesh)
{
  double six = 0.0;
  for (const Triangle& t : mesh.triangles)
    six += (mesh.points[t[0]] - mesh.points[0])
               .cross(mesh.points[t[1]] - mesh.points[0])
               .dot(mesh.points[t[2]] - mesh.points[0]);
  return six / 6.0;
}

double area(const TriangleMesh& mesh, Panel panel)
{
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += mesh.panel[t] == panel ? mesh.area(t) : 0.0;
  return sum;
}

/// Degrees.
double smallest_angle(const TriangleMesh& mesh)
{
  double smallest = 180.0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]],
                 b = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / pi);
    }
  return smallest;
}

/// Sides of triangles, with how often each is walked forth less how often back.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides(const TriangleMesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> all;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      all[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return all;
}

/// The section as meshed: the first row of the wall.
std::vector<Vec2> section(const TriangleMesh& mesh)
{
  std::vector<Vec2> points;
  for (const Vec3& p : mesh.points)
    if (points.empty() || p[0] == mesh.points[0][0])
      points.emplace_back(p[1], p[2]);
    else
      break;
  return points;
}

struct Measures {
  double area = 0.0, perimeter = 0.0;
};
Measures measures(const std::vector<Vec2>& points, bool closed)
{
  Measures m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 a = points[i] - points[0], b = points[(i + 1) % points.size()] - points[0];
    m.area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    if (closed || i + 1 < points.size())
      m.perimeter += (b - a).norm();
  }
  return { std::abs(m.area), m.perimeter };
}

TEST(Mesh, OfAClosedContainerIsWatertightAndExact)
{
  EXPECT_TRUE(holds("watertight", [](Chance& chance) {
    const SheetLayout outline = jagged(chance);
    const Along along{ -1.0, chance(0.0, 3.0) };
    const TriangleMesh mesh = wrap(outline, along, { true, true }, chance(0.12, 0.4));
    const auto all = sides(mesh);
    for (const auto& [side, balance] : all)
      RC_ASSERT(balance == 0);  // once forth and once back, or the sum of sides below fails
    RC_ASSERT(2 * all.size() == 3 * mesh.triangles.size());
    RC_ASSERT(mesh.points.size() + mesh.triangles.size() == all.size() + 2);  // Euler's formula
    RC_ASSERT(mesh.closed);
    const Measures m = measures(section(mesh), true);
    const double length = along.to - along.from;
    RC_ASSERT(std::abs(volume(mesh) - m.area * length) < 1e-12 * (1.0 + length));
    RC_ASSERT(std::abs(area(mesh, Panel::wall) - m.perimeter * length) < 1e-11);
    RC_ASSERT(std::abs(area(mesh, Panel::aft_end) - m.area) < 1e-12);
    RC_ASSERT(std::abs(area(mesh, Panel::bow_end) - m.area) < 1e-12);
  }));
}

TEST(Mesh, HasUnitYarnsInItsTrianglesAndTheClothOfItsOutline)
{
  EXPECT_TRUE(holds("yarns", [](Chance& chance) {
    SheetLayout outline = jagged(chance);
    for (std::size_t i = 0; i < outline.sides(); ++i)
      outline.fullness.push_back(chance(1.0, 2.0));
    const Fullness fullness{ chance(0.9, 1.5), chance(0.9, 1.1), chance(0.9, 1.5) };
    const double length = chance(0.5, 2.0);
    const TriangleMesh mesh = wrap(outline, { 0.0, length }, { true, false }, chance(0.12, 0.4), fullness);
    double cloth = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Vec3 normal = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
      for (const Vec3& yarn : { mesh.warp[t], mesh.weft[t] }) {
        RC_ASSERT(std::abs(yarn.norm() - 1.0) < 1e-14);
        RC_ASSERT(std::abs(yarn.dot(normal)) < 1e-12);
      }
      RC_ASSERT(std::abs(mesh.warp[t].dot(mesh.weft[t])) < 1e-14);
      if (mesh.panel[t] == Panel::wall)
        cloth += mesh.area(t) * mesh.fullness[t][0] * mesh.fullness[t][1];
      else
        RC_ASSERT(mesh.fullness[t] == (std::array<double, 2>{ fullness.ends, fullness.ends }));
    }
    const double exact = outline.cloth_length() * length * fullness.around * fullness.along;
    RC_ASSERT(std::abs(cloth - exact) < 1e-11 * exact);
  }));
}

TEST(Mesh, OfHalfASectionEndsOnItsPlaneOfSymmetry)
{
  SheetLayout half = ellipse(2.0, 1.0);
  std::rotate(half.points.begin(), half.points.begin() + 540, half.points.end());  // from below
  half.points.resize(361);
  half.points.front()[0] = half.points.back()[0] = 0.0;
  half.closed = false;
  const TriangleMesh mesh = wrap(half, { 0.0, 3.0 }, { false, true }, 0.2);
  std::set<std::uint32_t> edge;
  for (const auto& [side, balance] : sides(mesh))
    if (balance != 0)
      edge.insert({ side.first, side.second });
  for (const std::uint32_t i : edge)
    EXPECT_TRUE(mesh.points[i][0] == 0.0 || mesh.points[i][1] == 0.0) << mesh.points[i].transpose();
  const Measures m = measures(section(mesh), false);
  EXPECT_NEAR(area(mesh, Panel::bow_end), m.area, 1e-12);
  EXPECT_NEAR(area(mesh, Panel::wall), 3.0 * m.perimeter, 1e-12);
  EXPECT_NEAR(m.area, pi, 0.02 * pi);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 out = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    EXPECT_GT(out.dot((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0), 0.0) << t;  // convex about 0
  }
}

TEST(Mesh, InnerPointsOfTheWallHaveSixTrianglesOfTheSameArea)
{
  const TriangleMesh mesh = wrap(ellipse(1.0, 1.0), { 0.0, 2.0 }, {}, 2.0 * pi / 24.0);
  std::vector<int> triangles(mesh.points.size(), 0);
  std::vector<double> around(mesh.points.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t i : mesh.triangles[t]) {
      ++triangles[i];
      around[i] += mesh.area(t);
    }
  ASSERT_EQ(mesh.points.size(), 24U * 9U);
  for (std::size_t i = 24; i < 24U * 8U; ++i) {
    EXPECT_EQ(triangles[i], 6);
    EXPECT_NEAR(around[i], around[24], 1e-12);
  }
}

TEST(Mesh, IsOfGoodShape)
{
  struct Row {
    double half_width, half_height, segment, least_deg;
  };
  // Squares halved have 45 degrees; between rings, one of which has fewer points, and at the middle of a flat section
  // there is less.
  for (const Row& row : { Row{ 1.0, 1.0, 0.1, 25.0 }, Row{ 1.0, 1.0, 0.05, 25.0 }, Row{ 2.0, 1.0, 0.1, 15.0 },
                          Row{ 3.0, 1.0, 0.1, 10.0 } }) {
    const double smallest =
        smallest_angle(wrap(ellipse(row.half_width, row.half_height), { 0.0, 1.0 }, { true, true }, row.segment));
    EXPECT_GT(smallest, row.least_deg) << row.half_width << " x " << row.half_height << ", " << row.segment;
    RecordProperty("angle", std::to_string(smallest));
  }
}

TEST(Mesh, OfAnOutlineThatItsMiddleDoesNotSeeHasNoEnds)
{
  SheetLayout bent{ { { 0.0, 0.0 }, { 3.0, 0.0 }, { 3.0, 0.5 }, { 0.5, 0.5 }, { 0.5, 3.0 }, { 0.0, 3.0 } }, true };
  EXPECT_NO_THROW(wrap(bent, { 0.0, 1.0 }, {}, 0.1));
  try {
    wrap(bent, { 0.0, 1.0 }, { true, false }, 0.1);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("star-shaped"), std::string::npos) << error.what();
  }
  EXPECT_THROW(wrap(bent, { 1.0, 1.0 }, {}, 0.1), InputError);
}

}  // namespace
}  // namespace geocontainer_mpm::geotextile::testing
