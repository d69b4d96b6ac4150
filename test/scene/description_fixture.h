#pragma once
/// Scenes that the tests of the description share: a small one, and one that uses every key of the grammar.

#include <gtest/gtest.h>

#include <string>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::scene {

inline const std::string source_dir = GEOCONTAINER_MPM_SOURCE_DIR;

inline const std::string small_scene = R"(name: small
time:
  end_s: 2
grid:
  cell_size_m: 0.1
  lower_m: [-4, -6]
  upper_m: [4, 1]
  faces: { y_min: free, y_max: roller, z_min: fixed, z_max: free }
materials:
  sand:
    law: mohr_coulomb
    density_kg_per_m3: 1990
    young_modulus_pa: 3.0e6
    poisson_ratio: 0.3
    friction_angle_deg: 33
    dilation_angle_deg: 2
    cohesion_pa: 0
    tension_cutoff_pa: 0
  rubber:
    law: linear_elastic
    density_kg_per_m3: 1000
    young_modulus_pa: 1.0e5
    poisson_ratio: 0.4
bodies:
  fill:
    material: sand
    shape: { hopper_fill: { area_m2: 3 } }
    initial_stress: k0
  block:
    material: rubber
    shape:
      box: { lower_m: [2, -5], upper_m: [3, -4], rotation_deg: 10, pivot_m: [2, -5] }
    initial_velocity_m_per_s: [0.5, 0]
  ball:
    material: rubber
    shape:
      disc: { center_m: [-2, -4], radius_m: 0.5 }
  wedge:
    material: rubber
    shape:
      polygon: { vertices_m: [[-3, -5.5], [-2, -5.5], [-3, -5]] }
geotextiles:
  bag:
    encloses: fill
    circumference_m: 9
    stiffness_n_per_m: 1.1e6
    mass_kg_per_m2: 0.84
    computational_mass_kg_per_m2: 20
    strength_n_per_m: 200e3
    segment_length_m: 0.1
hull:
  hinge_m: [0, 0]
  port_section_m: [[1.5, -3], [0, -3], [0, -2.6], [1.5, -1], [1.5, 0]]
  lip_radius_m: 0.1
  friction: 0.2
  opening_table:
    - [0, 0, 0]
    - [10, 0.3, 0.25]
  signal:
    max_gap_s: 1
surfaces:
  bed:
    line_m: [[-4, -5.5], [4, -5.5]]
    friction: 0.5
)";

/// Not a case that anybody would run.
inline const std::string full_scene = R"(name: full
description: "every key of the grammar but gravity_table: 'quoted' # and so on"
gravity_m_per_s2: [0, 0]
time:
  end_s: 2
  output_interval_s: 0.2
  probe_interval_s: 0.05
grid:
  cell_size_m: 0.1
  lower_m: [-4, -6]
  upper_m: [4, 1]
  faces: { y_min: free, y_max: roller, z_min: fixed, z_max: free }
numerics:
  shape: linear_simplex
  transfer: flip
  flip_fraction: 0.95
  mass: lumped
  update: musl
  smoothing: cell_average
  time_step_factor: 0.5
  max_step_s: 0.001
  max_travel_cells: 0.2
  damping_per_s: 0.1
  skip_resting: false
  rest_velocity_m_per_s: 1.0e-3
  rest_time_s: 0.4
  max_halvings: 4
  energy_jump: 0.05
  speed_jump: 6
materials:
  sand:
    law: mohr_coulomb
    density_kg_per_m3: 1990
    young_modulus_pa: 3.0e6
    poisson_ratio: 0.3
    stiffness_damping_s: 1.0e-4
    friction_angle_deg: 33
    dilation_angle_deg: 2
    cohesion_pa: 10
    tension_cutoff_pa: 5
  rubber:
    law: neo_hookean
    density_kg_per_m3: 1000
    young_modulus_pa: 1.0e5
    poisson_ratio: 0.3
  slurry:
    law: bingham
    density_kg_per_m3: 1400
    bulk_modulus_pa: 1.0e6
    viscosity_pa_s: 0.5
    yield_stress_pa: 20
    regularisation_rate_per_s: 0.2
