/// From a description to bodies, sheets, boundaries and loads.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/scene/prescribed_motion.h"
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
template <int Dim>
void set_k0_stress(const BodyDescription& description, double density, const std::vector<Vec2>& shape, double gravity_z,
                   const std::optional<Water>& water, mpm::Particles<Dim>& particles)
{
  constexpr std::size_t vertical_slot = z_axis<Dim>, out_of_plane = 3;  // of plane strain
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x = in_section<Dim>(particles.position_of(p));
    const double top = top_at(shape, x[0]), depth = std::max(0.0, top - x[1]);
    // gravity_z < 0: compression
    const double vertical = water ? gravity_z * water->overburden(density, x[1], top) : density * gravity_z * depth;
    for (std::size_t d = 0; d < Dim; ++d)
      particles.stress[d][p] = d == vertical_slot ? vertical : description.k0 * vertical;
    if constexpr (Dim == 2)
      particles.stress[out_of_plane][p] = description.k0 * vertical;
  }
}

/// A weakly compressible fluid at rest, d p / d depth = rho g with rho = rho0 (1 + p / K): more mass in the same
/// volume, so that the law, which knows the volume at zero pressure, finds the pressure: under water that beyond the
/// water's own.
template <int Dim>
void set_hydrostatic(const material::Parameters& material, const std::vector<Vec2>& shape, double gravity_z,
                     const std::optional<Water>& water, mpm::Particles<Dim>& particles)
{
  const double rho = material.density_kg_per_m3, bulk = material.bulk_modulus_pa;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x = in_section<Dim>(particles.position_of(p));
    const double top = top_at(shape, x[0]), depth = std::max(0.0, top - x[1]);
    const double pressure = water ? -gravity_z * water->overburden(rho, x[1], top) : -rho * gravity_z * depth;
    const double compression = std::exp(pressure / bulk);  // rho / rho0
    particles.initial_volume[p] = compression * particles.volume[p];
    particles.mass[p] = particles.weight_mass[p] = rho * particles.initial_volume[p];
  }
}

/// A velocity, a spin from y towards z about the middle of mass, and a sine over space, all in the section.
template <int Dim>
void set_velocity(const Vec2& velocity, double spin, const std::optional<VelocityWave>& wave,
                  mpm::Particles<Dim>& particles)
{
  Vec2 middle = Vec2::Zero();
  double mass = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    middle += particles.mass[p] * in_section<Dim>(particles.position_of(p));
    mass += particles.mass[p];
  }
  middle /= mass;
  constexpr std::size_t y = y_axis<Dim>, z = z_axis<Dim>;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x = in_section<Dim>(particles.position_of(p));
    Vec2 v = velocity + spin * Vec2(middle[1] - x[1], x[0] - middle[0]);
    if (wave)
      v += wave->amplitude_m_per_s * std::sin(wave->wave_number_rad_per_m.dot(x) + wave->phase_rad);
    particles.velocity[y][p] = v[0];
    particles.velocity[z][p] = v[1];
    if (!wave && spin != 0.0) {
      particles.affine[y * Dim + z][p] = -spin;
      particles.affine[z * Dim + y][p] = spin;
    }
  }
}

/// The particles of a body: of its section, in space row behind row along it, of what is computed of it.
template <int Dim>
struct Places {
  std::vector<Vec<Dim>> points;  ///< m
  std::vector<double> volumes;
  std::optional<Vec<Dim>> tile;  ///< as Sampling::tile
};

Places<2> places(const Sampling& section, const BodyDescription&, Symmetry, double, std::integral_constant<int, 2>)
{
  return { section.points, section.volumes, section.tile };
}

Places<3> places(const Sampling& section, const BodyDescription& body, Symmetry symmetry, double spacing,
                 std::integral_constant<int, 3>)
{
  Places<3> result;
  const double from = (*body.along_m)[0], length = (*body.along_m)[1] - from;
  const int rows = std::max(1, static_cast<int>(std::lround(length / spacing)));
  const double step = length / rows;
  for (int k = 0; k < rows; ++k) {
    const double x = from + (k + 0.5) * step;
    for (std::size_t i = 0; i < section.points.size(); ++i) {
      const Vec2& at = section.points[i];
      if ((symmetry != Symmetry::none && at[0] < 0.0) || (symmetry == Symmetry::quarter && x < 0.0))
        continue;
      result.points.emplace_back(x, at[0], at[1]);
      result.volumes.push_back(section.volumes[i] * step);
    }
  }
  return result;
}

