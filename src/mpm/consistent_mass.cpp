#include "geocontainer_mpm/mpm/consistent_mass.h"

#include <algorithm>
#include <cmath>

#include "elements.h"
#include "faces.h"

namespace geocontainer_mpm::mpm {
namespace {

/// Nodes handed to a thread at once; sums are made in these blocks, so that they do not depend on the threads.
constexpr std::size_t block_size = 256;

int radius_of(Shape shape)
{
  return shape == Shape::linear_simplex ? 1 : 2;
}

/// Place of a node in a box of 2 * radius + 1 neighbours a direction, last index fastest.
template <int Dim>
std::ptrdiff_t code_of(const std::array<int, Dim>& node, int radius)
{
  std::ptrdiff_t code = 0;
  for (std::size_t d = 0; d < Dim; ++d)
    code = code * (2 * radius + 1) + node[d];
  return code;
}

/// Weights of a particle, and where its nodes lie: storage index and code relative to a common corner.
template <int Dim>
struct Spread {
  AnyReach<Dim> reach;
  std::array<std::ptrdiff_t, most_nodes<Dim>> code;
};

template <int Dim>
Spread<Dim> spread_of(Shape shape, const Particles<Dim>& particles, std::size_t p, const Grid<Dim>& grid)
{
  Spread<Dim> s;
  s.reach = reach_of<Dim>(shape, particles, p, Vec<Dim>::Zero(), grid);
  const int radius = radius_of(shape);
  for (std::size_t k = 0; k < static_cast<std::size_t>(s.reach.count); ++k) {
    // Back from the storage index: differences of codes are what counts, so any common corner will do.
    std::array<int, Dim> node;
    std::size_t rest = s.reach.node[k];
    for (std::size_t d = Dim; d-- > 0; rest /= static_cast<std::size_t>(grid.counts()[d]))
      node[d] = static_cast<int>(rest % static_cast<std::size_t>(grid.counts()[d]));
    s.code[k] = code_of<Dim>(node, radius);
  }
  return s;
}

}  // namespace

template <int Dim>
void ConsistentMass<Dim>::open(Shape shape, const Grid<Dim>& grid)
{
  shape_ = shape;
  const int radius = radius_of(shape);
  width_ = 1;
  for (int d = 0; d < Dim; ++d)
    width_ *= static_cast<std::size_t>(2 * radius + 1);
  offset_.resize(width_);
  for (std::size_t n = 0; n < width_; ++n) {
    std::ptrdiff_t stride = 1;
    offset_[n] = 0;
    std::size_t rest = n;
    for (std::size_t d = Dim; d-- > 0; rest /= static_cast<std::size_t>(2 * radius + 1)) {
      offset_[n] += stride * (static_cast<std::ptrdiff_t>(rest % static_cast<std::size_t>(2 * radius + 1)) - radius);
      stride *= grid.counts()[d];
    }
  }
  padding_ = static_cast<std::size_t>(offset_.back());

  active_.clear();
  for (int slowest = grid.window().begin[0]; slowest < grid.window().end[0]; ++slowest)
    grid.visit_rows(slowest, [&](std::size_t first, const std::array<int, Dim>&, int length) {
      for (std::size_t i = first; i < first + static_cast<std::size_t>(length); ++i)
        if (grid.nodes()[i][Grid<Dim>::mass_slot] > Grid<Dim>::massless)
          active_.push_back(static_cast<std::uint32_t>(i));
    });
  const std::size_t count = active_.size();
  number_.assign(grid.size() + 2 * padding_, static_cast<std::uint32_t>(count));
  entries_.assign(width_ * count, 0.0);
  for (std::size_t n = 0; n < count; ++n) {
    number_[active_[n] + padding_] = static_cast<std::uint32_t>(n);
    entries_[width_ * n + width_ / 2] = lumped_part * grid.nodes()[active_[n]][Grid<Dim>::mass_slot];
  }
  find_faces(grid);
  for (std::vector<Value>* v : { &solution_, &residual_, &direction_, &image_ })
    v->assign(count + 1, Value::Zero());
}

template <int Dim>
void ConsistentMass<Dim>::find_faces(const Grid<Dim>& grid)
{
  mirrors_.clear();
  held_.clear();
  const auto number = [&](std::size_t i) { return number_[i + padding_]; };
  const std::uint32_t none = static_cast<std::uint32_t>(active_.size());
  visit_conditions(grid, [&](int d, int side, FaceCondition condition) {
    Value sign, keep;
    for (int c = 0; c < Dim; ++c) {
      sign[c] = mirror_sign(condition, c, d);
      keep[c] = sign[c] < 0.0 ? 0.0 : 1.0;
    }
    visit_face(
        grid, d, side,
        [&](std::size_t beyond, std::size_t inside) {
          if (number(beyond) != none)
            mirrors_.push_back({ number(beyond), number(inside), sign });
        },
        [&](std::size_t on_face) {
          if (number(on_face) != none)
            held_.push_back({ number(on_face), keep });
        });
  });
}

template <int Dim>
void ConsistentMass<Dim>::add_particle(const Particles<Dim>& particles, std::size_t p, const Grid<Dim>& grid)
{
  const Spread<Dim> s = spread_of<Dim>(shape_, particles, p, grid);
  const double mass = (1.0 - lumped_part) * particles.mass[p];
  const auto middle = static_cast<std::ptrdiff_t>(width_ / 2);
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.reach.count); ++i) {
    const std::uint32_t row = number_[s.reach.node[i] + padding_];
    if (row == active_.size())
      continue;  // no weight at all
    double* entries = entries_.data() + width_ * row;
    const double share = mass * s.reach.weight[i];
    for (std::size_t j = 0; j < static_cast<std::size_t>(s.reach.count); ++j)
      entries[s.code[j] - s.code[i] + middle] += share * s.reach.weight[j];
  }
}

