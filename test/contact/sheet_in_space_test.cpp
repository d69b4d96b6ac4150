// Contact with a closed sheet in space: what is nearest and on which side, Coulomb's cone, momentum, and half a model.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "contact_input.h"
#include "geocontainer_mpm/contact/sheet_contact.h"

namespace geocontainer_mpm::contact::testing {
namespace {

constexpr double dt = 1e-3;
using Corners = std::array<std::uint32_t, 3>;

/// The surface of a box around the origin, its sides in `parts` by `parts` squares of two triangles, whose diagonals
/// run this way and that. `half`: without what is beyond y = 0, and with a rim there; `parts` is even.
struct Box {
  std::vector<Vec3> points;
  std::vector<Corners> triangles;

  Box(const Vec3& half_edge, int parts, bool half = false)
  {
    std::map<std::array<int, 3>, std::uint32_t> number;
    for (int d = 0; d < 3; ++d)
      for (int side = -1; side <= 1; side += 2) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;  // e, f, d is right-handed
        const auto corner = [&](int i, int j) {
          std::array<int, 3> at;
          at[static_cast<std::size_t>(d)] = side > 0 ? parts : 0;
          at[static_cast<std::size_t>(e)] = i;
          at[static_cast<std::size_t>(f)] = j;
          const auto [found, is_new] = number.emplace(at, static_cast<std::uint32_t>(points.size()));
          if (is_new)
            points.emplace_back(Vec3(2.0 * at[0] / parts - 1.0, 2.0 * at[1] / parts - 1.0, 2.0 * at[2] / parts - 1.0)
                                    .cwiseProduct(half_edge));
          return found->second;
        };
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
          if (half && (points[a][1] + points[b][1] + points[c][1]) < 0.0)
            return;
          triangles.push_back(side > 0 ? Corners{ a, b, c } : Corners{ a, c, b });
        };
        for (int i = 0; i < parts; ++i)
          for (int j = 0; j < parts; ++j) {
            const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), g = corner(i, j + 1);
            if ((i + j) % 2 == 0) {
              add(a, b, c);
              add(a, c, g);
            } else {
              add(a, b, g);
              add(b, c, g);
            }
          }
      }
    if (half)
      drop_unused();
  }
  void drop_unused()
  {
    std::vector<std::uint32_t> number(points.size(), 0);
    std::vector<Vec3> used;
    for (Corners& t : triangles)
      for (std::uint32_t& node : t) {
        if (number[node] == 0) {
          used.push_back(points[node]);
          number[node] = static_cast<std::uint32_t>(used.size());
        }
        node = number[node] - 1;
      }
    points = used;
  }
  void turn(const Eigen::Quaterniond& by)
  {
    for (Vec3& x : points)
      x = by * x;
  }
};

mpm::Particles<3> nodes_at(const std::vector<Vec3>& points, double mass)
{
  mpm::Particles<3> nodes;
  nodes.resize(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    set_vector<3>(nodes.position, p, points[p]);
    nodes.mass[p] = nodes.weight_mass[p] = mass;
  }
  return nodes;
}

mpm::Grid<3> lattice(bool half = false)
{
  auto faces = mpm::testing::free_faces<3>();
  Vec3 lower = Vec3::Constant(-0.8);
  if (half) {
    faces[2] = mpm::FaceCondition::roller;
    lower[1] = 0.0;
  }
  return { lower, Vec3::Constant(0.8), 0.1, faces };
}

/// Signed distance from the surface of a box, positive inside.
double depth_in(const Vec3& half_edge, const Vec3& x)
{
  const Vec3 beyond = x.cwiseAbs() - half_edge;
  return (beyond.array() <= 0.0).all() ? -beyond.maxCoeff() : -beyond.cwiseMax(0.0).norm();
}

