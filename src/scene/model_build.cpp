#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/scene/shapes.h"

namespace geocontainer_mpm::scene {
namespace {

/// Boundary particles per cell along a surface: every node within reach of the surface then sees several.
constexpr double boundary_spacing_cells = 0.5;
/// A rounded corner becomes chords that turn by no more than this, rad.
constexpr double arc_turn_rad = 0.3;

std::shared_ptr<mpm::ThreadTeam> make_team(int threads)
{
  if (threads < 1)
    throw InputError("", "threads", std::to_string(threads), "at least 1");
  return std::make_shared<mpm::ThreadTeam>(threads);
}

/// Vertical stress from the weight of what lies above, horizontal stress by K0 (both horizontal directions).
void set_k0_stress(const BodyDescription& description, double density, const std::vector<Vec2>& shape, double gravity_z,
                   mpm::Particles<2>& particles)
{
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double depth = std::max(0.0, top_at(shape, particles.position[0][p]) - particles.position[1][p]);
    const double vertical = density * gravity_z * depth;  // gravity_z < 0: compression
    particles.stress[0][p] = description.k0 * vertical;
    particles.stress[1][p] = vertical;
    particles.stress[3][p] = description.k0 * vertical;
  }
}

}  // namespace

Model::Model(const SceneDescription& scene, int threads)
    : team_(make_team(threads))
    , gravity_(scene.gravity_m_per_s2)
    , time_step_factor_(scene.numerics.time_step_factor)
    , max_step_(scene.numerics.max_step_s)
    , max_travel_(scene.numerics.max_travel_cells * scene.grid.cell_size_m)
    , lower_(scene.grid.lower_m)
    , upper_(scene.grid.upper_m)
    , grid_(lower_, upper_, scene.grid.cell_size_m, scene.grid.faces)
{
  build_bodies(scene);
  build_sheets(scene);
  build_boundaries(scene);
  const auto weigh = [this](const mpm::Particles<2>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      inertia_ += particles.mass[p];
      weight_mass_ += particles.weight_mass[p];
    }
  };
  for (const Body& body : bodies_)
    weigh(body.particles);
  for (const EnclosingSheet& sheet : sheets_)
    weigh(sheet.sheet.nodes());
  survey();
}

void Model::build_bodies(const SceneDescription& scene)
{
  for (const auto& [name, description] : scene.bodies) {
    const material::Parameters& material = scene.materials.at(description.material);
    const std::vector<Vec2> shape = outline(description.shape, scene.hull, scene.grid.cell_size_m);
    const Sampling sampling = sample(description.shape, shape, scene.grid.cell_size_m / description.particles_per_cell);
    if (sampling.points.empty())
      throw InputError(scene.source, "bodies." + name + ".shape", "", "must be large enough to hold a particle");

    Body body;
    body.name = name;
    body.law = material::make_law<2>(material);
    body.constrained_modulus = material::constrained_modulus(material);
    body.shear_modulus = material::shear_modulus(material);
    mpm::Particles<2>& particles = body.particles;
    particles.resize(sampling.points.size());
    const double mass = material.density_kg_per_m3 * sampling.volume;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      for (std::size_t d = 0; d < 2; ++d) {
        particles.position[d][p] = sampling.points[p][static_cast<Eigen::Index>(d)];
        particles.velocity[d][p] = description.initial_velocity_m_per_s[static_cast<Eigen::Index>(d)];
      }
      particles.mass[p] = particles.weight_mass[p] = mass;
      particles.volume[p] = particles.initial_volume[p] = sampling.volume;
    }
    if (description.initial_stress != InitialStress::none)
      set_k0_stress(description, material.density_kg_per_m3, shape, gravity_[1], particles);
    body.law->initialise(particles.batch(), 0, particles.size());
    bodies_.push_back(std::move(body));
  }
}

void Model::build_sheets(const SceneDescription& scene)
{
  for (const auto& [name, description] : scene.geotextiles) {
    const BodyDescription& inside = scene.bodies.at(description.encloses);
    geotextile::SheetParameters parameters;
    parameters.circumference = description.circumference_m;
    parameters.stiffness = description.stiffness_n_per_m;
    parameters.mass = description.mass_kg_per_m2;
    parameters.computational_mass = description.computational_mass_kg_per_m2;
    parameters.segment_length = description.segment_length_m;
    parameters.gauge_length = description.gauge_length_m;
    sheets_.push_back(
        { name, geotextile::Sheet(outline(inside.shape, scene.hull, description.segment_length_m), parameters) });
    for (std::size_t d = 0; d < 2; ++d)
      std::fill(sheets_.back().sheet.nodes().velocity[d].begin(), sheets_.back().sheet.nodes().velocity[d].end(),
                inside.initial_velocity_m_per_s[static_cast<Eigen::Index>(d)]);
    for (Body& body : bodies_)
      body.enclosed = body.enclosed || body.name == description.encloses;
  }
}

void Model::build_boundaries(const SceneDescription& scene)
{
  const double spacing = boundary_spacing_cells * scene.grid.cell_size_m;
  if (scene.hull) {
    const barge::SplitHull hull(
        scene.hull->hinge_m,
        barge::round_corners(scene.hull->port_section_m, scene.hull->lip_radius_m, arc_turn_rad, "hull.lip_radius_m"),
        "hull");
    hull_index_ = 0;
    boundaries_.emplace_back("hull_port", contact::Surface(hull.closed_section_m(barge::HullHalf::port)),
                             scene.hull->friction, spacing);
    boundaries_.emplace_back("hull_starboard", contact::Surface(hull.closed_section_m(barge::HullHalf::starboard)),
                             scene.hull->friction, spacing);
  }
  for (const auto& [name, surface] : scene.surfaces)
    boundaries_.emplace_back(name, contact::Surface(surface.line_m), surface.friction, spacing);
}

}  // namespace geocontainer_mpm::scene
