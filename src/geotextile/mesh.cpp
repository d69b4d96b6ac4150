#include "geocontainer_mpm/geotextile/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::geotextile {
namespace {

std::string text(const Vec2& point)
{
  return "(" + std::to_string(point[0]) + ", " + std::to_string(point[1]) + ")";
}

double cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// Points of a line, closed or not, and where each is as a part of its length.
struct Ring {
  std::vector<std::uint32_t> point;
  std::vector<double> part;  ///< per point, 0 to 1; one more, 1, at the end of a closed ring
  bool closed = false;

  std::size_t sides() const { return part.size() - 1; }
  std::uint32_t at(std::size_t i) const { return point[i < point.size() ? i : 0]; }
};

std::vector<double> parts_of(const SheetLayout& line)
{
  std::vector<double> part{ 0.0 };
  for (std::size_t i = 0; i < line.sides(); ++i)
    part.push_back(part.back() + (line.points[(i + 1) % line.points.size()] - line.points[i]).norm());
  for (double& p : part)
    p /= part.back();
  return part;
}

/// The middle of a closed end: the centroid; of half a section that of the whole, on its plane of symmetry.
Vec2 inner_point(const SheetLayout& line)
{
  double twice = 0.0;
  Vec2 moment = Vec2::Zero();
  const Vec2& origin = line.points.front();
  for (std::size_t i = 0; i < line.sides(); ++i) {
    const Vec2 a = line.points[i] - origin, b = line.points[(i + 1) % line.points.size()] - origin;
    twice += cross(a, b);
    moment += cross(a, b) * (a + b) / 3.0;
  }
  const Vec2 centroid = moment / twice;
  if (line.closed)
    return origin + centroid;
  const Vec2 plane = (line.points.back() - origin).normalized();
  return origin + centroid.dot(plane) * plane;
}

/// Twice the area inside, positive against the clock; of an open line together with its chord.
double twice_area(const SheetLayout& line)
{
  double twice = 0.0;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    twice +=
        cross(line.points[i] - line.points.front(), line.points[(i + 1) % line.points.size()] - line.points.front());
  return twice;
}

void require_star_shape(const SheetLayout& line, const Vec2& middle, double sense)
{
  for (std::size_t i = 0; i < line.sides(); ++i) {
    const Vec2 a = line.points[i] - middle, b = line.points[(i + 1) % line.points.size()] - middle;
    if (!(sense * cross(a, b) > 0.0))
      throw InputError("", "outline", "",
                       "with closed ends must be star-shaped about its inner point " + text(middle) +
                           ", which does not see the side at " + text(line.points[i]));
  }
}

/// Rings have fewer corners than the outline; their chords may cut across a sharp one that points inwards.
void require_no_overlap(const TriangleMesh& mesh, double segment_length)
{
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.panel[t] == Panel::wall)
      continue;
    const auto [a, b, c] = mesh.triangles[t];
    const double x = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a])[0];
    if (!((mesh.panel[t] == Panel::bow_end ? x : -x) > 0.0))
      throw InputError("", "segment_length", std::to_string(segment_length),
                       "must be shorter for the closed ends of an outline with corners as sharp as these");
  }
}

/// As divide(), with an open line's last point as it is: on its plane of symmetry, without round-off.
SheetLayout divided(const SheetLayout& line, std::size_t sides)
{
  SheetLayout result{ divide(line, sides, line.closed ? sides : sides + 1), line.closed };
  if (!line.closed)
    result.points.back() = line.points.back();
  return result;
}

class Builder {
public:
  TriangleMesh mesh;

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Vec3& warp, const Vec3& weft,
           const std::array<double, 2>& fullness, Panel panel)
  {
    mesh.triangles.push_back({ a, b, c });
    mesh.warp.push_back(warp);
    mesh.weft.push_back(weft);
    mesh.fullness.push_back(fullness);
    mesh.panel.push_back(panel);
  }

  void add_wall(const SheetLayout& line, double step, const Along& along, std::size_t rows, const Fullness& fullness)
  {
    const std::size_t n = line.points.size();
    for (std::size_t j = 0; j <= rows; ++j) {
      const double part = static_cast<double>(j) / static_cast<double>(rows);
      for (const Vec2& p : line.points)
        mesh.points.emplace_back((1.0 - part) * along.from + part * along.to, p[0], p[1]);
    }
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < line.sides(); ++i) {
        const std::size_t next = (i + 1) % n;
        const Vec2 side = line.points[next] - line.points[i];
        const double chord = side.norm();
        const Vec3 warp(0.0, side[0] / chord, side[1] / chord);
        const std::array<double, 2> full{ step / chord, fullness.along };
        const auto a = static_cast<std::uint32_t>(j * n + i), b = static_cast<std::uint32_t>(j * n + next),
                   c = static_cast<std::uint32_t>((j + 1) * n + next), d = static_cast<std::uint32_t>((j + 1) * n + i);
        if (j % 2 == 0) {
          add(a, b, d, warp, Vec3::UnitX(), full, Panel::wall);
          add(b, c, d, warp, Vec3::UnitX(), full, Panel::wall);
        } else {
          add(a, b, c, warp, Vec3::UnitX(), full, Panel::wall);
          add(a, c, d, warp, Vec3::UnitX(), full, Panel::wall);
        }
      }
  }

  void add_end(const SheetLayout& line, double x, std::size_t first_point, double segment_length, double fullness,
               Panel panel)
  {
    const Vec2 middle = inner_point(line);
    double distance = 0.0;
    Ring outer;
    outer.closed = line.closed;
    outer.part = parts_of(line);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      outer.point.push_back(static_cast<std::uint32_t>(first_point + i));
      distance += (line.points[i] - middle).norm() / static_cast<double>(line.points.size());
    }
    const auto rings = static_cast<std::size_t>(std::max(1.0, std::round(distance / segment_length)));
    for (std::size_t k = 1; k < rings; ++k) {
      Ring inner = add_ring(line, middle, 1.0 - static_cast<double>(k) / static_cast<double>(rings), x);
      stitch(outer, inner, fullness, panel);
      outer = std::move(inner);
    }
    const Ring centre{ { static_cast<std::uint32_t>(mesh.points.size()) }, { 0.5 }, false };
    mesh.points.emplace_back(x, middle[0], middle[1]);
    stitch(outer, centre, fullness, panel);
  }

