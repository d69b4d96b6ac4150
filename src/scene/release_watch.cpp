#include "geocontainer_mpm/scene/release_watch.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::scene {
namespace {

/// A hull counts as open once its slot is wider than this, m: more than play and sensor noise make of a closed one.
constexpr double open_slot_m = 0.05;

template <int Dim>
double volume_of(const Body<Dim>& body)
{
  double volume = 0.0;
  for (double v : body.particles.volume)
    volume += v;
  return volume;
}

template <int Dim>
double soil_volume(const Model<Dim>& model)
{
  double volume = 0.0;
  for (const Body<Dim>& body : model.bodies())
    for (double v : body.particles.volume)
      volume += v;
  return volume;
}

template <int Dim>
struct Extent {
  Vec<Dim> lower = Vec<Dim>::Constant(1e300), upper = -lower;

  void add(const mpm::Particles<Dim>& particles)
  {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec<Dim> x = particles.position_of(p);
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  }
};

/// Where a sheet is tensest, by its gauge, and how much of its strengths is used anywhere.
struct Tense {
  double tension;     ///< N/m
  std::size_t piece;  ///< segment or triangle
  geotextile::Utilisation used;
};

Tense most_tense(const std::vector<double>& gauge, const geotextile::Strength& strength)
{
  const auto largest = std::max_element(gauge.begin(), gauge.end());
  return { *largest, static_cast<std::size_t>(largest - gauge.begin()), strength.utilisation(gauge) };
}

Tense most_tense(const ModelSheet<2>& sheet, std::array<std::vector<double>, 1>& gauge)
{
  sheet.sheet.gauge_tension(gauge[0]);
  return most_tense(gauge[0], sheet.strength);
}

Tense most_tense(const ModelSheet<3>& sheet, std::array<std::vector<double>, 2>& gauge)
{
  sheet.sheet.gauge_tension(gauge[0], gauge[1]);
  const Tense warp = most_tense(gauge[0], sheet.strength), weft = most_tense(gauge[1], sheet.strength_weft);
  Tense most = warp.tension >= weft.tension ? warp : weft;
  most.used = { std::max(warp.used.sheet, weft.used.sheet), std::max(warp.used.seam, weft.used.seam) };
  return most;
}

Vec3 middle_of(const geotextile::Sheet& sheet, std::size_t segment)
{
  return in_space<3>(Vec2(0.5 * (sheet.node(segment) + sheet.node(sheet.end_of(segment)))));
}

Vec3 middle_of(const geotextile::Membrane& sheet, std::size_t triangle)
{
  const auto& [a, b, c] = sheet.triangles()[triangle];
  return (sheet.node(a) + sheet.node(b) + sheet.node(c)) / 3.0;
}

}  // namespace

