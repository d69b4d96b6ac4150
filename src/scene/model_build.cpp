/// From a description to bodies, sheets, boundaries and loads.

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
                   const std::optional<Water>& water, mpm::Particles<2>& particles)
{
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double top = top_at(shape, particles.position[0][p]), z = particles.position[1][p];
    const double depth = std::max(0.0, top - z);
    // gravity_z < 0: compression
    const double vertical = water ? gravity_z * water->overburden(density, z, top) : density * gravity_z * depth;
    particles.stress[0][p] = description.k0 * vertical;
    particles.stress[1][p] = vertical;
    particles.stress[3][p] = description.k0 * vertical;
  }
}

/// A weakly compressible fluid at rest, d p / d depth = rho g with rho = rho0 (1 + p / K): more mass in the same
/// volume, so that the law, which knows the volume at zero pressure, finds the pressure: under water that beyond the
/// water's own.
void set_hydrostatic(const material::Parameters& material, const std::vector<Vec2>& shape, double gravity_z,
                     const std::optional<Water>& water, mpm::Particles<2>& particles)
{
  const double rho = material.density_kg_per_m3, bulk = material.bulk_modulus_pa;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double top = top_at(shape, particles.position[0][p]), z = particles.position[1][p];
    const double depth = std::max(0.0, top - z);
    const double pressure = water ? -gravity_z * water->overburden(rho, z, top) : -rho * gravity_z * depth;
    const double compression = std::exp(pressure / bulk);  // rho / rho0
    particles.initial_volume[p] = compression * particles.volume[p];
    particles.mass[p] = particles.weight_mass[p] = rho * particles.initial_volume[p];
  }
}

void set_velocity(const Vec2& velocity, double spin, const std::optional<VelocityWave>& wave,
                  mpm::Particles<2>& particles)
{
  Vec2 middle = Vec2::Zero();
  double mass = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    middle += particles.mass[p] * Vec2(particles.position[0][p], particles.position[1][p]);
    mass += particles.mass[p];
  }
  middle /= mass;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x(particles.position[0][p], particles.position[1][p]);
    Vec2 v = velocity + spin * Vec2(middle[1] - x[1], x[0] - middle[0]);
    if (wave)
      v += wave->amplitude_m_per_s * std::sin(wave->wave_number_rad_per_m.dot(x) + wave->phase_rad);
    particles.velocity[0][p] = v[0];
    particles.velocity[1][p] = v[1];
    if (!wave && spin != 0.0) {
      particles.affine[1][p] = -spin;
      particles.affine[2][p] = spin;
    }
  }
}

void place(const Sampling& sampling, double density, mpm::Particles<2>& particles)
{
  particles.resize(sampling.points.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    for (std::size_t d = 0; d < 2; ++d)
      particles.position[d][p] = sampling.points[p][static_cast<Eigen::Index>(d)];
    particles.volume[p] = particles.initial_volume[p] = sampling.volumes[p];
    particles.mass[p] = particles.weight_mass[p] = density * sampling.volumes[p];
  }
}

/// Side of a square of the particles' mean volume, m.
double mean_width(const mpm::Particles<2>& particles)
{
  double volume = 0.0;
  for (const double v : particles.initial_volume)
    volume += v;
  return std::sqrt(volume / static_cast<double>(particles.size()));
}

void start_on_solution(const Manufactured& solution, mpm::Particles<2>& particles)
{
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 velocity = solution.velocity(Vec2(particles.position[0][p], particles.position[1][p]), 0.0);
    particles.velocity[0][p] = velocity[0];
    particles.velocity[1][p] = velocity[1];
  }
}

/// The segment whose middle is nearest to a place.
std::size_t nearest_segment(const geotextile::Sheet& sheet, const Vec2& at)
{
  const auto distance = [&](std::size_t i) {
    return (0.5 * (sheet.node(i) + sheet.node(sheet.end_of(i))) - at).norm();
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < sheet.segments(); ++i)
    if (distance(i) < distance(nearest))
      nearest = i;
  return nearest;
}

/// The seams where they are in the sheet as it is laid.
geotextile::Strength strength_of(const GeotextileDescription& description, const geotextile::Sheet& sheet)
{
  std::vector<geotextile::Seam> seams;
  for (const auto& [name, seam] : description.seams) {
    const std::size_t n = sheet.segments();
    const std::size_t place = seam.along
                                  ? std::min(n - 1, static_cast<std::size_t>(*seam.along * static_cast<double>(n)))
                                  : nearest_segment(sheet, *seam.at_m);
    seams.push_back({ name, place, seam.efficiency.value_or(description.seam_efficiency) });
  }
  return geotextile::Strength(description.strength_n_per_m, description.seam_efficiency, std::move(seams));
}

}  // namespace

