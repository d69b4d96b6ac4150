/// From a description to bodies, sheets, boundaries and loads.

#include <algorithm>

#include "geocontainer_mpm/barge/split_hull.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/scene/shapes.h"
#include "model_particles.h"
#include "model_surfaces.h"

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
    , transfer_memory_s_(scene.numerics.transfer_memory_s)
    , constant_gravity_(in_space<Dim>(scene.gravity_table.empty() ? scene.gravity_m_per_s2 : Vec2(Vec2::Zero())))
    , gravity_table_(scene.gravity_table)
    , time_step_factor_(scene.numerics.time_step_factor)
    , max_step_(scene.numerics.max_step_s)
    , max_travel_(scene.numerics.max_travel_cells * scene.grid.cell_size_m)
    , lower_(lower_corner<Dim>(scene))
    , upper_(upper_corner<Dim>(scene))
{
  if (scene.water)
    water_.emplace(*scene.water, scene.water_level_m(), -scene.gravity_m_per_s2[1], scene.symmetry());
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
    Places<Dim> where = places<Dim>(sample(description.shape, shape, spacing), description, scene.symmetry(), spacing);
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
    ModelSheet sheet = lay_sheet<Dim>(name, description, scene);
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
        boundaries_.push_back(rigid_surface<Dim>(part.name, contact::Surface(hull.closed_section_m(part.half)),
                                                 scene.hull->friction, spacing, scene));
      else if constexpr (Dim == 3)
        boundaries_.push_back(bulkhead(part, spacing, *scene.hull));
    }
  }
  for (const auto& [name, surface] : scene.surfaces) {
    std::vector<Vec2> line = surface.line_m;
    if (surface.corner_radius_m > 0.0)
      line = barge::round_corners(line, surface.corner_radius_m, arc_turn_rad, "surfaces." + name + ".corner_radius_m");
    boundaries_.push_back(
        rigid_surface<Dim>(name, contact::Surface(std::move(line), surface.closed), surface.friction, spacing, scene));
  }
  now_.boundary_totals.resize(boundaries_.size());
}

template <int Dim>
void Model<Dim>::build_loads(const SceneDescription& scene)
{
  for (const auto& [name, support] : scene.supports)
    supports_.push_back(support);
  build_tractions(scene);
}

template <int Dim>
void Model<Dim>::build_tractions(const SceneDescription& scene)
{
  if constexpr (Dim == 2) {
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
