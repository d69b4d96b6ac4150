#pragma once
/// A small scene that uses every section, and what its tests share.

#include <string>

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

}  // namespace geocontainer_mpm::scene
