#include "model_particles.h"

#include <algorithm>
#include <cmath>

namespace geocontainer_mpm::scene {

template <int Dim>
void set_k0_stress(const BodyDescription& description, double density, const std::vector<Vec2>& shape, double gravity_z,
                   const std::optional<Water>& water, mpm::Particles<Dim>& particles)
{
  constexpr std::size_t vertical_slot = z_axis<Dim>, out_of_plane = 3;  // of plane strain
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x = in_section(particles.position_of(p));
    const double top = top_at(shape, x[0]), depth = std::max(0.0, top - x[1]);
    // gravity_z < 0: compression
    const double vertical = water ? gravity_z * water->overburden(density, x[1], top) : density * gravity_z * depth;
    for (std::size_t d = 0; d < Dim; ++d)
      particles.stress[d][p] = d == vertical_slot ? vertical : description.k0 * vertical;
    if constexpr (Dim == 2)
      particles.stress[out_of_plane][p] = description.k0 * vertical;
  }
}

template <int Dim>
void set_hydrostatic(const material::Parameters& material, const std::vector<Vec2>& shape, double gravity_z,
                     const std::optional<Water>& water, mpm::Particles<Dim>& particles)
{
  const double rho = material.density_kg_per_m3, bulk = material.bulk_modulus_pa;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x = in_section(particles.position_of(p));
    const double top = top_at(shape, x[0]), depth = std::max(0.0, top - x[1]);
    const double pressure = water ? -gravity_z * water->overburden(rho, x[1], top) : -rho * gravity_z * depth;
    const double compression = std::exp(pressure / bulk);  // rho / rho0
    particles.initial_volume[p] = compression * particles.volume[p];
    particles.mass[p] = particles.weight_mass[p] = rho * particles.initial_volume[p];
  }
}

template <int Dim>
void set_velocity(const Vec2& velocity, double spin, const std::optional<VelocityWave>& wave,
                  mpm::Particles<Dim>& particles)
{
  Vec2 middle = Vec2::Zero();
  double mass = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    middle += particles.mass[p] * in_section(particles.position_of(p));
    mass += particles.mass[p];
  }
  middle /= mass;
  constexpr std::size_t y = y_axis<Dim>, z = z_axis<Dim>;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 x = in_section(particles.position_of(p));
    Vec2 v = velocity + spin * Vec2(middle[1] - x[1], x[0] - middle[0]);
    Mat2 gradient = Mat2::Zero();
    if (spin != 0.0)
      gradient << 0.0, -spin, spin, 0.0;
    if (wave) {
      const double phase = wave->wave_number_rad_per_m.dot(x) + wave->phase_rad;
      v += wave->amplitude_m_per_s * std::sin(phase);
      gradient += wave->amplitude_m_per_s * wave->wave_number_rad_per_m.transpose() * std::cos(phase);
    }
    const std::array<std::size_t, 2> axes{ y, z };
    for (std::size_t i = 0; i < 2; ++i) {
      particles.velocity[axes[i]][p] = v[static_cast<int>(i)];
      for (std::size_t j = 0; j < 2; ++j)
        particles.affine[axes[i] * Dim + axes[j]][p] = gradient(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

template <>
Places<2> places(const Sampling& section, const BodyDescription&, Symmetry, double)
{
  return { section.points, section.volumes, section.tile };
}

template <>
Places<3> places(const Sampling& section, const BodyDescription& body, Symmetry symmetry, double spacing)
{
  Places<3> result;
  const double from = (*body.along_m)[0], length = (*body.along_m)[1] - from;
  // More than one are an even number, so that a plane of symmetry has whole rows on both sides.
  const int wanted = std::max(1, static_cast<int>(std::lround(length / spacing))),
            rows = wanted > 1 ? 2 * ((wanted + 1) / 2) : 1;
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

template void place(const Places<2>&, double, mpm::Particles<2>&);
template void place(const Places<3>&, double, mpm::Particles<3>&);
template void set_k0_stress(const BodyDescription&, double, const std::vector<Vec2>&, double,
                            const std::optional<Water>&, mpm::Particles<2>&);
template void set_k0_stress(const BodyDescription&, double, const std::vector<Vec2>&, double,
                            const std::optional<Water>&, mpm::Particles<3>&);
template void set_hydrostatic(const material::Parameters&, const std::vector<Vec2>&, double,
                              const std::optional<Water>&, mpm::Particles<2>&);
template void set_hydrostatic(const material::Parameters&, const std::vector<Vec2>&, double,
                              const std::optional<Water>&, mpm::Particles<3>&);
template void set_velocity(const Vec2&, double, const std::optional<VelocityWave>&, mpm::Particles<2>&);
template void set_velocity(const Vec2&, double, const std::optional<VelocityWave>&, mpm::Particles<3>&);
template double mean_width(const mpm::Particles<2>&);
template double mean_width(const mpm::Particles<3>&);

}  // namespace geocontainer_mpm::scene
