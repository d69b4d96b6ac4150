// What averaging over elements must leave alone.

#include <map>

#include "choices.h"

namespace geocontainer_mpm::mpm::testing {
namespace {

template <class K>
class Smooth : public ::testing::Test {
};
TYPED_TEST_SUITE(Smooth, Kinds);

constexpr int cells = 4;
constexpr std::size_t count = 80;

Discretisation smoothed(Shape shape, Smoothing smoothing)
{
  Discretisation choice = choice_of(shape, Transfer::apic);
  choice.smoothing = smoothing;
  return choice;
}
Discretisation averaged(Shape shape)
{
  return smoothed(shape, Smoothing::cell_average);
}

template <int Dim>
void set_uniform_stress(Chance& chance, Particles<Dim>& particles)
{
  for (Column& component : particles.stress)
    std::fill(component.begin(), component.end(), chance(-1e3, 1e3));
}

template <int Dim>
Column trace_of(const Particles<Dim>& particles)
{
  Column trace(particles.size(), 0.0);
  for (std::size_t p = 0; p < particles.size(); ++p)
    trace[p] = matrix_at<Dim>(particles.gradient, p).trace();
  return trace;
}

TYPED_TEST(Smooth, AveragesLeaveAUniformStressAlone)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("uniform stress", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    set_uniform_stress(chance, particles);
    for (double& volume : particles.volume)
      volume *= 1e-4;  // no element is full
    scatter_body<Dim>(particles, Vec<Dim>::Ones(), grid, averaged(TypeParam::shape));
    Grid<Dim> plain = grid;
    scatter_body<Dim>(particles, Vec<Dim>::Ones(), plain, choice_of(TypeParam::shape, Transfer::apic));
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      RC_ASSERT(apart(node_force(grid, i), node_force(plain, i)) < 1e-12 * (1.0 + node_force(plain, i).norm()));
      RC_ASSERT((grid.nodes()[i] == plain.nodes()[i]).all());
    });
  }));
}

TYPED_TEST(Smooth, AveragesKeepTheMeanStressAndTheViscousOne)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("mean", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    for (double& volume : particles.volume)
      volume *= 1e-4;
    for (Column& column : particles.gradient)
      for (double& value : column)
        value = chance(-5.0, 5.0);
    BodyTerms terms;
    terms.damping = { chance(0.0, 100.0), chance(0.0, 100.0) };
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, averaged(TypeParam::shape), terms);
    Vec<Dim> force = Vec<Dim>::Zero();
    Mat<Dim> moment = Mat<Dim>::Zero();
    double size = 0.0;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      force += node_force(grid, i);
      moment += node_force(grid, i) * grid.coordinate(node).transpose();
      size += node_force(grid, i).norm();
    });
    for (std::size_t p = 0; p < count; ++p) {
      const Mat<Dim> l = matrix_at<Dim>(particles.gradient, p);
      moment += particles.volume[p] * (stress_at(particles, p) + terms.damping.shear * (l + l.transpose()) +
                                       terms.damping.lambda * l.trace() * Mat<Dim>::Identity());
    }
    RC_ASSERT(force.norm() < 1e-13 * size);
    RC_ASSERT(moment.norm() < 1e-12 * size);
  }));
}

TYPED_TEST(Smooth, RatesKeepDeviatorSpinAndTotalVolumeAndAUniformDilation)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("rates", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    open(everything(grid), grid);
    ThreadTeam alone(1);
    const bool uniform = chance.whole(0, 1) == 0;
    const double dilation = chance(-3.0, 3.0);
    for (std::size_t p = 0; p < count; ++p) {
      Mat<Dim> l = chance.matrix<Dim>(5.0);
      if (uniform)
        l += (dilation - l.trace()) / Dim * Mat<Dim>::Identity();
      set_matrix<Dim>(particles.gradient, p, l);
    }
    const Particles<Dim> before = particles;
    smooth_gradients(smoothed(TypeParam::shape, Smoothing::nodal_mixed), strips, particles, grid, alone);
    const Column old_trace = trace_of(before), trace = trace_of(particles);
    double total = 0.0, size = 0.0, change = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
      const Mat<Dim> difference = matrix_at<Dim>(particles.gradient, p) - matrix_at<Dim>(before.gradient, p);
      RC_ASSERT(apart(difference, (trace[p] - old_trace[p]) / Dim * Mat<Dim>::Identity()) < 1e-13);
      total += particles.volume[p] * (trace[p] - old_trace[p]);
      size += particles.volume[p] * matrix_at<Dim>(before.gradient, p).norm();  // of what cancels in a trace
      change = std::max(change, std::abs(trace[p] - old_trace[p]));
    }
    RC_ASSERT(std::abs(total) < 1e-13 * size);
    RC_ASSERT(uniform == (change < 1e-13));
  }));
}