template <int Dim>
ReleaseWatch<Dim>::ReleaseWatch(const SceneDescription& scene)
    : hung_up_after_s_(scene.outcome.hung_up_after_s), watched_(scene.geotextiles.size())
{
  if (scene.hull && !scene.geotextiles.empty()) {
    hull_.emplace(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
    for (Watched& watched : watched_)
      watched.outcome = Outcome::waiting;
  }
}

template <int Dim>
void ReleaseWatch<Dim>::observe(const Model<Dim>& model, double time_s, const barge::OpeningAngles& opening,
                                double still_for_s)
{
  if (initial_volume_ < 0.0) {
    initial_volume_ = soil_volume(model);
    for (std::size_t s = 0; s < watched_.size(); ++s)
      if (model.sheets()[s].inside)
        watched_[s].initial_volume = volume_of(model.bodies()[*model.sheets()[s].inside]);
    for (const Body<Dim>& body : model.bodies())
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
template <int Dim>
void ReleaseWatch<Dim>::open_episodes(const Model<Dim>& model, double time_s)
{
  for (std::size_t b = 0; b < held_.size(); ++b) {
    if (!held_[b] || model.bodies()[b].held)
      continue;
    held_[b] = false;
    for (Watched& watched : watched_)
      watched.episodes.push_back({ model.bodies()[b].name, time_s, watched.current, 0.0, time_s });
  }
}

template <int Dim>
void ReleaseWatch<Dim>::measure(const ModelSheet<Dim>& what, double time_s, Watched& watched)
{
  const SheetOf<Dim>& sheet = what.sheet;
  const Tense now = most_tense(what, gauge_);
  watched.current = std::max(0.0, now.tension);
  watched.elongation = std::max(watched.elongation, sheet.largest_strain());
  watched.used = { std::max(watched.used.sheet, now.used.sheet), std::max(watched.used.seam, now.used.seam) };
  watched.ruptures = sheet.ruptures();
  if (watched.rupture_time_s < 0.0 && watched.ruptures > 0) {
    watched.rupture_time_s = time_s;
    watched.rupture_position = in_space<3>(sheet.rupture_place());
  }
  if (!watched.episodes.empty() && now.tension > watched.episodes.back().peak_n_per_m) {
    watched.episodes.back().peak_n_per_m = now.tension;
    watched.episodes.back().peak_time_s = time_s;
  }
  if (now.tension > watched.peak) {
    watched.peak = now.tension;
    watched.peak_time_s = time_s;
    watched.peak_position = middle_of(sheet, now.piece);
  }
}

template <int Dim>
void ReleaseWatch<Dim>::judge(const ModelSheet<Dim>& sheet, double time_s, const barge::OpeningAngles& opening,
                              double still_for_s, Watched& watched) const
{
  if (sheet.held || watched.outcome == Outcome::released ||
      (watched.outcome == Outcome::waiting && hull_->slot_width_m(opening) < open_slot_m))
    return;
  const mpm::Column& z = sheet.sheet.nodes().position[z_axis<Dim>];
  if (*std::max_element(z.begin(), z.end()) < hull_->lowest_level_m(opening)) {
    watched.outcome = Outcome::released;
    watched.release_time_s = time_s;
  } else {
    watched.outcome = still_for_s >= hung_up_after_s_ ? Outcome::hung_up : Outcome::releasing;
  }
}

/// Of all together: released when the last is, hung up when one is.
template <int Dim>
Outcome ReleaseWatch<Dim>::outcome() const
{
  if (!hull_)
    return Outcome::none;
  const auto any = [this](Outcome outcome) {
    return std::any_of(watched_.begin(), watched_.end(), [outcome](const Watched& w) { return w.outcome == outcome; });
  };
  for (const Outcome outcome : { Outcome::hung_up, Outcome::releasing, Outcome::waiting })
    if (any(outcome))
      return outcome;
  return Outcome::released;
}

template <int Dim>
StatusFrame ReleaseWatch<Dim>::status(const Model<Dim>& model) const
{
  StatusFrame status;
  status.outcome = outcome();
  for (const Watched& watched : watched_) {
    if (status.outcome == Outcome::released)
      status.release_time_s = std::max(status.release_time_s, watched.release_time_s);
    status.current_tension_n_per_m = std::max(status.current_tension_n_per_m, watched.current);
    status.elongation_max = std::max(status.elongation_max, watched.elongation);
    status.peak_utilisation_sheet = std::max(status.peak_utilisation_sheet, watched.used.sheet);
    status.peak_utilisation_seam = std::max(status.peak_utilisation_seam, watched.used.seam);
    status.ruptures += watched.ruptures;
    if (watched.ruptures > 0 && (status.rupture_time_s < 0.0 || watched.rupture_time_s < status.rupture_time_s)) {
      status.rupture_time_s = watched.rupture_time_s;
      status.rupture_position_m = watched.rupture_position;
    }
    if (watched.peak <= status.peak_tension_n_per_m)
      continue;
    status.peak_tension_n_per_m = watched.peak;
    status.peak_tension_time_s = watched.peak_time_s;
    status.peak_tension_position_m = watched.peak_position;
  }
  status.soil_volume_m2 = soil_volume(model);
  status.soil_volume_initial_m2 = initial_volume_;

  Extent<Dim> extent;
  for (const Body<Dim>& body : model.bodies())
    extent.add(body.particles);
  for (const ModelSheet<Dim>& sheet : model.sheets())
    extent.add(sheet.sheet.nodes());
  status.centroid_m = model.centroid();
  status.width_m = extent.upper[0] - extent.lower[0];
  status.height_m = extent.upper[1] - extent.lower[1];
  for (std::size_t s = 0; s < watched_.size(); ++s)
    if (model.sheets()[s].inside)
      status.containers.push_back(container(model, s));
  return status;
}

template <int Dim>
ContainerStatus ReleaseWatch<Dim>::container(const Model<Dim>& model, std::size_t sheet) const
{
  const ModelSheet<Dim>& around = model.sheets()[sheet];
  const Body<Dim>& body = model.bodies()[*around.inside];
  const Watched& watched = watched_[sheet];
  ContainerStatus status;
  status.name = around.name;
  status.outcome = watched.outcome;
  status.release_time_s = watched.release_time_s;
  status.peak_tension_n_per_m = watched.peak;
  status.peak_tension_time_s = watched.peak_time_s;
  status.peak_tension_position_m = watched.peak_position;
  status.current_tension_n_per_m = watched.current;
  status.elongation_max = watched.elongation;
  status.peak_utilisation_sheet = watched.used.sheet;
  status.peak_utilisation_seam = watched.used.seam;
  status.soil_volume_m2 = volume_of(body);
  status.soil_volume_initial_m2 = watched.initial_volume;
  status.episodes = watched.episodes;
  Extent<Dim> extent;
  extent.add(body.particles);
  extent.add(around.sheet.nodes());
  status.width_m = extent.upper[0] - extent.lower[0];
  status.height_m = extent.upper[1] - extent.lower[1];
  double mass = 0.0;
  for (std::size_t p = 0; p < body.particles.size(); ++p) {
    status.centroid_m += body.own_mass(p) * body.position(p);
    mass += body.own_mass(p);
  }
  status.centroid_m /= mass;
  return status;
}

template <int Dim>
void fill_frame(const Model<Dim>& model, const SceneDescription& scene, const std::vector<Vec<Dim>>& boundary_force,
                Frame& frame)
{
  for (const Body<Dim>& body : model.bodies()) {
    const mpm::Particles<Dim>& particles = body.particles;
    SoilFrame soil;
    soil.name = body.name;
    const std::size_t n = particles.size();
    soil.position.resize(n);
    soil.velocity.resize(n);
    soil.stress.resize(n);
    soil.volume.resize(n);
    for (std::size_t p = 0; p < n; ++p) {
      const std::size_t row = particles.id[p];  // order of creation, so that a row is one particle in every frame
      soil.position[row] = in_space<3>(particles.position_of(p));
      soil.velocity[row] = in_space<3>(particles.velocity_of(p));
      for (std::size_t k = 0; k < 4; ++k)
        soil.stress[row][k] = particles.stress[k][p];
      soil.volume[row] = particles.volume[p];
    }
    frame.soil.push_back(std::move(soil));
  }
  for (const ModelSheet<Dim>& enclosing : model.sheets()) {
    const geotextile::Sheet& sheet = enclosing.sheet;
    const GeotextileDescription& description = scene.geotextiles.at(enclosing.name);
    GeotextileFrame geotextile;
    geotextile.name = enclosing.name;
    geotextile.closed = sheet.closed();
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i) {
      geotextile.node.push_back(sheet.node(i));
      geotextile.velocity.emplace_back(sheet.nodes().velocity[0][i], sheet.nodes().velocity[1][i]);
    }
    geotextile.tension = sheet.tension();
    sheet.gauge_tension(geotextile.gauge_tension);
    geotextile.gauge_length_m = description.gauge_length_m;
    geotextile.strength_n_per_m = description.strength_n_per_m;
    geotextile.seam_strength_n_per_m = enclosing.strength.weakest_seam();
    frame.geotextile.push_back(std::move(geotextile));
  }
  for (std::size_t b = 0; b < model.boundaries().size(); ++b) {
    const contact::BoundaryBody<2>& body = model.boundaries()[b];
    BoundaryFrame boundary;
    boundary.name = body.name();
    for (std::size_t p = 0; p < body.size(); ++p)
      boundary.position.push_back(body.reference(p));
    boundary.force_n_per_m = boundary_force[b];
    boundary.closed = body.closed();
    frame.boundary.push_back(std::move(boundary));
  }
}

template class ReleaseWatch<2>;
template class ReleaseWatch<3>;
template void fill_frame(const Model<2>&, const SceneDescription&, const std::vector<Vec2>&, Frame&);
template void fill_frame(const Model<3>&, const SceneDescription&, const std::vector<Vec3>&, Frame&);

}  // namespace geocontainer_mpm::scene