TEST(SheetInSpace, SeesHowFarAndOnWhichSideTheSheetIs)
{
  EXPECT_TRUE(holds("distance", [](Chance& chance) {
    const Vec3 half_edge(chance(0.2, 0.4), chance(0.2, 0.4), chance(0.2, 0.4));
    Box box(half_edge, chance.whole(1, 4));
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(chance(-1, 1), chance(-1, 1), chance(-1, 1), chance(0.1, 1)).normalized();
    box.turn(turn);
    const mpm::Particles<3> nodes = nodes_at(box.points, 1.0);
    const SheetSide side = chance.whole(0, 1) == 0 ? SheetSide::inside : SheetSide::outside;
    const double sign = side == SheetSide::inside ? 1.0 : -1.0;
    const mpm::Grid<3> grid = lattice();
    SheetSurface<3> surface(side);
    const double reach = 0.12;
    surface.lay_out({ &nodes, 1.0, &box.triangles }, reach, grid);
    for (int k = 0; k < 15; ++k) {
      const Vec3 x = chance.vector<3>(0.5);
      const double exact = sign * depth_in(half_edge, turn.conjugate() * x);
      const std::optional<SheetFoot<3>> foot = surface.nearest(x, grid);
      if (std::abs(exact) > reach + 1e-9)
        RC_ASSERT(!foot);
      if (std::abs(exact) > reach - 1e-9)
        continue;
      RC_ASSERT(foot.has_value());
      RC_ASSERT(std::abs(foot->seen.distance - exact) < 1e-12);
      Vec3 at = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        at += foot->share[i] * box.points[foot->node[i]];
      RC_ASSERT(std::abs(foot->share[0] + foot->share[1] + foot->share[2] - 1.0) < 1e-12);
      if (std::abs(exact) > 1e-3)
        RC_ASSERT(apart(x - at, exact * foot->seen.normal) < 1e-9);
      RC_ASSERT(std::abs(foot->seen.normal.norm() - 1.0) < 1e-12);
    }
  }));
}

TEST(SheetInSpace, GoesOnceAroundWhatIsInside)
{
  // The ray up passes through nodes, along sides and through flat walls.
  const Vec3 half_edge(0.3, 0.4, 0.2);
  for (const bool half : { false, true }) {
    const Box box(half_edge, 4, half);
    const mpm::Particles<3> nodes = nodes_at(box.points, 1.0);
    SheetMesh mesh;
    mesh.lay({ &nodes, 1.0, &box.triangles }, SheetSide::inside, lattice(half));
    for (int i = -10; i <= 10; ++i)
      for (int j = half ? 0 : -10; j <= 10; ++j)
        for (int k = -10; k <= 10; ++k) {
          const Vec3 x(0.05 * i, 0.05 * j, 0.05 * k + 0.01);
          const double depth = depth_in(half_edge, x);
          if (std::abs(depth) > 1e-9) {
            EXPECT_EQ(mesh.winding(x), depth > 0.0 ? 1 : 0) << x.transpose();
          }
        }
  }
}

TEST(SheetInSpace, HalfASheetIsSeenLikeTheWhole)
{
  EXPECT_TRUE(holds("half", [](Chance& chance) {
    const Vec3 half_edge(0.3, 0.25, 0.2);
    // Bent: the images at the rim count.
    Box whole(half_edge, 4), half(half_edge, 4, true);
    const double bend = chance(-1.0, 1.0), lift = chance(-0.5, 0.5);
    for (Box* box : { &whole, &half })
      for (Vec3& x : box->points)
        x[2] += bend * std::abs(x[1]) + lift * x[0] * x[0];
    const mpm::Particles<3> whole_nodes = nodes_at(whole.points, 1.0), half_nodes = nodes_at(half.points, 1.0);
    const mpm::Grid<3> grid = lattice(), half_grid = lattice(true);
    SheetSurface<3> all(SheetSide::inside), part(SheetSide::inside);
    all.lay_out({ &whole_nodes, 1.0, &whole.triangles }, 0.12, grid);
    part.lay_out({ &half_nodes, 1.0, &half.triangles }, 0.12, half_grid);
    for (int k = 0; k < 30; ++k) {
      Vec3 x = chance.vector<3>(0.5);
      x[1] = std::abs(x[1]);
      const auto one = all.nearest(x, grid), other = part.nearest(x, half_grid);
      RC_ASSERT(one.has_value() == other.has_value());
      if (one)
        RC_ASSERT(std::abs(one->seen.distance - other->seen.distance) < 1e-12);
    }
  }));
}

/// Grains in a box of cloth, and what contact does to both in one step.
struct Parcel {
  mpm::Grid<3> grain_grid, sheet_grid;
  Box box;
  mpm::Particles<3> grains, nodes;
  SheetContact<3> contact;