bodies:
  fill:
    material: sand
    shape: { hopper_fill: { area_m2: 3 } }
    particles_per_cell: 3
    jitter: 0.25
    initial_stress: k0
    k0: 0.46
  square:
    material: rubber
    shape:
      box: { lower_m: [2.5, -4.5], upper_m: [3.5, -3.5], rotation_deg: 0, pivot_m: [2.5, -4.5] }
    manufactured: { solution: axis_aligned, amplitude: 0.06, origin_m: [2.5, -4.5] }
  whirl:
    material: rubber
    shape:
      ring: { center_m: [-2, -4], inner_radius_m: 0.75, outer_radius_m: 1.25 }
    manufactured: { solution: vortex, origin_m: [-2, -4] }
  drop:
    material: slurry
    shape:
      disc: { center_m: [-2, -4], radius_m: 0.5 }
    initial_stress: hydrostatic
    velocity_field: fluid
    initial_velocity_m_per_s: [0.5, 0]
    initial_spin_rad_per_s: 0.25
    initial_velocity_wave: { amplitude_m_per_s: [0, 0.1], wave_number_rad_per_m: [3, 0], phase_rad: 0.5 }
  wedge:
    material: rubber
    shape:
      polygon: { vertices_m: [[-3, -5.5], [-2, -5.5], [-3, -5.3]] }
    held_until_s: 0.5
geotextiles:
  bag:
    encloses: fill
    circumference_m: 9
    stiffness_n_per_m: 1.1e6
    mass_kg_per_m2: 0.84
    computational_mass_kg_per_m2: 20
    strength_n_per_m: 200e3
    seam_efficiency: 0.8
    seams:
      left: { at_m: [-0.5, -5], efficiency: 0.7 }
      right: { along: 0.25 }
    segment_length_m: 0.05
    formulation: membrane_points
    gauge_length_m: 0.4
  cable:
    line: { points_m: [[-1, -5], [0, -5.2], [1, -5]], closed: false }
    slack: 0.02
    start: { held: true, motion_table: [[0, 0, 0], [1, 0.1, -0.1]] }
    end: { held: false, force_n_per_m: [10, 5], force_table: [[0, 0], [1, 1]] }
    velocity_field: cable
    force_strain_table: [[0, 0], [0.05, 3e4], [0.15, 1.2e5]]
    initial_velocity_m_per_s: [0, 0.1]
    initial_velocity_wave: { amplitude_m_per_s: [0, 0.2], wave_number_rad_per_m: [2, 0], phase_rad: 0.1 }
    stiffness_n_per_m: 1.0e5
    mass_kg_per_m2: 0.5
    computational_mass_kg_per_m2: 5
    strength_n_per_m: 100e3
    segment_length_m: 0.1
  tube:
    circle: { center_m: [0, -5], radius_m: 0.15 }
    pretension_n_per_m: 100
    rupture_strain: 0.12
    seams: { overlap: { along: 0.5, efficiency: 0.25, tears: true } }
    inside_pressure: { pressure_pa: 50, gradient_pa_per_m: 9810, level_m: -4.5, table: [[0, 0], [0.5, 1]] }
    velocity_field: cable
    stiffness_n_per_m: 1.0e5
    mass_kg_per_m2: 0.5
    computational_mass_kg_per_m2: 5
    strength_n_per_m: 100e3
    segment_length_m: 0.1
  skin:
    encloses: drop
    wrinkles: { region: { lower_m: [-2.3, -4.6], upper_m: [-1.7, -4.2] }, number: 3, amplitude_m: 0.05 }
    interface: frictional
    interface_friction: 0.3
    stiffness_n_per_m: 1.0e4
    mass_kg_per_m2: 0.5
    computational_mass_kg_per_m2: 5
    strength_n_per_m: 100e3
    segment_length_m: 0.1
hull:
  hinge_m: [0, 0]
  port_section_m: [[1.5, -3], [0, -3], [0, -2.6], [1.5, -1], [1.5, 0]]
  lip_radius_m: 0.1
  friction: 0.2
  opening_table: [[0, 0, 0], [10, 0.3, 0.25]]
  full_opening_rad: 0.4
  signal:
    min_angle_rad: -0.01
    max_angle_rad: 0.6
    max_rate_rad_per_s: 0.2
    noise_rad: 0.03
    max_gap_s: 1
    smoothing_time_s: 0.5
    backlash_rad: 0.002
