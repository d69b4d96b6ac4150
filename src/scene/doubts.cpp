#include "geocontainer_mpm/scene/doubts.h"

#include <fmt/format.h>

#include <cmath>

#include "geocontainer_mpm/scene/shapes.h"

namespace geocontainer_mpm::scene {
namespace {

/// What has the kinetic energy of a fall of this height, or less, counts as at rest, m: a sheet that has to stop it
/// takes some kN/m at most.
constexpr double slow_fall_m = 1e-3;

}  // namespace

double weight_in_air_n_per_m(const SceneDescription& scene)
{
  double mass = 0.0;
  for (const auto& [name, body] : scene.bodies)
    for (const std::vector<Vec2>& line : boundary_lines(body.shape, scene.hull, scene.grid.cell_size_m))
      mass += scene.materials.at(body.material).density_kg_per_m3 * polygon_area(line);
  for (const auto& [name, sheet] : scene.geotextiles)
    mass += sheet.mass_kg_per_m2 * unstretched_length(sheet, sheet_layout(sheet, scene));
  return mass * scene.gravity_at(scene.time.end_s).norm();
}

std::vector<std::string> doubts(const StatusFrame& status, const EnergyFrame& energy, double weight_n_per_m)
{
  std::vector<std::string> list;
  if (!(energy.relative_balance_error <= doubtful_share))
    list.push_back(fmt::format("the energy balance is open by {:.1f} % of what changed hands: more than {:.0f} %",
                               100.0 * energy.relative_balance_error, 100.0 * doubtful_share));
  const double volume_change =
      status.soil_volume_initial > 0.0 ? status.soil_volume / status.soil_volume_initial - 1.0 : 0.0;
  if (!(std::abs(volume_change) <= doubtful_share))
    list.push_back(fmt::format("the soil's volume changed by {:+.1f} %: more than {:.0f} %, too much for sand",
                               100.0 * volume_change, 100.0 * doubtful_share));
  const double exchanged = std::abs(energy.dissipated_plastic) + std::abs(energy.dissipated_contact) +
                           std::abs(energy.dissipated_transfer) + std::abs(energy.dissipated_water) +
                           std::abs(energy.work_in);
  const bool in_space = status.dimensions == 3;
  if (energy.dissipated_contact < -doubtful_share * exchanged)
    list.push_back(fmt::format("contact has given {:.3g} {} of energy: friction and impact only take it",
                               -1e-3 * energy.dissipated_contact, in_space ? "kJ" : "kJ/m"));
  const bool left = status.outcome == Outcome::released || status.outcome == Outcome::hung_up;
  if (left && energy.kinetic <= slow_fall_m * weight_n_per_m * (in_space ? status.length_m : 1.0) &&
      !(status.current_tension_n_per_m <= 0.5 * weight_n_per_m))
    list.push_back(
        fmt::format("the sheet holds {:.3g} kN/m at rest: more than half of all weight, {:.3g} kN/m, which "
                    "is what it carries when everything hangs on it",
                    1e-3 * status.current_tension_n_per_m, 0.5e-3 * weight_n_per_m));
  return list;
}

}  // namespace geocontainer_mpm::scene
