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

struct Extent {
  Vec3 lower = Vec3::Constant(1e300), upper = -lower;

  template <int Dim>
  void add(const mpm::Particles<Dim>& particles)
  {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const Vec3 x = in_barge_frame(particles.position_of(p));
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
  return in_barge_frame(0.5 * (sheet.node(segment) + sheet.node(sheet.end_of(segment))));
}

Vec3 middle_of(const geotextile::Membrane& sheet, std::size_t triangle)
{
  const auto& [a, b, c] = sheet.triangles()[triangle];
  return (sheet.node(a) + sheet.node(b) + sheet.node(c)) / 3.0;
}

}  // namespace

template <int Dim>
ReleaseWatch<Dim>::ReleaseWatch(const SceneDescription& scene)
    : hung_up_after_s_(scene.outcome.hung_up_after_s), symmetry_(scene.symmetry()), watched_(scene.geotextiles.size())
{
  if (scene.hull && !scene.geotextiles.empty())
    hull_.emplace(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
  for (ContainerStatus& watched : watched_)
    watched.outcome = hull_ ? Outcome::waiting : Outcome::none;
}

template <int Dim>
void ReleaseWatch<Dim>::observe(const Model<Dim>& model, double time_s, const barge::OpeningAngles& opening,
                                double still_for_s)
{
  if (initial_volume_ < 0.0) {
    initial_volume_ = soil_volume(model);
    for (std::size_t s = 0; s < watched_.size(); ++s)
      if (model.sheets()[s].inside)
        watched_[s].soil_volume_initial = volume_of(model.bodies()[*model.sheets()[s].inside]);
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
    for (ContainerStatus& watched : watched_)
      watched.episodes.push_back({ model.bodies()[b].name, time_s, watched.current_tension_n_per_m, 0.0, time_s });
  }
}

template <int Dim>
void ReleaseWatch<Dim>::measure(const ModelSheet<Dim>& what, double time_s, ContainerStatus& watched)
{
  const SheetOf<Dim>& sheet = what.sheet;
  const Tense now = most_tense(what, gauge_);
  watched.current_tension_n_per_m = std::max(0.0, now.tension);
  watched.utilisation_sheet = now.used.sheet;
  watched.utilisation_seam = now.used.seam;
  watched.elongation_max = std::max(watched.elongation_max, sheet.largest_strain());
  watched.peak_utilisation_sheet = std::max(watched.peak_utilisation_sheet, now.used.sheet);
  watched.peak_utilisation_seam = std::max(watched.peak_utilisation_seam, now.used.seam);
  watched.ruptures = sheet.ruptures();
  if (watched.rupture_time_s < 0.0 && watched.ruptures > 0) {
    watched.rupture_time_s = time_s;
    watched.rupture_position_m = in_barge_frame(sheet.rupture_place());
  }
  if (!watched.episodes.empty() && now.tension > watched.episodes.back().peak_n_per_m) {
    watched.episodes.back().peak_n_per_m = now.tension;
    watched.episodes.back().peak_time_s = time_s;
  }
  if (now.tension > watched.peak_tension_n_per_m) {
    watched.peak_tension_n_per_m = now.tension;
    watched.peak_tension_time_s = time_s;
    watched.peak_tension_position_m = middle_of(sheet, now.piece);
  }
}

template <int Dim>
void ReleaseWatch<Dim>::judge(const ModelSheet<Dim>& sheet, double time_s, const barge::OpeningAngles& opening,
                              double still_for_s, ContainerStatus& watched) const
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
    return std::any_of(watched_.begin(), watched_.end(),
                       [outcome](const ContainerStatus& w) { return w.outcome == outcome; });
  };
  for (const Outcome outcome : { Outcome::hung_up, Outcome::releasing, Outcome::waiting })
    if (any(outcome))
      return outcome;
  return Outcome::released;
}

template <int Dim>
void ReleaseWatch<Dim>::complete(ContainerState& state) const
{
  const double across = symmetry_ == Symmetry::none ? 1.0 : 2.0, along = symmetry_ == Symmetry::quarter ? 2.0 : 1.0;
  if (across > 1.0)
    state.centroid_m[1] = 0.0;
  if (along > 1.0)
    state.centroid_m[0] = 0.0;
  state.width_m *= across;
  state.length_m *= along;
  state.soil_volume *= across * along;
  state.soil_volume_initial *= across * along;
}

template <int Dim>
StatusFrame ReleaseWatch<Dim>::status(const Model<Dim>& model) const
{
  StatusFrame status;
  status.dimensions = Dim;
  status.outcome = outcome();
  for (const ContainerStatus& watched : watched_) {
    if (status.outcome == Outcome::released)
      status.release_time_s = std::max(status.release_time_s, watched.release_time_s);
    status.current_tension_n_per_m = std::max(status.current_tension_n_per_m, watched.current_tension_n_per_m);
    status.utilisation_sheet = std::max(status.utilisation_sheet, watched.utilisation_sheet);
    status.utilisation_seam = std::max(status.utilisation_seam, watched.utilisation_seam);
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
  for (const Body<Dim>& body : model.bodies())
    extent.add(body.particles);
  for (const ModelSheet<Dim>& sheet : model.sheets())
    extent.add(sheet.sheet.nodes());
  status.centroid_m = in_barge_frame(model.centroid());
  extent.put_into(status);
  complete(status);
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
  complete(status);
  return status;
}

template class ReleaseWatch<2>;
template class ReleaseWatch<3>;

}  // namespace geocontainer_mpm::scene
