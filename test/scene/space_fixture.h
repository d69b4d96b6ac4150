#pragma once
/// A bag of sand that falls, in plane strain and in space, and what is compared of it.

#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "description_fixture.h"
#include "physics_fixture.h"

namespace geocontainer_mpm::scene {

/// A bag of sand falls flat on a bed and spreads until its sheet holds it. Its steps are of one length, whatever the
/// model: how much the transfers smooth depends on their number. `space`, `along`: lines that make it a scene in space.
inline std::string falling_bag(double cell, const std::string& space, const std::string& along, double end_s)
{
  return fmt::format(R"(
name: bag
numerics: {{ max_step_s: 0.0005 }}
time: {{ end_s: {}, output_interval_s: 0.02 }}
grid:
  cell_size_m: {}
  lower_m: [-1.6, -0.4]
  upper_m: [1.6, 1.6]
  faces: {{ y_min: free, y_max: free, z_min: free, z_max: free }}
{}
materials:
  sand: {{ law: mohr_coulomb, density_kg_per_m3: 1800, young_modulus_pa: 1.0e6, poisson_ratio: 0.3,
          friction_angle_deg: 30, dilation_angle_deg: 0, cohesion_pa: 0, tension_cutoff_pa: 0 }}
bodies:
  sand: {{ material: sand, {} initial_velocity_m_per_s: [0, -2],
          shape: {{ polygon: {{ vertices_m: [[0, 0], [0.6, 0], [0.6, 0.8], [-0.6, 0.8], [-0.6, 0]] }} }} }}
geotextiles:
  bag: {{ encloses: sand, slack: 0.02, stiffness_n_per_m: 2.0e5, mass_kg_per_m2: 1, computational_mass_kg_per_m2: 20,
         strength_n_per_m: 1.0e5, segment_length_m: {}, gauge_length_m: 0.4 }}
surfaces:
  bed: {{ line_m: [[-1.6, 0], [1.6, 0]], friction: 0.4 }}
)",
                     end_s, cell, space, along, cell);
}

struct Result {
  StatusFrame status;
  EnergyFrame energy;
  std::optional<WaterFrame> water;
  double force_z;  ///< largest of the bed in an output interval
};

inline Result fall(const std::string& text)
{
  Simulation simulation(parse_scene(text, "bag.yaml"), 1);
  Result result{ {}, {}, {}, 0.0 };
  EXPECT_EQ(run(simulation,
                [&](const Simulation& now) {
                  result.force_z = std::max(result.force_z, -now.frame().boundary.front().force[2]);
                }),
            Advance::finished)
      << simulation.failure().reason;
  result.status = simulation.status();
  result.energy = simulation.energy();
  result.water = simulation.water();
  return result;
}

/// The bed's force is per width in plane strain.
inline void expect_equal(const Result& space, const Result& other, double force_factor, double tolerance)
{
  const auto within = [&](double a, double b, const char* what) { EXPECT_NEAR(a, b, tolerance * std::abs(b)) << what; };
  within(space.status.peak_tension_n_per_m, other.status.peak_tension_n_per_m, "peak tension");
  within(space.status.current_tension_n_per_m, other.status.current_tension_n_per_m, "tension at the end");
  within(space.status.width_m, other.status.width_m, "width");
  within(space.status.height_m, other.status.height_m, "height");
  within(space.status.centroid_m[2], other.status.centroid_m[2], "centroid");
  within(space.force_z * force_factor, other.force_z, "force on the bed");
}

}  // namespace geocontainer_mpm::scene