template <int Dim>
void ConsistentMass<Dim>::add(const Particles<Dim>& particles, const Strips& strips, const Grid<Dim>& grid,
                              ThreadTeam& team)
{
  for_each_in_strips(strips, team, [&](std::size_t p) { add_particle(particles, p, grid); });
}

template <int Dim>
void ConsistentMass<Dim>::add(const Particles<Dim>& nodes, const Grid<Dim>& grid)
{
  for (std::size_t p = 0; p < nodes.size(); ++p)
    add_particle(nodes, p, grid);
}

/// From what is free to all nodes: the images beyond the faces, nothing where a component is held.
template <int Dim>
void ConsistentMass<Dim>::spread(std::vector<Value>& v) const
{
  for (const Held& held : held_)
    v[held.node] *= held.keep;
  for (const Mirror& mirror : mirrors_)
    v[mirror.beyond] = mirror.sign * v[mirror.inside];
}

/// The transpose of spread().
template <int Dim>
void ConsistentMass<Dim>::fold(std::vector<Value>& v) const
{
  for (auto mirror = mirrors_.rbegin(); mirror != mirrors_.rend(); ++mirror) {
    v[mirror->inside] += mirror->sign * v[mirror->beyond];
    v[mirror->beyond].setZero();
  }
  for (const Held& held : held_)
    v[held.node] *= held.keep;
  v[active_.size()].setZero();
}

/// image <- M direction.
template <int Dim>
void ConsistentMass<Dim>::apply(ThreadTeam& team)
{
  spread(direction_);
  const std::size_t count = active_.size();
  team.for_each(static_cast<int>((count + block_size - 1) / block_size), [&](int block) {
    const std::size_t begin = static_cast<std::size_t>(block) * block_size;
    for (std::size_t n = begin; n < std::min(count, begin + block_size); ++n) {
      const double* entries = entries_.data() + width_ * n;
      const std::uint32_t* numbers = number_.data() + active_[n] + padding_;
      Value sum = Value::Zero();
      for (std::size_t k = 0; k < width_; ++k)
        sum += entries[k] * direction_[numbers[offset_[k]]];
      image_[n] = sum;
    }
  });
  fold(image_);
}

/// Calls `work(n)` for all active nodes and adds up what it returns.
template <int Dim>
template <class Work>
typename ConsistentMass<Dim>::Value ConsistentMass<Dim>::sum_blocks(ThreadTeam& team, Work&& work)
{
  const std::size_t count = active_.size();
  block_sums_.assign((count + block_size - 1) / block_size, Value::Zero());
  team.for_each(static_cast<int>(block_sums_.size()), [&](int block) {
    const std::size_t begin = static_cast<std::size_t>(block) * block_size;
    Value sum = Value::Zero();
    for (std::size_t n = begin; n < std::min(count, begin + block_size); ++n)
      sum += work(n);
    block_sums_[static_cast<std::size_t>(block)] = sum;
  });
  Value total = Value::Zero();
  for (const Value& sum : block_sums_)
    total += sum;
  return total;
}

template <int Dim>
void ConsistentMass<Dim>::multiply(std::vector<Value>& v, ThreadTeam& team)
{
  std::copy(v.begin(), v.end(), direction_.begin());
  direction_.back().setZero();
  apply(team);
  std::copy(image_.begin(), image_.end() - 1, v.begin());
}

template <int Dim>
int ConsistentMass<Dim>::solve(std::vector<Value>& v, ThreadTeam& team)
{
  const std::size_t count = active_.size();
  diagonal_.resize(count + 1);
  for (std::size_t n = 0; n < count; ++n)
    diagonal_[n] = entries_[width_ * n + width_ / 2];
  for (auto mirror = mirrors_.rbegin(); mirror != mirrors_.rend(); ++mirror)
    diagonal_[mirror->inside] += diagonal_[mirror->beyond];

  std::copy(v.begin(), v.end(), residual_.begin());
  for (const Mirror& mirror : mirrors_)
    residual_[mirror.beyond].setZero();
  for (const Held& held : held_)
    residual_[held.node] *= held.keep;
  Value error = sum_blocks(team, [&](std::size_t n) -> Value {
    solution_[n].setZero();
    direction_[n] = residual_[n] / diagonal_[n];
    return residual_[n] * direction_[n];
  });
  const Value goal = tolerance * tolerance * error;
  int iterations = 0;
  for (; (error > goal).any() && iterations < most_iterations; ++iterations) {
    apply(team);
    // Each component is a system of its own; one that is done stands still.
    const Value curvature = sum_blocks(team, [&](std::size_t n) -> Value { return direction_[n] * image_[n]; });
    const Value length = (error > goal).select(error / curvature, Value::Zero());
    const Value next = sum_blocks(team, [&](std::size_t n) -> Value {
      solution_[n] += length * direction_[n];
      residual_[n] -= length * image_[n];
      return residual_[n].square() / diagonal_[n];
    });
    const Value turn = (error > goal).select(next / error, Value::Zero());
    error = next;
    sum_blocks(team, [&](std::size_t n) -> Value {
      direction_[n] = residual_[n] / diagonal_[n] + turn * direction_[n];
      return Value::Zero();
    });
  }
  std::copy(solution_.begin(), solution_.end() - 1, v.begin());
  for (const Mirror& mirror : mirrors_)
    v[mirror.beyond].setZero();
  return iterations;
}

template class ConsistentMass<2>;
template class ConsistentMass<3>;

}  // namespace geocontainer_mpm::mpm