template <int Dim>
void place(const Places<Dim>& places, double density, mpm::Particles<Dim>& particles)
{
  particles.resize(places.points.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    for (std::size_t d = 0; d < Dim; ++d)
      particles.position[d][p] = places.points[p][static_cast<Eigen::Index>(d)];
    particles.volume[p] = particles.initial_volume[p] = places.volumes[p];
    particles.mass[p] = particles.weight_mass[p] = density * places.volumes[p];
  }
}

/// Side of a square, or cube, of the particles' mean volume, m.
template <int Dim>
double mean_width(const mpm::Particles<Dim>& particles)
{
  double volume = 0.0;
  for (const double v : particles.initial_volume)
    volume += v;
  const double mean = volume / static_cast<double>(particles.size());
  return Dim == 2 ? std::sqrt(mean) : std::cbrt(mean);
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

/// A geotextile as it is described, not yet in a field.
ModelSheet<2> lay_sheet(const std::string& name, const GeotextileDescription& description,
                        const SceneDescription& scene, std::integral_constant<int, 2>)
{
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
  return { name, 0, std::move(laid), strength, strength };
}

/// The surface of a body in space: what of it is not on a plane of symmetry.
ModelSheet<3> lay_sheet(const std::string& name, const GeotextileDescription& description,
                        const SceneDescription& scene, std::integral_constant<int, 3>)
{
  geotextile::SheetLayout section = sheet_layout(description, scene);
  geotextile::Fullness fullness;
  fullness.around = unstretched_length(description, section) / section.cloth_length();
  if (scene.symmetry() != Symmetry::none)
    section = { port_arc(section.points), false, {} };
  const Vec2& along = *scene.bodies.at(description.encloses).along_m;
  const bool quarter = scene.symmetry() == Symmetry::quarter;
  const Vec2& space = scene.space->along_m;
  // An end that lies in the end of the space is held by its roller, and open.
  const geotextile::ClosedEnds closed{ !quarter && along[0] > space[0], along[1] < space[1] };
  geotextile::MembraneParameters parameters;
  parameters.warp.stiffness = description.stiffness_n_per_m;
  parameters.warp.force_strain = description.force_strain_table;
  parameters.weft.stiffness = description.stiffness_weft_n_per_m.value_or(description.stiffness_n_per_m);
  parameters.weft.force_strain = description.force_strain_weft_table.empty() && !description.stiffness_weft_n_per_m
                                     ? description.force_strain_table
                                     : description.force_strain_weft_table;
  parameters.mass = description.mass_kg_per_m2;
  parameters.computational_mass = description.computational_mass_kg_per_m2;
  parameters.gauge_length = description.gauge_length_m;
  parameters.rupture_strain = description.rupture_strain;
  geotextile::Membrane laid(geotextile::wrap(section, { quarter ? 0.0 : along[0], along[1] }, closed,
                                             description.segment_length_m, fullness),
                            parameters);
  const double weft = description.strength_weft_n_per_m.value_or(description.strength_n_per_m);
  return { name, 0, std::move(laid), geotextile::Strength(description.strength_n_per_m, description.seam_efficiency),
           geotextile::Strength(weft, description.seam_efficiency) };
}

/// A rigid surface drawn in the section: in space through all of it.
contact::BoundaryBody<2> extruded(const std::string& name, contact::Surface section, double friction, double spacing,
                                  const SceneDescription&, std::integral_constant<int, 2>)
{
  return { name, std::move(section), friction, spacing };
}

contact::BoundaryBody<3> extruded(const std::string& name, contact::Surface section, double friction, double spacing,
                                  const SceneDescription& scene, std::integral_constant<int, 3>)
{
  const double from = scene.symmetry() == Symmetry::quarter ? 0.0 : scene.space->along_m[0];
  return { name, std::move(section), contact::Along{ from, scene.space->along_m[1] }, friction, spacing };
}

/// Half of an end of the hopper.
contact::BoundaryBody<3> bulkhead(const HullPart& part, double spacing, const HullDescription& hull)
{
  std::vector<Vec2> half = half_of_hopper(hull);
  if (part.half == barge::HullHalf::starboard)
    for (Vec2& point : half)
      point[0] = -point[0];
  const bool aft = part.what == HullPart::What::aft_bulkhead;
  return contact::BoundaryBody<3>::plate(part.name, contact::Surface(std::move(half), true),
                                         (*hull.along_m)[aft ? 0 : 1], aft ? 1.0 : -1.0, hull.friction, spacing);
}

/// A corner of the grid: of the part of the scene that is computed.
template <int Dim>
Vec<Dim> lower_corner(const SceneDescription& scene)
{
  Vec<Dim> corner = in_space<Dim>(scene.grid.lower_m);
  if constexpr (Dim == 3) {
    corner[0] = scene.symmetry() == Symmetry::quarter ? 0.0 : scene.space->along_m[0];
    corner[1] = scene.symmetry() == Symmetry::none ? corner[1] : 0.0;
  }
  return corner;
}
template <int Dim>
Vec<Dim> upper_corner(const SceneDescription& scene)
{
  Vec<Dim> corner = in_space<Dim>(scene.grid.upper_m);
  if constexpr (Dim == 3)
    corner[0] = scene.space->along_m[1];
  return corner;
}

/// Conditions on the faces of that part: planes of symmetry are rollers.
template <int Dim>
std::array<FaceCondition, 2 * Dim> faces(const SceneDescription& scene)
{
  if constexpr (Dim == 2) {
    return scene.grid.faces;
  } else {
    const auto& [x_min, x_max] = scene.space->faces;
    const auto& [y_min, y_max, z_min, z_max] = scene.grid.faces;
    return { scene.symmetry() == Symmetry::quarter ? FaceCondition::roller : x_min,
             x_max,
             scene.symmetry() == Symmetry::none ? y_min : FaceCondition::roller,
             y_max,
             z_min,
             z_max };
  }
}

}  // namespace