  Parcel(const std::vector<Vec3>& at, double friction, bool half = false, double node_mass = 0.5)
      : grain_grid(lattice(half))
      , sheet_grid(lattice(half))
      , box(Vec3(0.4, 0.4, 0.2), 8, half)
      , grains(nodes_at(at, 2.0))
      , nodes(nodes_at(box.points, node_mass))
      , contact(mpm::Shape::bspline2, SheetSide::inside, friction)
  {
  }
  void to_grids()
  {
    for (const auto& [particles, grid] :
         { std::make_pair(&grains, &grain_grid), std::make_pair(&nodes, &sheet_grid) }) {
      mpm::testing::open(mpm::testing::everything(*grid), *grid);
      mpm::testing::sheet_to_grid<3>(*particles, Vec3::Zero(), *grid);
      mpm::testing::apply_forces(*grid, 0.0, 0.0);
    }
  }
  /// Returns the sweeps that it takes.
  int solve(int most = 300)
  {
    contact.begin({ &grains, false }, grain_grid, { &nodes, 1.0, &box.triangles }, sheet_grid, dt);
    contact.guess(grain_grid, sheet_grid);
    double change = 1.0;
    int number = 0;
    for (; number < most && change > 1e-12; ++number)
      change = contact.sweep(number, grain_grid, sheet_grid);
    contact.end();
    return number;
  }
  static Vec3 momentum(const mpm::Grid<3>& grid)
  {
    Vec3 sum = Vec3::Zero();
    mpm::testing::for_each_node(grid, [&](std::size_t i, const std::array<int, 3>&) {
      sum += mpm::testing::node_mass(grid, i) * mpm::testing::node_vector(grid, i);
    });
    return sum;
  }
};

/// A layer of grains on the floor of the box.
std::vector<Vec3> layer(double above)
{
  std::vector<Vec3> at;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      at.emplace_back(0.1 * i + 0.01, 0.1 * j + 0.02, -0.2 + above);
  return at;
}

TEST(SheetInSpace, KeepsToCoulombsConeAndSticksInside)
{
  EXPECT_TRUE(holds("cone", [](Chance& chance) {
    const double friction = chance(0.05, 1.0), into = chance(0.1, 1.0), turn = chance(-pi, pi);
    const double speed = friction * into * (chance.whole(0, 1) == 0 ? chance(0.0, 0.8) : chance(1.2, 3.0));
    const Vec3 along = speed * Vec3(std::cos(turn), std::sin(turn), 0.0);
    Parcel parcel(layer(0.0), friction);
    for (std::size_t p = 0; p < parcel.grains.size(); ++p)
      set_vector<3>(parcel.grains.velocity, p, along - into * Vec3::UnitZ());
    parcel.to_grids();
    const Vec3 grains = Parcel::momentum(parcel.grain_grid), sheet = Parcel::momentum(parcel.sheet_grid);
    RC_ASSERT(parcel.solve() < 300);
    const Vec3 impulse = Parcel::momentum(parcel.grain_grid) - grains;
    RC_ASSERT(apart(impulse, sheet - Parcel::momentum(parcel.sheet_grid)) < 1e-12);
    const Vec3 dragged(impulse[0], impulse[1], 0.0);
    RC_ASSERT(impulse[2] > 0.0);
    RC_ASSERT(dragged.norm() <= friction * impulse[2] * (1.0 + 1e-12));
    for (std::size_t p = 0; p < parcel.grains.size(); ++p) {
      const Vec3 x = vector_at<3>(parcel.grains.position, p);
      const Vec3 slip =
          mpm::testing::interpolated<3>(parcel.grain_grid, x) - mpm::testing::interpolated<3>(parcel.sheet_grid, x);
      RC_ASSERT(slip[2] > -1e-2 * into);  // at the facet's corners instead of at the point
      if (speed > 1.2 * friction * into)
        RC_ASSERT(slip.dot(along) > 0.0);
    }
    if (speed > 1.2 * friction * into)
      RC_ASSERT(apart(dragged, -friction * impulse[2] * along.normalized()) < 1e-2 * friction * impulse[2]);
    else
      RC_ASSERT(dragged.norm() < 0.81 * friction * impulse[2]);
  }));
}

TEST(SheetInSpace, DoesNothingBeforeTheGapCloses)
{
  Parcel parcel(layer(0.011), 0.5);
  for (double& v : parcel.grains.velocity[2])
    v = -10.0;  // a centimetre in this step
  parcel.to_grids();
  const Vec3 before = Parcel::momentum(parcel.grain_grid);
  parcel.solve();
  EXPECT_EQ(apart(Parcel::momentum(parcel.grain_grid), before), 0.0);
}

