#include "explained_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocontainer_mpm::scene {
namespace {

template <int Count>
double largest_factor(const TimeTable<Count>& table)
{
  double largest = table.empty() ? 1.0 : 0.0;
  for (const TableRow<Count>& row : table)
    largest = std::max(largest, std::abs(row.value[0]));
  return largest;
}

double gravity(const SceneDescription& scene)
{
  double strongest = scene.gravity_table.empty() ? scene.gravity_m_per_s2.norm() : 0.0;
  for (const TableRow<2>& row : scene.gravity_table)
    strongest = std::max(strongest, std::hypot(row.value[0], row.value[1]));
  return strongest;
}

template <int Dim>
double speed_at_start(const Model<Dim>& model)
{
  double square = 0.0;
  const auto look = [&](const mpm::Particles<Dim>& particles) {
    for (std::size_t p = 0; p < particles.size(); ++p)
      square = std::max(square, particles.velocity_of(p).squaredNorm());
  };
  for (const Body<Dim>& body : model.bodies())
    look(body.particles);
  for (const ModelSheet<Dim>& sheet : model.sheets())
    look(sheet.sheet.nodes());
  return std::sqrt(square);
}

/// Stress over impedance: what flies off when a stress is set free.
template <int Dim>
double set_free(const SceneDescription& scene, const Model<Dim>& model)
{
  double speed = 0.0;
  for (const Body<Dim>& body : model.bodies()) {
    const mpm::Particles<Dim>& particles = body.particles;
    const double modulus = body.elastic.constrained();
    for (std::size_t p = 0; p < particles.size(); ++p) {
      double stress = 0.0;
      for (std::size_t d = 0; d < Dim; ++d)
        stress += std::abs(particles.stress[d][p]);
      speed = std::max(speed, stress * std::sqrt(particles.volume[p] / (modulus * particles.mass[p])));
    }
  }
  for (const ModelSheet<Dim>& sheet : model.sheets()) {
    const GeotextileDescription& what = scene.geotextiles.at(sheet.name);
    for (const double tension : sheet.sheet.tension())
      speed = std::max(speed, tension / std::sqrt(what.stiffness_n_per_m * what.computational_mass_kg_per_m2));
  }
  return speed;
}

/// The largest acceleration that loads give to what they act on, m/s^2: a row of particles, or a sheet.
double acceleration_of_loads(const SceneDescription& scene)
{
  double lightest = std::numeric_limits<double>::infinity();  // kg/m^2
  for (const auto& [name, body] : scene.bodies)
    lightest = std::min(lightest, scene.materials.at(body.material).density_kg_per_m3 * scene.grid.cell_size_m /
                                      body.particles_per_cell);
  for (const auto& [name, sheet] : scene.geotextiles)
    lightest = std::min(lightest, sheet.computational_mass_kg_per_m2);
  const double size = (scene.grid.upper_m - scene.grid.lower_m).norm();
  double pressure = 0.0, pull = 0.0;
  for (const auto& [name, traction] : scene.tractions)
    pressure = std::max(
        pressure, (traction.traction_pa.norm() + std::abs(traction.pressure_pa)) * largest_factor(traction.table));
  for (const auto& [name, sheet] : scene.geotextiles) {
    if (sheet.inside_pressure)
      pressure = std::max(
          pressure, (std::abs(sheet.inside_pressure->pressure_pa) + sheet.inside_pressure->gradient_pa_per_m * size) *
                        largest_factor(sheet.inside_pressure->table));
    for (const SheetEnd& end : { sheet.start, sheet.end })
      pull = std::max(pull, end.force_n_per_m.norm() * largest_factor(end.force_table) /
                                (sheet.computational_mass_kg_per_m2 * sheet.segment_length_m));
  }
  return pressure / lightest + pull;
}

/// Of supports and of held ends of sheets.
double led_speed(const SceneDescription& scene)
{
  double speed = 0.0;
  for (const auto& [name, support] : scene.supports)
    for (const TableRow<2>& row : support.velocity_table)
      speed = std::max(speed, std::hypot(row.value[0], row.value[1]));
  for (const auto& [name, sheet] : scene.geotextiles)
    for (const SheetEnd& end : { sheet.start, sheet.end })
      for (std::size_t i = 1; i < end.motion_table.size(); ++i) {
        const TableRow<2>&from = end.motion_table[i - 1], &to = end.motion_table[i];
        speed = std::max(
            speed, std::hypot(to.value[0] - from.value[0], to.value[1] - from.value[1]) / (to.time_s - from.time_s));
      }
  return speed;
}

}  // namespace

template <int Dim>
double explained_speed(const SceneDescription& scene, const Model<Dim>& model)
{
  for (const auto& [name, body] : scene.bodies)
    if (body.manufactured)
      return std::numeric_limits<double>::infinity();
  const double way = (scene.grid.upper_m - scene.grid.lower_m).norm(), loads = acceleration_of_loads(scene);
  return std::max(push_out_speed,
                  speed_at_start(model) + set_free(scene, model) + std::sqrt(2.0 * gravity(scene) * way) +
                      std::min(loads * scene.time.end_s, std::sqrt(2.0 * loads * way)) + led_speed(scene));
}

template <int Dim>
double fastest_wall(const Model<Dim>& model, const StepInput& step)
{
  double way = 0.0;
  for (std::size_t b = 0; b < model.boundaries().size(); ++b) {
    // The way that a rigid motion makes is convex over the body, so that a corner of its box goes furthest.
    const contact::BoundaryBody<Dim>& body = model.boundaries()[b];
    const Vec2 lower = in_section(body.reference_lower()), upper = in_section(body.reference_upper());
    for (const Vec2& corner : { lower, upper, Vec2(lower[0], upper[1]), Vec2(upper[0], lower[1]) })
      way = std::max(way, (step.end[b].apply(corner) - step.start[b].apply(corner)).norm());
  }
  return way / step.dt_s;
}

template double explained_speed(const SceneDescription&, const Model<2>&);
template double explained_speed(const SceneDescription&, const Model<3>&);
template double fastest_wall(const Model<2>&, const StepInput&);
template double fastest_wall(const Model<3>&, const StepInput&);

}  // namespace geocontainer_mpm::scene
