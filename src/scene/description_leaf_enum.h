#pragma once
/// Words of a scene file that stand for an enumerator.

#include <yaml-cpp/yaml.h>

#include <array>
#include <string>
#include <utility>

#include "description_limits.h"
#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene::grammar {

/// Words of an enumeration in a scene file, by enumerator.
template <class Enum>
struct Words;
template <>
struct Words<FaceCondition> {
  static constexpr std::array<std::pair<FaceCondition, const char*>, 3> list{
    { { FaceCondition::free, "free" }, { FaceCondition::roller, "roller" }, { FaceCondition::fixed, "fixed" } }
  };
};
template <>
struct Words<Symmetry> {
  static constexpr std::array<std::pair<Symmetry, const char*>, 3> list{
    { { Symmetry::none, "none" }, { Symmetry::half, "half" }, { Symmetry::quarter, "quarter" } }
  };
};
template <>
struct Words<InitialStress> {
  static constexpr std::array<std::pair<InitialStress, const char*>, 4> list{ { { InitialStress::none, "none" },
                                                                                { InitialStress::k0, "k0" },
                                                                                { InitialStress::gravity, "gravity" },
                                                                                { InitialStress::hydrostatic,
                                                                                  "hydrostatic" } } };
};
template <>
struct Words<ManufacturedSolution> {
  static constexpr std::array<std::pair<ManufacturedSolution, const char*>, 2> list{
    { { ManufacturedSolution::axis_aligned, "axis_aligned" }, { ManufacturedSolution::vortex, "vortex" } }
  };
};
template <>
struct Words<SheetInterface> {
  static constexpr std::array<std::pair<SheetInterface, const char*>, 2> list{
    { { SheetInterface::bonded, "bonded" }, { SheetInterface::frictional, "frictional" } }
  };
};
template <>
struct Words<mpm::Shape> {
  static constexpr std::array<std::pair<mpm::Shape, const char*>, 3> list{ { { mpm::Shape::bspline2, "bspline2" },
                                                                             { mpm::Shape::linear_simplex,
                                                                               "linear_simplex" },
                                                                             { mpm::Shape::gimp, "gimp" } } };
};
template <>
struct Words<mpm::Transfer> {
  static constexpr std::array<std::pair<mpm::Transfer, const char*>, 3> list{
    { { mpm::Transfer::apic, "apic" }, { mpm::Transfer::flip, "flip" }, { mpm::Transfer::aflip, "aflip" } }
  };
};
template <>
struct Words<mpm::MassMatrix> {
  static constexpr std::array<std::pair<mpm::MassMatrix, const char*>, 2> list{
    { { mpm::MassMatrix::lumped, "lumped" }, { mpm::MassMatrix::consistent, "consistent" } }
  };
};
template <>
struct Words<mpm::UpdateOrder> {
  static constexpr std::array<std::pair<mpm::UpdateOrder, const char*>, 3> list{
    { { mpm::UpdateOrder::usl, "usl" }, { mpm::UpdateOrder::usf, "usf" }, { mpm::UpdateOrder::musl, "musl" } }
  };
};
template <>
struct Words<mpm::Smoothing> {
  static constexpr std::array<std::pair<mpm::Smoothing, const char*>, 3> list{
    { { mpm::Smoothing::none, "none" },
      { mpm::Smoothing::cell_average, "cell_average" },
      { mpm::Smoothing::nodal_mixed, "nodal_mixed" } }
  };
};
template <>
struct Words<material::LawName> {
  static constexpr std::array<std::pair<material::LawName, const char*>, 6> list{
    { { material::LawName::linear_elastic, "linear_elastic" },
      { material::LawName::mohr_coulomb, "mohr_coulomb" },
      { material::LawName::neo_hookean, "neo_hookean" },
      { material::LawName::hencky, "hencky" },
      { material::LawName::newtonian, "newtonian" },
      { material::LawName::bingham, "bingham" } }
  };
};

template <>
struct Words<geotextile::Formulation> {
  static constexpr std::array<std::pair<geotextile::Formulation, const char*>, 2> list{
    { { geotextile::Formulation::segments, "segments" },
      { geotextile::Formulation::membrane_points, "membrane_points" } }
  };
};

template <class Enum, class = decltype(Words<Enum>::list)>
std::string type_text(const Enum&, const Limits&)
{
  std::string text = "one of ";
  for (const auto& [value, word] : Words<Enum>::list)
    text += (value == Words<Enum>::list.front().first ? "" : ", ") + std::string(word);
  return text;
}

template <class Enum, class = decltype(Words<Enum>::list)>
void parse(const YAML::Node& node, const std::string& key, const Limits& limits, Enum& value)
{
  if (node.IsScalar())
    for (const auto& [candidate, word] : Words<Enum>::list)
      if (node.Scalar() == word) {
        value = candidate;
        return;
      }
  refuse(key, text_of(node), "must be " + type_text(value, limits));
}

template <class Enum, class = decltype(Words<Enum>::list)>
std::string to_text(const Enum& value)
{
  for (const auto& [candidate, word] : Words<Enum>::list)
    if (candidate == value)
      return word;
  return std::to_string(static_cast<int>(value));
}

template <class Enum, class = decltype(Words<Enum>::list)>
void check(const Enum& value, const std::string& key, const Limits& limits)
{
  for (const auto& entry : Words<Enum>::list)
    if (entry.first == value)
      return;
  refuse(key, to_text(value), "must be " + type_text(value, limits));
}

}  // namespace geocontainer_mpm::scene::grammar