private:
  Ring add_ring(const SheetLayout& line, const Vec2& middle, double scale, double x)
  {
    const SheetLayout plain{ line.points, line.closed };
    // Where the outline can be halved rings can too, so that half a section has half of the whole one's rings.
    const std::size_t unit = line.closed && line.sides() % 2 == 0 ? 2 : 1, least = line.closed ? 4 / unit : 2;
    const double wanted = scale * static_cast<double>(line.sides()) / static_cast<double>(unit);
    const std::size_t sides = unit * std::max(least, static_cast<std::size_t>(std::round(wanted)));
    Ring ring;
    ring.closed = line.closed;
    for (const Vec2& p : divided(plain, sides).points) {
      const Vec2 at = middle + scale * (p - middle);
      ring.point.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.emplace_back(x, at[0], at[1]);
    }
    for (std::size_t i = 0; i <= sides; ++i)
      ring.part.push_back(static_cast<double>(i) / static_cast<double>(sides));
    return ring;
  }

  /// Triangles between two rings: of the two sides that may be next that one whose middle comes first.
  void stitch(const Ring& outer, const Ring& inner, double fullness, Panel panel)
  {
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      add(a, b, c, Vec3::UnitY(), Vec3::UnitZ(), { fullness, fullness }, panel);
    };
    std::size_t i = 0, j = 0;
    while (i < outer.sides() || j < inner.sides()) {
      const bool along_outer = j == inner.sides() || (i < outer.sides() && outer.part[i] + outer.part[i + 1] <=
                                                                               inner.part[j] + inner.part[j + 1]);
      if (along_outer) {
        put(outer.at(i), outer.at(i + 1), inner.at(j));
        ++i;
      } else {
        put(outer.at(i), inner.at(j + 1), inner.at(j));
        ++j;
      }
    }
  }
};

}  // namespace

double TriangleMesh::area(std::size_t triangle) const
{
  const Triangle& t = triangles[triangle];
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
}

TriangleMesh wrap(const SheetLayout& outline, const Along& along, const ClosedEnds& closed_ends, double segment_length,
                  const Fullness& fullness)
{
  if (!(along.to > along.from))
    throw InputError("", "along", std::to_string(along.from) + " to " + std::to_string(along.to), "must ascend");
  if (outline.points.size() < (outline.closed ? 3U : 2U))
    throw InputError("", "outline", std::to_string(outline.points.size()) + " points",
                     "must have at least 2, a closed one 3");
  const double cloth = outline.cloth_length();
  const auto sides = static_cast<std::size_t>(std::max(outline.closed ? 3.0 : 1.0, std::round(cloth / segment_length)));
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round((along.to - along.from) / segment_length)));
  const SheetLayout line = divided(outline, sides);
  const double sense = twice_area(line) < 0.0 ? -1.0 : 1.0;
  if (closed_ends.aft || closed_ends.bow)
    require_star_shape(line, inner_point(line), sense);

  Builder builder;
  builder.add_wall(line, fullness.around * cloth / static_cast<double>(sides), along, rows, fullness);
  if (closed_ends.bow)
    builder.add_end(line, along.to, rows * line.points.size(), segment_length, fullness.ends, Panel::bow_end);
  if (closed_ends.aft) {
    const std::size_t first = builder.mesh.triangles.size();
    builder.add_end(line, along.from, 0, segment_length, fullness.ends, Panel::aft_end);
    for (std::size_t t = first; t < builder.mesh.triangles.size(); ++t)
      std::swap(builder.mesh.triangles[t][1], builder.mesh.triangles[t][2]);
  }
  if (sense < 0.0)
    for (Triangle& t : builder.mesh.triangles)
      std::swap(t[1], t[2]);
  require_no_overlap(builder.mesh, segment_length);
  builder.mesh.closed = true;
  return std::move(builder.mesh);
}

}  // namespace geocontainer_mpm::geotextile
