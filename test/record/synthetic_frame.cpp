#include "synthetic_frame.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::record {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double area_m2 = 10.8;
constexpr double bed_z_m = -9.3;
constexpr double release_s = 27.0;

double smooth(double from, double to, double x)
{
  const double s = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

double opening_rad(double t)
{
  return 0.365 * smooth(5.0, 28.0, t);
}

/// The container as an ellipse of constant area: its centre's height and half its width.
struct Ellipse {
  double z, half_width;
  double half_height() const { return area_m2 / (pi * half_width); }
};

Ellipse ellipse(double t)
{
  const double squeezed = smooth(8.0, release_s, t);
  const double fallen = smooth(release_s, release_s + 2.0, t);
  const double flat = smooth(release_s + 1.5, release_s + 2.4, t);
  const double half_width = 1.9 - 0.6 * squeezed + 1.45 * flat;
  const double resting_z = bed_z_m + area_m2 / (pi * half_width);
  const double hanging_z = -2.6 - 2.2 * squeezed * squeezed;
  return { hanging_z + (resting_z - hanging_z) * fallen, half_width };
}

Vec3 mapped(const Ellipse& shape, const Vec2& unit)
{
  return { 0.0, shape.half_width * unit[0], shape.z + shape.half_height() * unit[1] };
}

template <typename Map>
auto rate(double t, Map map) -> decltype(map(t))
{
  const double h = 1e-3;
  return (map(t + h) - map(t - h)) / (2.0 * h);
}

scene::SoilFrame sand(double t, int rings)
{
  scene::SoilFrame soil;
  soil.name = "fill";
  const auto add = [&](const Vec2& unit) {
    const auto map = [&](double s) { return mapped(ellipse(s), unit); };
    soil.position.push_back(map(t));
    soil.velocity.push_back(rate(t, map));
    const double vertical = -1900.0 * 9.81 * ellipse(t).half_height() * (0.97 - unit[1]);
    soil.stress.push_back({ 0.5 * vertical, 0.5 * vertical, vertical, 0.0, 0.0, 0.1 * vertical * unit[0] });
  };
  add(Vec2::Zero());
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2.0 * pi * i / (6.0 * ring);
      add(0.97 * ring / rings * Vec2(std::cos(angle), std::sin(angle)));
    }
  soil.volume.assign(soil.position.size(), area_m2 / static_cast<double>(soil.position.size()));
  return soil;
}

scene::GeotextileFrame sheet(double t)
{
  scene::GeotextileFrame result;
  result.name = "bag";
  result.gauge_length_m = 0.5;
  result.strength_n_per_m = 120e3;
  result.seam_strength_n_per_m = 102e3;
  const int n = 180;
  const double pull = smooth(8.0, release_s - 1.0, t) * (1.0 - 0.6 * smooth(release_s, release_s + 0.8, t)) +
                      0.5 * std::exp(-std::pow((t - release_s - 2.1) / 0.25, 2));
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * i / n;
    const auto map = [&](double s) { return mapped(ellipse(s), { std::cos(angle), std::sin(angle) }); };
    result.node.push_back(map(t));
    result.velocity.push_back(rate(t, map));
    const double mean = 52e3 * pull * (0.75 - 0.25 * std::sin(angle + pi / n));
    result.gauge_tension.push_back(mean);
    result.tension.push_back(std::max(0.0, mean * (1.0 + 0.3 * std::sin(40.0 * angle))));
  }
  return result;
}

scene::BoundaryFrame polyline(const char* name, const std::vector<Vec2>& corners, double spacing_m)
{
  scene::BoundaryFrame result;
  result.name = name;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const int pieces = std::max(1, static_cast<int>((corners[k + 1] - corners[k]).norm() / spacing_m));
    for (int i = 0; i < pieces; ++i)
      result.position.push_back(in_barge_frame(corners[k] + (corners[k + 1] - corners[k]) * i / pieces));
  }
  result.position.push_back(in_barge_frame(corners.back()));
  return result;
}

