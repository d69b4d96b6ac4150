#include <algorithm>
#include <cmath>

#include "synthetic_frame.h"

namespace geocontainer_mpm::record {
namespace {

constexpr double half_length_m = 4.0, half_hull_m = 5.0;
constexpr std::size_t stations = 25;  // along the container, both its ends included

/// The container's section shrinks towards its ends.
double size_at(double x)
{
  return std::pow(1.0 - std::pow(x / half_length_m, 6), 0.5);
}

double station(std::size_t i)
{
  return half_length_m * (2.0 * static_cast<double>(i) / static_cast<double>(stations - 1) - 1.0);
}

Vec3 at(double x, const Vec3& section, const Vec3& centre)
{
  return centre + size_at(x) * (section - centre) + x * Vec3::UnitX();
}

/// Rings of nodes along x, and one node at each end.
scene::GeotextileFrame lengthened(const scene::GeotextileFrame& line, const Vec3& centre)
{
  scene::GeotextileFrame sheet = line;
  sheet.node.clear();
  sheet.velocity.clear();
  sheet.tension.clear();
  sheet.gauge_tension.clear();
  constexpr std::size_t coarser = 3;
  const std::size_t n = line.node.size() / coarser;
  for (std::size_t i = 1; i + 1 < stations; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      sheet.node.push_back(at(station(i), line.node[coarser * k], centre));
      sheet.velocity.push_back(line.velocity[coarser * k]);
    }
  const auto aft = static_cast<std::uint32_t>(sheet.node.size()), fore = aft + 1;
  for (const double x : { -half_length_m, half_length_m }) {
    sheet.node.emplace_back(centre + x * Vec3::UnitX());
    sheet.velocity.emplace_back(Vec3::Zero());
  }
  const auto node = [&](std::size_t ring, std::size_t k) { return static_cast<std::uint32_t>(ring * n + k % n); };
  const auto add = [&](const scene::Triangle& triangle, double x, std::size_t k) {
    sheet.triangles.push_back(triangle);
    sheet.tension.push_back(line.tension[coarser * k] * size_at(x));
    sheet.gauge_tension.push_back(line.gauge_tension[coarser * k] * size_at(x));
    sheet.warp_tension.push_back(sheet.gauge_tension.back());
    sheet.weft_tension.push_back(0.3 * sheet.gauge_tension.back());
  };
  for (std::size_t k = 0; k < n; ++k) {
    add({ aft, node(0, k), node(0, k + 1) }, station(1), k);
    for (std::size_t ring = 0; ring + 3 < stations; ++ring) {
      const double x = 0.5 * (station(ring + 1) + station(ring + 2));
      add({ node(ring, k), node(ring + 1, k), node(ring, k + 1) }, x, k);
      add({ node(ring, k + 1), node(ring + 1, k), node(ring + 1, k + 1) }, x, k);
    }
    add({ fore, node(stations - 3, k + 1), node(stations - 3, k) }, station(stations - 2), k);
  }
  return sheet;
}

/// Two rows of positions, `half_length` before and behind midships, and triangles between them.
scene::BoundaryFrame lengthened(const scene::BoundaryFrame& line, double half_length)
{
  scene::BoundaryFrame surface = line;
  const std::size_t n = line.position.size();
  surface.position.clear();
  for (const double x : { -half_length, half_length })
    for (const Vec3& point : line.position)
      surface.position.emplace_back(point + x * Vec3::UnitX());
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    const auto over = static_cast<std::uint32_t>(i + n);
    surface.triangles.push_back({ i, i + 1, over });
    surface.triangles.push_back({ i + 1, over + 1, over });
  }
  surface.force *= 2.0 * half_length;
  return surface;
}

scene::SoilFrame lengthened(const scene::SoilFrame& section, const Vec3& centre)
{
  scene::SoilFrame soil;
  soil.name = section.name;
  const double spacing = 2.0 * half_length_m / static_cast<double>(stations - 1);
  for (std::size_t i = 1; i + 1 < stations; ++i)
    for (std::size_t p = 0; p < section.position.size(); ++p) {
      const double size = size_at(station(i));
      soil.position.push_back(at(station(i), section.position[p], centre));
      soil.velocity.push_back(section.velocity[p]);
      scene::SymmetricTensor stress = section.stress[p];
      stress[3] = 0.05 * stress[2];
      stress[4] = 0.1 * stress[2] * station(i) / half_length_m;
      soil.stress.push_back(stress);
      soil.volume.push_back(section.volume[p] * size * size * spacing);
    }
  return soil;
}

}  // namespace

scene::Frame synthetic_solid_frame(double time_s, int rings)
{
  scene::Frame frame = synthetic_frame(time_s, rings);
  const Vec3 centre = frame.status.centroid_m;
  frame.soil[0] = lengthened(frame.soil[0], centre);
  frame.geotextile[0] = lengthened(frame.geotextile[0], centre);
  for (scene::BoundaryFrame& boundary : frame.boundary)
    boundary = lengthened(boundary, half_hull_m);
  scene::StatusFrame& status = frame.status;
  status.dimensions = 3;
  status.length_m = 2.0 * half_length_m;
  status.soil_volume = 0.0;
  for (const double volume : frame.soil[0].volume)
    status.soil_volume += volume;
  status.soil_volume_initial = status.soil_volume;
  status.peak_tension_position_m.x() = 1.5;
  scene::EnergyFrame& energy = frame.energy;
  for (double* value :
       { &energy.kinetic, &energy.elastic, &energy.potential, &energy.dissipated, &energy.dissipated_plastic,
         &energy.dissipated_contact, &energy.dissipated_transfer, &energy.work_in })
    *value *= 2.0 * half_length_m;
  return frame;
}

}  // namespace geocontainer_mpm::record