template <int Dim>
Model<Dim>::Model(const SceneDescription& scene, int threads)
    : team_(make_team(threads))
    , method_(scene.numerics.method)
    , constant_gravity_(in_space<Dim>(scene.gravity_table.empty() ? scene.gravity_m_per_s2 : Vec2(Vec2::Zero())))
    , gravity_table_(scene.gravity_table)
    , time_step_factor_(scene.numerics.time_step_factor)
    , max_step_(scene.numerics.max_step_s)
    , max_travel_(scene.numerics.max_travel_cells * scene.grid.cell_size_m)
    , lower_(lower_corner<Dim>(scene))
    , upper_(upper_corner<Dim>(scene))
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

template <int Dim>
std::size_t Model<Dim>::field_index(const std::string& name) const
{
  const std::string field = name.empty() ? common_field : name;
  const auto found = std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.name == field; });
  return static_cast<std::size_t>(found - fields_.begin());
}

template <int Dim>
void Model<Dim>::build_fields(const SceneDescription& scene)
{
  for (const std::string& name : scene.velocity_fields())
    add_field(name, scene);
}

template <int Dim>
void Model<Dim>::add_field(const std::string& name, const SceneDescription& scene)
{
  fields_.emplace_back(name, mpm::Grid<Dim>(lower_, upper_, scene.grid.cell_size_m, faces<Dim>(scene)));
  now_.contact.emplace_back(method_.shape);
}

template <int Dim>
void Model<Dim>::build_bodies(const SceneDescription& scene)
{
  for (const auto& [name, description] : scene.bodies) {
    const material::Parameters& material = scene.materials.at(description.material);
    const std::vector<Vec2> shape = outline(description.shape, scene.hull, scene.grid.cell_size_m);
    const double spacing = scene.grid.cell_size_m / description.particles_per_cell;
    Places<Dim> where = places(sample(description.shape, shape, spacing), description, scene.symmetry(), spacing,
                               std::integral_constant<int, Dim>{});
    if (description.jitter > 0.0)
      jitter<Dim>(description.jitter * spacing, where.points);
    if (where.points.empty())
      throw InputError(scene.source, "bodies." + name + ".shape", "", "must be large enough to hold a particle");

    Body body;
    body.name = name;
    body.field = field_index(description.velocity_field);
    body.law = material::make_law<Dim>(material);
    const double shear = material::shear_modulus(material);
    body.elastic = { material::constrained_modulus(material) - 2.0 * shear, shear };
    body.viscous = material::is_fluid(material.law) ? mpm::Moduli{ -2.0 / 3.0, 1.0 } : body.elastic;
    const material::DampingModuli damping = material::damping_moduli(material);
    body.damping = { damping.lambda, damping.shear };
    mpm::Particles<Dim>& particles = body.particles;
    body.density = material.density_kg_per_m3;
    place<Dim>(where, body.density, particles);
    if (body.law->needs_deformation())
      particles.use_deformation();
    if (method_.shape == mpm::Shape::gimp) {
      particles.use_boxes();
      for (std::size_t d = 0; d < Dim && where.tile; ++d)
        particles.box[d].assign(particles.size(), (*where.tile)[static_cast<Eigen::Index>(d)]);
    }
    body.row = particles.id;
    body.start = std::make_shared<const std::vector<Vec<Dim>>>(where.points);
    set_velocity<Dim>(description.initial_velocity_m_per_s, description.initial_spin_rad_per_s,
                      description.initial_velocity_wave, particles);
    if constexpr (Dim == 2)
      if (description.manufactured) {
        body.manufactured = std::make_shared<const Manufactured>(*description.manufactured, material);
        start_on_solution(*body.manufactured, particles);
      }
    if (description.initial_stress == InitialStress::hydrostatic)
      set_hydrostatic<Dim>(material, shape, scene.gravity_at(0.0)[1], water_, particles);
    else if (description.initial_stress != InitialStress::none)
      set_k0_stress<Dim>(description, body.density, shape, scene.gravity_at(0.0)[1], water_, particles);
    if constexpr (Dim == 2)
      if (water_) {
        body.particle_height = mean_width<Dim>(particles);
        water_->place(body.density, body.particle_height, particles);
      }
    body.law->initialise(particles.batch(), 0, particles.size());
    now_.bodies.push_back(std::move(body));
  }
}