Model::Model(const SceneDescription& scene, int threads)
    : team_(make_team(threads))
    , method_(scene.numerics.method)
    , constant_gravity_(scene.gravity_table.empty() ? scene.gravity_m_per_s2 : Vec2(Vec2::Zero()))
    , gravity_table_(scene.gravity_table)
    , time_step_factor_(scene.numerics.time_step_factor)
    , max_step_(scene.numerics.max_step_s)
    , max_travel_(scene.numerics.max_travel_cells * scene.grid.cell_size_m)
    , lower_(scene.grid.lower_m)
    , upper_(scene.grid.upper_m)
{
  if (scene.water)
    water_.emplace(*scene.water, scene.water_level_m(), -scene.gravity_m_per_s2[1]);
  build_fields(scene);
  build_bodies(scene);
  build_sheets(scene);
  build_contacts(scene);
  build_boundaries(scene);
  build_loads(scene);
  weigh();
  build_late_starts(scene);
  survey();
}

std::size_t Model::field_index(const std::string& name) const
{
  const std::string field = name.empty() ? common_field : name;
  const auto found = std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.name == field; });
  return static_cast<std::size_t>(found - fields_.begin());
}

void Model::build_fields(const SceneDescription& scene)
{
  for (const std::string& name : scene.velocity_fields())
    add_field(name, scene);
}

void Model::add_field(const std::string& name, const SceneDescription& scene)
{
  fields_.emplace_back(name, mpm::Grid<2>(lower_, upper_, scene.grid.cell_size_m, scene.grid.faces));
  now_.contact.emplace_back(method_.shape);
}

void Model::build_bodies(const SceneDescription& scene)
{
  for (const auto& [name, description] : scene.bodies) {
    const material::Parameters& material = scene.materials.at(description.material);
    const std::vector<Vec2> shape = outline(description.shape, scene.hull, scene.grid.cell_size_m);
    const double spacing = scene.grid.cell_size_m / description.particles_per_cell;
    Sampling sampling = sample(description.shape, shape, spacing);
    if (description.jitter > 0.0)
      jitter(description.jitter * spacing, sampling.points);
    if (sampling.points.empty())
      throw InputError(scene.source, "bodies." + name + ".shape", "", "must be large enough to hold a particle");

    Body body;
    body.name = name;
    body.field = field_index(description.velocity_field);
    body.law = material::make_law<2>(material);
    const double shear = material::shear_modulus(material);
    body.elastic = { material::constrained_modulus(material) - 2.0 * shear, shear };
    body.viscous = material::is_fluid(material.law) ? mpm::Moduli{ -2.0 / 3.0, 1.0 } : body.elastic;
    const material::DampingModuli damping = material::damping_moduli(material);
    body.damping = { damping.lambda, damping.shear };
    mpm::Particles<2>& particles = body.particles;
    body.density = material.density_kg_per_m3;
    place(sampling, body.density, particles);
    if (body.law->needs_deformation())
      particles.use_deformation();
    if (method_.shape == mpm::Shape::gimp) {
      particles.use_boxes();
      for (std::size_t d = 0; d < 2 && sampling.tile; ++d)
        particles.box[d].assign(particles.size(), (*sampling.tile)[static_cast<Eigen::Index>(d)]);
    }
    body.row = particles.id;
    body.start = std::make_shared<const std::vector<Vec2>>(sampling.points);
    set_velocity(description.initial_velocity_m_per_s, description.initial_spin_rad_per_s,
                 description.initial_velocity_wave, particles);
    if (description.manufactured) {
      body.manufactured = std::make_shared<const Manufactured>(*description.manufactured, material);
      start_on_solution(*body.manufactured, particles);
    }
    if (description.initial_stress == InitialStress::hydrostatic)
      set_hydrostatic(material, shape, scene.gravity_at(0.0)[1], water_, particles);
    else if (description.initial_stress != InitialStress::none)
      set_k0_stress(description, body.density, shape, scene.gravity_at(0.0)[1], water_, particles);
    if (water_) {
      body.particle_height = mean_width(particles);
      water_->place(body.density, body.particle_height, particles);
    }
    body.law->initialise(particles.batch(), 0, particles.size());
    now_.bodies.push_back(std::move(body));
  }
}