TYPED_TEST(Smooth, RatesOfOneElementAreItsMean)
{
  // All particles in one element: its mean rate is that of its nodes.
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("one element", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    const Vec<Dim> corner = lower_of(grid) + Vec<Dim>::Constant(grid.dx());
    Vec<Dim> upper = corner;
    for (int d = 0; d < Dim; ++d)
      upper[d] += (0.9 - 0.3 * d) * grid.dx();
    Particles<Dim> particles = random_cloud<Dim>(chance, 10, corner, upper);
    for (std::size_t p = 0; p < 10; ++p)
      for (std::size_t d = 0; d < Dim; ++d)  // ordered fractions: within one simplex
        particles.position[d][p] =
            corner[static_cast<Eigen::Index>(d)] +
            grid.dx() * chance(0.9 - 0.3 * static_cast<double>(d) - 0.25, 0.9 - 0.3 * static_cast<double>(d));
    double volume = 0.0, rate = 0.0;
    for (std::size_t p = 0; p < 10; ++p) {
      set_matrix<Dim>(particles.gradient, p, chance.matrix<Dim>(5.0));
      volume += particles.volume[p];
      rate += particles.volume[p] * matrix_at<Dim>(particles.gradient, p).trace();
    }
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    open(everything(grid), grid);
    ThreadTeam alone(1);
    smooth_gradients(smoothed(TypeParam::shape, Smoothing::nodal_mixed), strips, particles, grid, alone);
    for (const double trace : trace_of(particles))
      RC_ASSERT(std::abs(trace - rate / volume) < 1e-12);
  }));
}

// The work of the forces on any motion is that of the stress on the gradients that the law sees: no energy is made.
TYPED_TEST(Smooth, ForcesWorkOnAMotionAsStressesDoOnItsSmoothedGradients)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("work", [](Chance& chance) {
    const Smoothing smoothing = chance.whole(0, 1) == 0 ? Smoothing::cell_average : Smoothing::nodal_mixed;
    const Discretisation choice = smoothed(TypeParam::shape, smoothing);
    Grid<Dim> grid = random_grid<Dim>(chance, cells);
    Particles<Dim> particles = boxed(chance, TypeParam::shape, grid, random_cloud(chance, count, grid));
    for (double& volume : particles.volume)
      volume *= 1e-4;  // no element is integrated with its own volume
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, choice);
    double power = 0.0, size = 0.0;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>&) {
      const Vec<Dim> v = chance.vector<Dim>(3.0);
      for (int d = 0; d < Dim; ++d)
        grid.nodes()[i][d] = v[d];
      power -= node_force(grid, i).dot(v);
      size += std::abs(node_force(grid, i).dot(v));
    });
    Strips strips;
    Sorter<Dim>().sort(grid, particles, strips);
    ThreadTeam alone(1);
    grid_to_particles<Dim>(choice, grid, 0.0, Gather::gradient, particles, 0, count);
    smooth_gradients(choice, strips, particles, grid, alone);
    for (std::size_t p = 0; p < count; ++p)
      power -= particles.volume[p] * (stress_at(particles, p) * matrix_at<Dim>(particles.gradient, p)).trace();
    RC_ASSERT(std::abs(power) < 1e-12 * size);
  }));
}

template <class D>
class Full : public ::testing::Test {
};
using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Full, Dimensions);

TYPED_TEST(Full, ElementsUnderUniformStressPushNoInnerNodeWhereverTheParticlesAre)
{
  constexpr int Dim = TypeParam::Dim;
  EXPECT_TRUE(holds("full patch", [](Chance& chance) {
    Grid<Dim> grid = random_grid<Dim>(chance, 3);
    const std::size_t some = Dim == 2 ? 600 : 4000;
    Particles<Dim> particles = random_cloud(chance, some, grid);
    set_uniform_stress(chance, particles);
    // Elements by their nodes. Each gets 90 % to 130 % of its volume in all.
    std::map<std::array<std::uint32_t, Dim + 1>, std::vector<std::size_t>> elements;
    for (std::size_t p = 0; p < some; ++p) {
      auto nodes = simplex_reach<Dim>(vector_at<Dim>(particles.position, p), grid).node;
      std::sort(nodes.begin(), nodes.end());
      elements[nodes].push_back(p);
    }
    const std::size_t in_all = Dim == 2 ? 2 * 9 : 6 * 27;
    RC_PRE(elements.size() == in_all);
    for (const auto& [nodes, inside] : elements) {
      const double own = std::pow(grid.dx(), Dim) / (Dim == 2 ? 2 : 6), filled = own * chance(0.5001, 1.3);
      double sum = 0.0;
      for (std::size_t p : inside)
        sum += particles.volume[p];
      for (std::size_t p : inside)
        particles.volume[p] *= filled / sum;
    }
    scatter_body<Dim>(particles, Vec<Dim>::Zero(), grid, averaged(Shape::linear_simplex));
    double size = 0.0;
    for_each_node(
        grid, [&](std::size_t i, const std::array<int, Dim>&) { size = std::max(size, node_force(grid, i).norm()); });
    int inner_nodes = 0;
    for_each_node(grid, [&](std::size_t i, const std::array<int, Dim>& node) {
      bool inner = true;
      for (int d = 0; d < Dim; ++d)
        inner = inner && node[static_cast<std::size_t>(d)] > grid.low_face(d) &&
                node[static_cast<std::size_t>(d)] < grid.high_face(d);
      inner_nodes += inner ? 1 : 0;
      if (inner)
        RC_ASSERT(node_force(grid, i).norm() < 1e-12 * size);
    });
    RC_ASSERT(inner_nodes == (Dim == 2 ? 4 : 8));
  }));
}

}  // namespace
}  // namespace geocontainer_mpm::mpm::testing