scene::BoundaryFrame hull_half(double t, double side)
{
  const double angle = side * opening_rad(t);  // counter-clockwise, y to the right and z up, moves the port lip to port
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<Vec2> corners;
  for (const Vec2& p : { Vec2(1.5, -4.3), Vec2(0.0, -4.3), Vec2(0.0, -3.9), Vec2(2.5, -1.3), Vec2(2.5, 0.0) })
    corners.emplace_back(c * side * p[0] - s * p[1], s * side * p[0] + c * p[1]);
  scene::BoundaryFrame hull = polyline(side > 0.0 ? "hull_port" : "hull_starboard", corners, 0.05);
  hull.angle_rad = opening_rad(t);
  hull.force = { 0.0, side * 4e4, -9e4 * (1.0 - smooth(8.0, release_s, t)) };
  return hull;
}

void fill_status(scene::Frame& frame)
{
  const double t = frame.time_s;
  scene::StatusFrame& status = frame.status;
  status.outcome = t < 8.0         ? scene::Outcome::waiting
                   : t < release_s ? scene::Outcome::releasing
                                   : scene::Outcome::released;
  status.release_time_s = t < release_s ? -1.0 : release_s;
  status.resting = t < 5.0 || t > 35.0;
  const auto& tension = frame.geotextile.front().gauge_tension;
  status.current_tension_n_per_m = *std::max_element(tension.begin(), tension.end());
  status.peak_tension_n_per_m = t < release_s ? status.current_tension_n_per_m : 52e3;
  status.peak_tension_time_s = std::min(t, release_s);
  status.peak_tension_position_m = { 0.0, 0.0, -6.5 };
  status.elongation_max = status.peak_tension_n_per_m / 800e3;
  const Ellipse shape = ellipse(t);
  status.centroid_m = { 0.0, 0.0, shape.z };
  status.width_m = 2.0 * shape.half_width;
  status.height_m = 2.0 * shape.half_height();
  status.soil_volume = status.soil_volume_initial = area_m2;

  const double weight = 1900.0 * 9.81 * area_m2;
  scene::EnergyFrame& energy = frame.energy;
  energy.potential = weight * shape.z;
  energy.kinetic = 0.5 * 1900.0 * area_m2 * std::pow(rate(t, [](double s) { return Vec2(0.0, ellipse(s).z); })[1], 2);
  energy.elastic = 2e3 + 3e4 * status.current_tension_n_per_m / 52e3;
  energy.work_in = 1e4 * smooth(5.0, 28.0, t);
  energy.dissipated =
      std::max(0.0, weight * (ellipse(0.0).z - shape.z) + energy.work_in - energy.kinetic - energy.elastic);
  energy.dissipated_plastic = 0.6 * energy.dissipated;
  energy.dissipated_contact = 0.3 * energy.dissipated;
  energy.dissipated_transfer = 0.1 * energy.dissipated;
  energy.relative_balance_error = 1e-3;
}

/// The container's centre, twice a second between frames one second apart.
scene::ProbeFrame centre_probe(double t)
{
  const std::vector<double> times{ t - 0.5, t };
  scene::ProbeFrame probe{ "centre", "body", times, { { "z", "m", {} }, { "velocity_z", "m/s", {} } } };
  for (const double time : times) {
    probe.columns[0].values.push_back(ellipse(time).z);
    probe.columns[1].values.push_back(rate(time, [](double s) { return Vec2(0.0, ellipse(s).z); })[1]);
  }
  return probe;
}

}  // namespace

scene::Frame synthetic_frame(double time_s, int rings)
{
  scene::Frame frame;
  frame.time_s = time_s;
  frame.stamp_ns = 1'700'000'000'000'000'000 + static_cast<std::int64_t>(time_s * 1e9);
  frame.step = static_cast<std::uint64_t>(time_s * 1000.0);
  frame.dt_s = 1e-3;
  frame.opening = { opening_rad(time_s), opening_rad(time_s) };
  frame.soil.push_back(sand(time_s, rings));
  frame.geotextile.push_back(sheet(time_s));
  frame.boundary.push_back(hull_half(time_s, 1.0));
  frame.boundary.push_back(hull_half(time_s, -1.0));
  frame.boundary.push_back(polyline("bed", { { -8.0, bed_z_m }, { 8.0, bed_z_m } }, 0.1));
  fill_status(frame);
  frame.probes.push_back(centre_probe(time_s));
  return frame;
}

}  // namespace geocontainer_mpm::record
