#include "geocontainer_mpm/mpm/particles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace geocontainer_mpm::mpm {

template <int Dim>
void Particles<Dim>::resize(std::size_t count)
{
  for (Column& column : deformation)
    column.clear();
  for (Column& column : box)
    column.clear();
  for_each_column([count](Column& column) { column.assign(count, 0.0); });
  id.resize(count);
  std::iota(id.begin(), id.end(), 0U);
}

template <int Dim>
void Particles<Dim>::use_deformation()
{
  for (std::size_t k = 0; k < deformation.size(); ++k)
    deformation[k].assign(size(), k % (Dim + 1) == 0 ? 1.0 : 0.0);
}

template <int Dim>
void Particles<Dim>::use_boxes()
{
  for (Column& edge : box) {
    edge.resize(size());
    for (std::size_t p = 0; p < size(); ++p)
      edge[p] = std::pow(volume[p], 1.0 / Dim);
  }
}

/// An edge of a box over that of a cube, and the other way round: see stretch_boxes().
constexpr double box_aspect = 1.4142135623730951;

template <int Dim>
void Particles<Dim>::stretch_boxes(double dt)
{
  for (std::size_t p = 0; p < box[0].size(); ++p) {
    const double cube = Dim == 2 ? std::sqrt(volume[p]) : std::cbrt(volume[p]);
    for (std::size_t d = 0; d < Dim; ++d)
      box[d][p] = std::clamp(box[d][p] * (1.0 + dt * gradient[d * Dim + d][p]), cube / box_aspect, cube * box_aspect);
  }
}

template <int Dim>
void Particles<Dim>::permute(const std::vector<std::uint32_t>& order)
{
  scratch_.resize(size());
  id_scratch_.resize(size());
  for_each_column([&](Column& column) {
    for (std::size_t i = 0; i < order.size(); ++i)
      scratch_[i] = column[order[i]];
    column.swap(scratch_);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    id_scratch_[i] = id[order[i]];
  id.swap(id_scratch_);
}

template <int Dim>
material::Batch<Dim> Particles<Dim>::batch()
{
  material::Batch<Dim> view;
  for (std::size_t k = 0; k < gradient.size(); ++k)
    view.velocity_gradient[k] = gradient[k].data();
  for (std::size_t k = 0; k < stress.size(); ++k)
    view.stress[k] = stress[k].data();
  if (!deformation[0].empty())
    for (std::size_t k = 0; k < deformation.size(); ++k)
      view.deformation[k] = deformation[k].data();
  view.initial_volume = initial_volume.data();
  view.volume = volume.data();
  view.separated_strain = separated_strain.data();
  view.elastic_energy = elastic_energy.data();
  view.dissipated = dissipated.data();
  return view;
}

template struct Particles<2>;
template struct Particles<3>;

}  // namespace geocontainer_mpm::mpm