void Model::build_sheets(const SceneDescription& scene)
{
  for (const auto& [name, description] : scene.geotextiles) {
    const bool free = description.encloses.empty();
    geotextile::SheetParameters parameters;
    parameters.stiffness = description.stiffness_n_per_m;
    parameters.mass = description.mass_kg_per_m2;
    parameters.computational_mass = description.computational_mass_kg_per_m2;
    parameters.segment_length = description.segment_length_m;
    parameters.gauge_length = description.gauge_length_m;
    parameters.formulation = description.formulation;
    parameters.force_strain = description.force_strain_table;
    parameters.rupture_strain = description.rupture_strain;
    const geotextile::SheetLayout layout = sheet_layout(description, scene);
    if (description.wrinkles && layout.fullness.empty())
      throw InputError(scene.source, "geotextiles." + name + ".wrinkles.region", "",
                       "must hold part of the path along which the sheet is laid");
    parameters.unstretched_length = unstretched_length(description, layout);
    if (description.circumference_m && description.wrinkles &&
        *description.circumference_m < layout.cloth_length() * (1.0 - 1e-9))
      throw InputError(
          scene.source, "geotextiles." + name + ".circumference_m", fmt::format("{}", *description.circumference_m),
          fmt::format("must be at least {:.6g} m, what the path with its wrinkles takes", layout.cloth_length()));
    geotextile::Sheet laid(layout, parameters);
    const geotextile::Strength strength = strength_of(description, laid);
    ModelSheet sheet{ name, 0, std::move(laid), strength };
    if (free) {
      sheet.field = field_index(description.velocity_field);
      set_velocity(description.initial_velocity_m_per_s, 0.0, description.initial_velocity_wave, sheet.sheet.nodes());
    } else {
      const BodyDescription& inside = scene.bodies.at(description.encloses);
      sheet.field = field_index(inside.velocity_field);
      if (description.interface == SheetInterface::frictional) {
        sheet.field = fields_.size();
        add_field(name, scene);
      }
      set_velocity(inside.initial_velocity_m_per_s, 0.0, std::nullopt, sheet.sheet.nodes());
      for (std::size_t b = 0; b < now_.bodies.size(); ++b)
        if (now_.bodies[b].name == description.encloses) {
          now_.bodies[b].enclosed = true;
          sheet.inside = b;
        }
    }
    const std::size_t last = sheet.sheet.nodes().size() - 1;
    for (const auto& [end, node] :
         { std::make_pair(&description.start, std::size_t{ 0 }), std::make_pair(&description.end, last) })
      if (end->held)
        held_ends_.push_back({ now_.sheets.size(), node, sheet.sheet.node(node), end->motion_table });
    sheet.sheet.update_forces();  // what is tense as laid is so from the start
    sheet_descriptions_.push_back(description);
    now_.sheets.push_back(std::move(sheet));
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
  for (const auto& [name, surface] : scene.surfaces) {
    std::vector<Vec2> line = surface.line_m;
    if (surface.corner_radius_m > 0.0)
      line = barge::round_corners(line, surface.corner_radius_m, arc_turn_rad, "surfaces." + name + ".corner_radius_m");
    boundaries_.emplace_back(name, contact::Surface(std::move(line), surface.closed), surface.friction, spacing);
  }
  now_.boundary_totals.resize(boundaries_.size());
}

void Model::build_loads(const SceneDescription& scene)
{
  for (const auto& [name, support] : scene.supports)
    supports_.push_back(support);
  for (const auto& [name, description] : scene.tractions) {
    const auto body = std::find_if(now_.bodies.begin(), now_.bodies.end(),
                                   [&, &wanted = description.body](const Body& b) { return b.name == wanted; });
    const BodyDescription& described = scene.bodies.at(description.body);
    const double spacing = scene.grid.cell_size_m / described.particles_per_cell;
    Traction traction(description, boundary_lines(described.shape, scene.hull, spacing), spacing, body->particles);
    if (traction.pieces() == 0)
      throw InputError(scene.source, "tractions." + name + ".region", "",
                       "must hold part of the boundary of " + description.body);
    now_.tractions.push_back(std::move(traction));
    traction_body_.push_back(static_cast<std::size_t>(body - now_.bodies.begin()));
  }
}

std::size_t Model::add_tracer(std::size_t body, const Vec2& at)
{
  const Body& owner = now_.bodies[body];
  std::size_t nearest = 0;
  for (std::size_t p = 1; p < owner.particles.size(); ++p)
    if ((owner.position(p) - at).squaredNorm() < (owner.position(nearest) - at).squaredNorm())
      nearest = p;
  now_.tracers.push_back(
      { body, owner.particles.id[nearest], at - owner.position(nearest), at, owner.velocity(nearest) });
  return now_.tracers.size() - 1;
}

}  // namespace geocontainer_mpm::scene
