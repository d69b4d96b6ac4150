#pragma once
/// Material points as a structure of arrays.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/material/law.h"
#include "geocontainer_mpm/mpm/types.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::mpm {

using Column = std::vector<double>;

/// One set of material points: the particles of a body, or the nodes of a sheet (which carry no stress).
template <int Dim>
struct Particles {
  static constexpr int stress_size = material::stress_size<Dim>;

  std::array<Column, Dim> position;           ///< m
  std::array<Column, Dim> velocity;           ///< m/s, at mid-step (leapfrog)
  std::array<Column, Dim * Dim> affine;       ///< APIC velocity matrix C, row-major, 1/s
  std::array<Column, Dim * Dim> gradient;     ///< velocity gradient of the last step, row-major dv_i/dx_j, 1/s
  std::array<Column, stress_size> stress;     ///< Cauchy, see material/law.h for the order, Pa
  std::array<Column, Dim * Dim> deformation;  ///< F, row-major; empty unless use_deformation()
  std::array<Column, Dim> box;                ///< edges along the grid's axes, m; empty unless use_boxes()
  std::array<Column, Dim> force;              ///< external force of the present step (sheets), N (N/m in plane strain)
  Column mass;                                ///< inertia, kg (kg/m)
  Column weight_mass;                         ///< what gravity pulls, kg (kg/m); differs under mass scaling
  Column volume, initial_volume;              ///< m^3 (m^2)
  Column separated_strain, elastic_energy, dissipated;  ///< see material::Batch
  std::vector<std::uint32_t> id;                        ///< index at creation: sorting reorders the arrays

  std::size_t size() const { return mass.size(); }
  // Of row p.
  Vec<Dim> position_of(std::size_t p) const { return vector_of(position, p); }
  Vec<Dim> velocity_of(std::size_t p) const { return vector_of(velocity, p); }
  Vec<Dim> force_of(std::size_t p) const { return vector_of(force, p); }
  Mat<Dim> gradient_of(std::size_t p) const
  {
    Mat<Dim> result;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j)
        result(i, j) = gradient[static_cast<std::size_t>(i * Dim + j)][p];
    return result;
  }
  /// All columns to `count` zeros, ids 0, 1, ...; without deformation and boxes.
  void resize(std::size_t count);
  /// For the laws that need it: a deformation gradient for every row, the identity.
  void use_deformation();
  /// For gimp: a cube of its volume for every row.
  void use_boxes();
  /// Boxes by a step's gradients, each edge by the stretch along it, so that their volume stays the particle's; does
  /// nothing without boxes. They do not shear or turn with the material. Where that is what it does, the stretch along
  /// an axis, summed up, says nothing about the neighbours and runs away: the edges stay within sqrt(2) of those of a
  /// cube of `volume`. (Vortex, shear of 6, 20 cells across: RMS error 26 mm, the same with cubes; within 2: 82 mm;
  /// free: no end reached.)
  void stretch_boxes(double dt);
  /// Row i of the result is row `order[i]` of today.
  void permute(const std::vector<std::uint32_t>& order);
  material::Batch<Dim> batch();
  /// Calls `visit(column)` for every double column that is in use: state digests, checkpoints, permutation.
  template <class Visitor>
  void for_each_column(Visitor&& visit)
  {
    const auto all = [&](auto& columns) {
      for (auto& column : columns)
        visit(column);
    };
    all(position);
    all(velocity);
    all(affine);
    all(gradient);
    all(stress);
    if (!deformation[0].empty())
      all(deformation);
    if (!box[0].empty())
      all(box);
    all(force);
    for (Column* column :
         { &mass, &weight_mass, &volume, &initial_volume, &separated_strain, &elastic_energy, &dissipated })
      visit(*column);
  }

private:
  friend struct geocontainer_mpm::StateAccess;

  static Vec<Dim> vector_of(const std::array<Column, Dim>& columns, std::size_t p)
  {
    Vec<Dim> v;
    for (int d = 0; d < Dim; ++d)
      v[d] = columns[static_cast<std::size_t>(d)][p];
    return v;
  }

  Column scratch_;  ///< reused by permute, so that sorting while stepping does not allocate
  std::vector<std::uint32_t> id_scratch_;
};

}  // namespace geocontainer_mpm::mpm