TEST(SheetInSpace, HalfAModelIsAsGoodAsTheWhole)
{
  // Grains that run apart from the plane of symmetry and press on floor and walls, some of them in the plane.
  std::vector<Vec3> whole, half;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = 0; k < 2; ++k) {
        const Vec3 x(0.095 * i + 0.01, 0.095 * j, -0.195 + 0.1 * k);
        whole.push_back(x);
        if (x[1] >= 0.0)
          half.push_back(x);
      }
  const auto solved = [](const std::vector<Vec3>& at, bool is_half) {
    Parcel parcel(at, 0.3, is_half);
    for (std::size_t p = 0; p < at.size(); ++p) {
      set_vector<3>(parcel.grains.velocity, p, Vec3(3.0 * at[p][0] + 0.2, 4.0 * at[p][1], -1.0));
      if (is_half && at[p][1] == 0.0)
        parcel.grains.mass[p] *= 0.5;
    }
    if (is_half)
      for (std::size_t i = 0; i < parcel.nodes.size(); ++i)
        parcel.nodes.mass[i] *= parcel.nodes.position[1][i] == 0.0 ? 0.5 : 1.0;
    parcel.to_grids();
    parcel.solve(2000);
    return parcel;
  };
  const Parcel all = solved(whole, false), part = solved(half, true);
  double largest = 0.0;
  for (const auto& [of_all, of_part] :
       { std::make_pair(&all.grain_grid, &part.grain_grid), std::make_pair(&all.sheet_grid, &part.sheet_grid) })
    mpm::testing::for_each_node(*of_part, [&, a = of_all, b = of_part](std::size_t i, const std::array<int, 3>& node) {
      const std::array<int, 3> same{ node[0], node[1] + 8, node[2] };
      const double mass = mpm::testing::node_mass(*b, i);
      if (node[1] < b->low_face(1) || !(mass > 1e-6))
        return;
      const double share = node[1] == b->low_face(1) ? 0.5 : 1.0;
      EXPECT_NEAR(mass, share * mpm::testing::node_mass(*a, a->index(same)), 1e-12);
      const Vec3 v = mpm::testing::node_vector(*b, i);
      largest = std::max(largest, apart(v, mpm::testing::node_vector(*a, a->index(same))));
    });
  EXPECT_LT(largest, 1e-6) << "m/s; an order of sweeps of its own each";
}

TEST(SheetInSpace, NothingGetsOut)
{
  // Grains without any stress fly apart at 1 m/s from the middle and must carry the sheet before them.
  std::vector<Vec3> at;
  for (int i = -7; i <= 7; ++i)
    for (int j = -7; j <= 7; ++j)
      for (int k = -3; k <= 3; ++k)
        at.emplace_back(0.05 * i, 0.05 * j, 0.05 * k);
  Parcel parcel(at, 0.3);
  for (std::size_t p = 0; p < at.size(); ++p) {
    set_vector<3>(parcel.grains.velocity, p, at[p]);
    for (std::size_t d = 0; d < 3; ++d)
      parcel.grains.affine[4 * d][p] = 1.0;
  }
  for (double& volume : parcel.grains.initial_volume)
    volume = 0.05 * 0.05 * 0.05;
  const auto momentum = [](const mpm::Particles<3>& particles) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = 0; p < particles.size(); ++p)
      sum += particles.mass[p] * particles.velocity_of(p);
    return sum;
  };
  const double step = 0.02;
  for (int k = 0; k < 25; ++k) {
    parcel.to_grids();
    parcel.contact.begin({ &parcel.grains, true }, parcel.grain_grid, { &parcel.nodes, 1.0, &parcel.box.triangles },
                         parcel.sheet_grid, step);
    parcel.contact.guess(parcel.grain_grid, parcel.sheet_grid);
    for (int number = 0; number < 30; ++number)
      parcel.contact.sweep(number, parcel.grain_grid, parcel.sheet_grid);
    parcel.contact.end();
    mpm::testing::grid_to_particles(parcel.grain_grid, step, false, parcel.grains, 0, parcel.grains.size());
    mpm::testing::grid_to_particles(parcel.sheet_grid, step, false, parcel.nodes, 0, parcel.nodes.size());
  }
  SheetMesh mesh;
  mesh.lay({ &parcel.nodes, 1.0, &parcel.box.triangles }, SheetSide::inside, parcel.sheet_grid);
  EXPECT_GT(*std::max_element(parcel.nodes.position[0].begin(), parcel.nodes.position[0].end()), 0.5);
  int out = 0;
  for (std::size_t p = 0; p < parcel.grains.size(); ++p)
    out += mesh.winding(parcel.grains.position_of(p)) == 1 ? 0 : 1;
  EXPECT_EQ(out, 0);
  EXPECT_LT((momentum(parcel.grains) + momentum(parcel.nodes)).norm(), 1e-11);
}

}  // namespace
}  // namespace geocontainer_mpm::contact::testing
