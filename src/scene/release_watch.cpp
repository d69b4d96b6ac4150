#include "geocontainer_mpm/scene/release_watch.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::scene {
namespace {

/// A hull counts as open once its slot is wider than this, m: more than play and sensor noise make of a closed one.
constexpr double open_slot_m = 0.05;

double volume_of(const Body& body)
{
  double volume = 0.0;
  for (double v : body.particles.volume)
    volume += v;
  return volume;
}

double soil_volume(const Model& model)
{
  double volume = 0.0;
  for (const Body& body : model.bodies())
    for (double v : body.particles.volume)
      volume += v;
  return volume;
}

struct Extent {
  Vec3 lower = Vec3::Constant(1e300), upper = -lower;

  void add(const mpm::Particles<2>& particles)
  {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec3 x = in_barge_frame(Vec2(particles.position[0][p], particles.position[1][p]));
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  }

  void put_into(ContainerState& state) const
  {
    state.length_m = upper[0] - lower[0];
    state.width_m = upper[1] - lower[1];
    state.height_m = upper[2] - lower[2];
  }
};

/// In plane strain particles keep yy, zz, yz, xx.
SymmetricTensor barge_stress(const mpm::Particles<2>& particles, std::size_t p)
{
  const auto s = [&](std::size_t k) { return particles.stress[k][p]; };
  return { s(3), s(0), s(1), 0.0, 0.0, s(2) };
}

}  // namespace