template <int Dim>
void Model<Dim>::build_sheets(const SceneDescription& scene)
{
  for (const auto& [name, description] : scene.geotextiles) {
    ModelSheet sheet = lay_sheet(name, description, scene, std::integral_constant<int, Dim>{});
    if (description.encloses.empty()) {
      sheet.field = field_index(description.velocity_field);
      set_velocity<Dim>(description.initial_velocity_m_per_s, 0.0, description.initial_velocity_wave,
                        sheet.sheet.nodes());
    } else {
      const BodyDescription& inside = scene.bodies.at(description.encloses);
      sheet.field = field_index(inside.velocity_field);
      if (description.interface == SheetInterface::frictional) {
        sheet.field = fields_.size();
        add_field(name, scene);
      }
      set_velocity<Dim>(inside.initial_velocity_m_per_s, 0.0, std::nullopt, sheet.sheet.nodes());
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
        held_ends_.push_back({ now_.sheets.size(), node, sheet.sheet.nodes().position_of(node), end->motion_table });
    sheet.sheet.update_forces();  // what is tense as laid is so from the start
    sheet_descriptions_.push_back(description);
    now_.sheets.push_back(std::move(sheet));
  }
}

template <int Dim>
void Model<Dim>::build_boundaries(const SceneDescription& scene)
{
  const double spacing = boundary_spacing_cells * scene.grid.cell_size_m;
  if (scene.hull) {
    const barge::SplitHull hull(
        scene.hull->hinge_m,
        barge::round_corners(scene.hull->port_section_m, scene.hull->lip_radius_m, arc_turn_rad, "hull.lip_radius_m"),
        "hull");
    for (const HullPart& part : hull_parts(scene)) {
      if (part.what == HullPart::What::wall)
        boundaries_.push_back(extruded(part.name, contact::Surface(hull.closed_section_m(part.half)),
                                       scene.hull->friction, spacing, scene, std::integral_constant<int, Dim>{}));
      else if constexpr (Dim == 3)
        boundaries_.push_back(bulkhead(part, spacing, *scene.hull));
    }
  }
  for (const auto& [name, surface] : scene.surfaces) {
    std::vector<Vec2> line = surface.line_m;
    if (surface.corner_radius_m > 0.0)
      line = barge::round_corners(line, surface.corner_radius_m, arc_turn_rad, "surfaces." + name + ".corner_radius_m");
    boundaries_.push_back(extruded(name, contact::Surface(std::move(line), surface.closed), surface.friction, spacing,
                                   scene, std::integral_constant<int, Dim>{}));
  }
  now_.boundary_totals.resize(boundaries_.size());
}

template <int Dim>
void Model<Dim>::build_loads(const SceneDescription& scene)
{
  for (const auto& [name, support] : scene.supports)
    supports_.push_back(support);
  if constexpr (Dim == 2)
    build_tractions(scene);
}

template <int Dim>
void Model<Dim>::build_tractions(const SceneDescription& scene)
{
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

template <int Dim>
std::size_t Model<Dim>::add_tracer(std::size_t body, const Vec<Dim>& at)
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

template class Model<2>;
template class Model<3>;

}  // namespace geocontainer_mpm::scene