surfaces:
  bed:
    line_m: [[-4, -5.5], [0, -5.6], [4, -5.5]]
    closed: false
    corner_radius_m: 0.2
    friction: 0.5
    motion: { pivot_m: [0, -5.5], table: [[0, 0, 0, 0], [2, 0, 0.1, 0.05]] }
supports:
  shaker:
    region: { lower_m: [3.8, -6], upper_m: [4, 1] }
    holds_y: true
    holds_z: false
    velocity_table: [[0, 0, 0], [1, 0.2, 0]]
tractions:
  load:
    body: wedge
    region: { lower_m: [-3, -5.6], upper_m: [-2, -5.4] }
    traction_pa: [10, 0]
    pressure_pa: 100
    table: [[-1, 0], [1, 1]]
contacts:
  wet: { between: [common, fluid], friction: 0 }
  dry: { between: [cable, common], friction: 0.3 }
  both: { between: [cable, fluid], friction: 0.1 }
probes:
  top: { point: { body: square, at_m: [3, -3.6] } }
  mean: { body: fill }
  cut: { section: { from_m: [2, -4], to_m: [4, -4] } }
  pull: { geotextile: { name: cable, at_m: [0, -5.2] } }
  push: { surface: hull_port }
  error: { manufactured: whirl }
outcome:
  hung_up_after_s: 4
)";

/// Water needs a gravity, which full_scene cannot have.
inline const std::string wet_scene = small_scene + R"(water:
  density_kg_per_m3: 1025
  draught_m: 2
  drag_coefficient: 1.1
  added_mass_coefficient: 0.5
)";

/// Keys of a scene in three dimensions.
inline const std::string solid_scene = R"(name: solid
time: { end_s: 2 }
grid:
  cell_size_m: 0.2
  lower_m: [-4, -6]
  upper_m: [4, 1]
  faces: { y_min: free, y_max: free, z_min: fixed, z_max: free }
numerics: { transfer: aflip, transfer_memory_s: 0.004 }
space: { along_m: [-4, 4], x_min: free, x_max: fixed, symmetry: quarter }
materials:
  sand: { law: linear_elastic, density_kg_per_m3: 1990, young_modulus_pa: 3.0e6, poisson_ratio: 0.3 }
bodies:
  fill: { material: sand, shape: { hopper_fill: { area_m2: 3 } }, along_m: [-3, 3] }
geotextiles:
  bag:
    encloses: fill
    circumference_m: 9
    stiffness_n_per_m: 1.1e6
    stiffness_weft_n_per_m: 1.0e6
    force_strain_weft_table: [[0, 0], [0.1, 1.0e5]]
    strength_weft_n_per_m: 150e3
    end_slack: 0.2
    mass_kg_per_m2: 0.84
    computational_mass_kg_per_m2: 20
    strength_n_per_m: 200e3
    segment_length_m: 0.2
hull:
  hinge_m: [0, 0]
  port_section_m: [[1.5, -3], [0, -3], [0, -2.6], [1.5, -1], [1.5, 0]]
  lip_radius_m: 0.1
  friction: 0.2
  along_m: [-3, 3]
surfaces:
  bed: { line_m: [[-4, -5.5], [4, -5.5]], friction: 0.5 }
)";

/// `scene` with its first `from` replaced by `to`; `from` empty: `to` appended.
inline std::string changed(const std::string& scene, const std::string& from, const std::string& to)
{
  std::string text = scene;
  if (from.empty())
    return text + to;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// One line that holds all of these; `allowed` is a part of what is allowed.
inline void expect_error(const InputError& error, const std::string& source, const std::string& key,
                         const std::string& value, const std::string& allowed)
{
  SCOPED_TRACE(error.what());
  EXPECT_EQ(error.source(), source);
  EXPECT_EQ(error.key(), key);
  EXPECT_EQ(error.value(), value);
  EXPECT_NE(error.allowed().find(allowed), std::string::npos);
  const std::string line = error.what();
  EXPECT_EQ(line.find('\n'), std::string::npos);
  for (const std::string& part : { source, key, value, allowed })
    EXPECT_NE(line.find(part), std::string::npos) << part;
}

}  // namespace geocontainer_mpm::scene
