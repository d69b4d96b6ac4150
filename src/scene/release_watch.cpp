#include "geocontainer_mpm/scene/release_watch.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::scene {
namespace {

/// A hull counts as open once its slot is wider than this, m: more than play and sensor noise make of a closed one.
constexpr double open_slot_m = 0.05;

double soil_volume(const Model& model)
{
  double volume = 0.0;
  for (const Body& body : model.bodies())
    for (double v : body.particles.volume)
      volume += v;
  return volume;
}

}  // namespace

ReleaseWatch::ReleaseWatch(const SceneDescription& scene) : hung_up_after_s_(scene.outcome.hung_up_after_s)
{
  if (scene.hull && !scene.geotextiles.empty()) {
    hull_.emplace(scene.hull->hinge_m, scene.hull->port_section_m, "hull");
    outcome_ = Outcome::waiting;
  }
}

void ReleaseWatch::observe(const Model& model, double time_s, const barge::OpeningAngles& opening, double still_for_s)
{
  if (initial_volume_ < 0.0)
    initial_volume_ = soil_volume(model);
  current_ = 0.0;
  ruptures_ = 0;
  for (const ModelSheet& enclosing : model.sheets()) {
    const geotextile::Sheet& sheet = enclosing.sheet;
    sheet.gauge_tension(gauge_);
    const auto largest = std::max_element(gauge_.begin(), gauge_.end());
    current_ = std::max(current_, *largest);
    elongation_ = std::max(elongation_, sheet.largest_strain());
    const geotextile::Utilisation used = enclosing.strength.utilisation(gauge_);
    utilisation_ = { std::max(utilisation_.sheet, used.sheet), std::max(utilisation_.seam, used.seam) };
    ruptures_ += sheet.ruptures();
    if (rupture_time_s_ < 0.0 && sheet.ruptures() > 0) {
      rupture_time_s_ = time_s;
      rupture_position_ = sheet.rupture_place();
    }
    if (*largest > peak_) {
      const auto segment = static_cast<std::size_t>(largest - gauge_.begin());
      peak_ = *largest;
      peak_time_s_ = time_s;
      peak_position_ = 0.5 * (sheet.node(segment) + sheet.node(sheet.end_of(segment)));
    }
  }
  if (hull_)
    judge(model, time_s, opening, still_for_s);
}

void ReleaseWatch::judge(const Model& model, double time_s, const barge::OpeningAngles& opening, double still_for_s)
{
  if (outcome_ == Outcome::released || (outcome_ == Outcome::waiting && hull_->slot_width_m(opening) < open_slot_m))
    return;
  double top = model.sheets().front().sheet.node(0)[1];
  for (const ModelSheet& enclosing : model.sheets()) {
    const mpm::Column& z = enclosing.sheet.nodes().position[1];
    top = std::max(top, *std::max_element(z.begin(), z.end()));
  }
  if (top < hull_->lowest_level_m(opening)) {
    outcome_ = Outcome::released;
    release_time_s_ = time_s;
  } else {
    outcome_ = still_for_s >= hung_up_after_s_ ? Outcome::hung_up : Outcome::releasing;
  }
}

StatusFrame ReleaseWatch::status(const Model& model) const
{
  StatusFrame status;
  status.outcome = outcome_;
  status.release_time_s = release_time_s_;
  status.peak_tension_n_per_m = peak_;
  status.peak_tension_time_s = peak_time_s_;
  status.peak_tension_position_m = peak_position_;
  status.current_tension_n_per_m = current_;
  status.elongation_max = elongation_;
  status.soil_volume_m2 = soil_volume(model);
  status.soil_volume_initial_m2 = initial_volume_;
  status.peak_utilisation_sheet = utilisation_.sheet;
  status.peak_utilisation_seam = utilisation_.seam;
  status.ruptures = ruptures_;
  status.rupture_time_s = rupture_time_s_;
  status.rupture_position_m = rupture_position_;

  Vec2 lower = Vec2::Constant(1e300), upper = -lower;
  const auto extend = [&](const mpm::Particles<2>& particles, std::size_t p) {
    const Vec2 x(particles.position[0][p], particles.position[1][p]);
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  };
  for (const Body& body : model.bodies())
    for (std::size_t p = 0; p < body.particles.size(); ++p)
      extend(body.particles, p);
  for (const ModelSheet& enclosing : model.sheets())
    for (std::size_t p = 0; p < enclosing.sheet.nodes().size(); ++p)
      extend(enclosing.sheet.nodes(), p);
  status.centroid_m = model.centroid();
  status.width_m = upper[0] - lower[0];
  status.height_m = upper[1] - lower[1];
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
      soil.position[row] = { particles.position[0][p], particles.position[1][p] };
      soil.velocity[row] = { particles.velocity[0][p], particles.velocity[1][p] };
      for (std::size_t k = 0; k < 4; ++k)
        soil.stress[row][k] = particles.stress[k][p];
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
    const contact::BoundaryBody& body = model.boundaries()[b];
    BoundaryFrame boundary;
    boundary.name = body.name();
    for (std::size_t p = 0; p < body.size(); ++p)
      boundary.position.push_back(body.reference(p));
    boundary.force_n_per_m = boundary_force[b];
    boundary.closed = body.closed();
    frame.boundary.push_back(std::move(boundary));
  }
}

}  // namespace geocontainer_mpm::scene