ReleaseWatch::ReleaseWatch(const SceneDescription& scene)
    : hung_up_after_s_(scene.outcome.hung_up_after_s), watched_(scene.geotextiles.size())
{
  if (scene.hull && !scene.geotextiles.empty())
    hull_.emplace(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
  for (ContainerStatus& watched : watched_)
    watched.outcome = hull_ ? Outcome::waiting : Outcome::none;
}

void ReleaseWatch::observe(const Model& model, double time_s, const barge::OpeningAngles& opening, double still_for_s)
{
  if (initial_volume_ < 0.0) {
    initial_volume_ = soil_volume(model);
    for (std::size_t s = 0; s < watched_.size(); ++s)
      if (model.sheets()[s].inside)
        watched_[s].soil_volume_initial = volume_of(model.bodies()[*model.sheets()[s].inside]);
    for (const Body& body : model.bodies())
      held_.push_back(body.held);
  }
  open_episodes(model, time_s);
  for (std::size_t s = 0; s < watched_.size(); ++s) {
    measure(model.sheets()[s], time_s, watched_[s]);
    if (hull_)
      judge(model.sheets()[s], time_s, opening, still_for_s, watched_[s]);
  }
}

/// For every container one since a body has started. Called before the tensions of this look are known.
void ReleaseWatch::open_episodes(const Model& model, double time_s)
{
  for (std::size_t b = 0; b < held_.size(); ++b) {
    if (!held_[b] || model.bodies()[b].held)
      continue;
    held_[b] = false;
    for (ContainerStatus& watched : watched_)
      watched.episodes.push_back({ model.bodies()[b].name, time_s, watched.current_tension_n_per_m, 0.0, time_s });
  }
}

void ReleaseWatch::measure(const ModelSheet& what, double time_s, ContainerStatus& watched)
{
  const geotextile::Sheet& sheet = what.sheet;
  sheet.gauge_tension(gauge_);
  const auto largest = std::max_element(gauge_.begin(), gauge_.end());
  watched.current_tension_n_per_m = std::max(0.0, *largest);
  watched.elongation_max = std::max(watched.elongation_max, sheet.largest_strain());
  const geotextile::Utilisation used = what.strength.utilisation(gauge_);
  watched.peak_utilisation_sheet = std::max(watched.peak_utilisation_sheet, used.sheet);
  watched.peak_utilisation_seam = std::max(watched.peak_utilisation_seam, used.seam);
  watched.ruptures = sheet.ruptures();
  if (watched.rupture_time_s < 0.0 && watched.ruptures > 0) {
    watched.rupture_time_s = time_s;
    watched.rupture_position_m = in_barge_frame(sheet.rupture_place());
  }
  if (!watched.episodes.empty() && *largest > watched.episodes.back().peak_n_per_m) {
    watched.episodes.back().peak_n_per_m = *largest;
    watched.episodes.back().peak_time_s = time_s;
  }
  if (*largest > watched.peak_tension_n_per_m) {
    const auto segment = static_cast<std::size_t>(largest - gauge_.begin());
    watched.peak_tension_n_per_m = *largest;
    watched.peak_tension_time_s = time_s;
    watched.peak_tension_position_m = in_barge_frame(0.5 * (sheet.node(segment) + sheet.node(sheet.end_of(segment))));
  }
}

void ReleaseWatch::judge(const ModelSheet& sheet, double time_s, const barge::OpeningAngles& opening,
                         double still_for_s, ContainerStatus& watched) const
{
  if (sheet.held || watched.outcome == Outcome::released ||
      (watched.outcome == Outcome::waiting && hull_->slot_width_m(opening) < open_slot_m))
    return;
  const mpm::Column& z = sheet.sheet.nodes().position[1];
  if (*std::max_element(z.begin(), z.end()) < hull_->lowest_level_m(opening)) {
    watched.outcome = Outcome::released;
    watched.release_time_s = time_s;
  } else {
    watched.outcome = still_for_s >= hung_up_after_s_ ? Outcome::hung_up : Outcome::releasing;
  }
}

/// Of all together: released when the last is, hung up when one is.
Outcome ReleaseWatch::outcome() const
{
  if (!hull_)
    return Outcome::none;
  const auto any = [this](Outcome outcome) {
    return std::any_of(watched_.begin(), watched_.end(),
                       [outcome](const ContainerStatus& w) { return w.outcome == outcome; });
  };
  for (const Outcome outcome : { Outcome::hung_up, Outcome::releasing, Outcome::waiting })
    if (any(outcome))
      return outcome;
  return Outcome::released;
}

StatusFrame ReleaseWatch::status(const Model& model) const
{
  StatusFrame status;
  status.outcome = outcome();
  for (const ContainerStatus& watched : watched_) {
    if (status.outcome == Outcome::released)
      status.release_time_s = std::max(status.release_time_s, watched.release_time_s);
    status.current_tension_n_per_m = std::max(status.current_tension_n_per_m, watched.current_tension_n_per_m);
    status.elongation_max = std::max(status.elongation_max, watched.elongation_max);
    status.peak_utilisation_sheet = std::max(status.peak_utilisation_sheet, watched.peak_utilisation_sheet);
    status.peak_utilisation_seam = std::max(status.peak_utilisation_seam, watched.peak_utilisation_seam);
    status.ruptures += watched.ruptures;
    if (watched.ruptures > 0 && (status.rupture_time_s < 0.0 || watched.rupture_time_s < status.rupture_time_s)) {
      status.rupture_time_s = watched.rupture_time_s;
      status.rupture_position_m = watched.rupture_position_m;
    }
    if (watched.peak_tension_n_per_m <= status.peak_tension_n_per_m)
      continue;
    status.peak_tension_n_per_m = watched.peak_tension_n_per_m;
    status.peak_tension_time_s = watched.peak_tension_time_s;
    status.peak_tension_position_m = watched.peak_tension_position_m;
  }
  status.soil_volume = soil_volume(model);
  status.soil_volume_initial = initial_volume_;

  Extent extent;
  for (const Body& body : model.bodies())
    extent.add(body.particles);
  for (const ModelSheet& sheet : model.sheets())
    extent.add(sheet.sheet.nodes());
  status.centroid_m = in_barge_frame(model.centroid());
  extent.put_into(status);
  for (std::size_t s = 0; s < watched_.size(); ++s)
    if (model.sheets()[s].inside)
      status.containers.push_back(container(model, s));
  return status;
}

ContainerStatus ReleaseWatch::container(const Model& model, std::size_t sheet) const
{
  const ModelSheet& around = model.sheets()[sheet];
  const Body& body = model.bodies()[*around.inside];
  ContainerStatus status = watched_[sheet];
  status.name = around.name;
  status.soil_volume = volume_of(body);
  Extent extent;
  extent.add(body.particles);
  extent.add(around.sheet.nodes());
  extent.put_into(status);
  double mass = 0.0;
  for (std::size_t p = 0; p < body.particles.size(); ++p) {
    status.centroid_m += body.own_mass(p) * in_barge_frame(body.position(p));
    mass += body.own_mass(p);
  }
  status.centroid_m /= mass;
  return status;
}

void fill_frame(const Model& model, const SceneDescription& scene, const std::vector<Vec2>& boundary_force,
                Frame& frame)
{
  for (const Body& body : model.bodies()) {
    const mpm::Particles<2>& particles = body.particles;
    SoilFrame soil;
    soil.name = body.name;
    const std::size_t n = particles.size();
    soil.position.resize(n);
    soil.velocity.resize(n);
    soil.stress.resize(n);
    soil.volume.resize(n);
    for (std::size_t p = 0; p < n; ++p) {
      const std::size_t row = particles.id[p];  // order of creation, so that a row is one particle in every frame
      soil.position[row] = in_barge_frame(Vec2(particles.position[0][p], particles.position[1][p]));
      soil.velocity[row] = in_barge_frame(Vec2(particles.velocity[0][p], particles.velocity[1][p]));
      soil.stress[row] = barge_stress(particles, p);
      soil.volume[row] = particles.volume[p];
    }
    frame.soil.push_back(std::move(soil));
  }
  for (const ModelSheet& enclosing : model.sheets()) {
    const geotextile::Sheet& sheet = enclosing.sheet;
    const GeotextileDescription& description = scene.geotextiles.at(enclosing.name);
    GeotextileFrame geotextile;
    geotextile.name = enclosing.name;
    geotextile.closed = sheet.closed();
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i) {
      geotextile.node.push_back(in_barge_frame(sheet.node(i)));
      geotextile.velocity.push_back(in_barge_frame(Vec2(sheet.nodes().velocity[0][i], sheet.nodes().velocity[1][i])));
    }
    geotextile.tension = sheet.tension();
    sheet.gauge_tension(geotextile.gauge_tension);
    geotextile.gauge_length_m = description.gauge_length_m;
    geotextile.strength_n_per_m = description.strength_n_per_m;
    geotextile.seam_strength_n_per_m = enclosing.strength.weakest_seam();
    frame.geotextile.push_back(std::move(geotextile));
  }
  for (std::size_t b = 0; b < model.boundaries().size(); ++b) {
    const contact::BoundaryBody& body = model.boundaries()[b];
    BoundaryFrame boundary;
    boundary.name = body.name();
    for (std::size_t p = 0; p < body.size(); ++p)
      boundary.position.push_back(in_barge_frame(body.reference(p)));
    boundary.force = in_barge_frame(boundary_force[b]);
    boundary.closed = body.closed();
    frame.boundary.push_back(std::move(boundary));
  }
}

}  // namespace geocontainer_mpm::scene
