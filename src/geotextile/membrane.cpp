#include "geocontainer_mpm/geotextile/membrane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::geotextile {
namespace {

/// As for segments, see sheet.cpp: yarns shorter than this part of their rest length are taken to stay slack.
constexpr double slack_strain = -0.01;

/// Coefficients below this part of the largest are the round-off of a side across the yarns.
constexpr double no_part = 1e-12;

/// Parts of a triangle's area that are nearest to its corners; where it is obtuse, half to that corner and a quarter to
/// each of the others (Meyer, Desbrun, Schroeder and Barr 2003, "mixed area").
std::array<double, 3> nearest_parts(const std::array<Vec3, 3>& x)
{
  std::array<double, 3> cotangent, square;  // at corner k, and of the side across from it
  const double twice_area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = x[(k + 1) % 3], &b = x[(k + 2) % 3];
    cotangent[k] = (a - x[k]).dot(b - x[k]) / twice_area;
    square[k] = (b - a).squaredNorm();
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (cotangent[k] <= 0.0) {
      std::array<double, 3> parts{ 0.25, 0.25, 0.25 };
      parts[k] = 0.5;
      return parts;
    }
  std::array<double, 3> parts;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    parts[k] = (square[a] * cotangent[a] + square[b] * cotangent[b]) / (4.0 * twice_area);
  }
  return parts;
}

}  // namespace

Membrane::Membrane(const TriangleMesh& mesh, const MembraneParameters& parameters)
    : parameters_(parameters)
    , triangles_(mesh.triangles)
    , closed_(mesh.closed)
    , family_{ { { ForceStrain(parameters.warp_stiffness, parameters.warp_force_strain), {}, {}, {}, {}, {}, {} },
                 { ForceStrain(parameters.weft_stiffness, parameters.weft_force_strain), {}, {}, {}, {}, {}, {} } } }
{
  nodes_.resize(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      nodes_.position[d][i] = mesh.points[i][static_cast<Eigen::Index>(d)];
  for (mpm::Column& column : external_)
    column.assign(mesh.points.size(), 0.0);
  const std::size_t n = triangles_.size();
  cloth_.assign(n, 0.0);
  tension_.assign(n, 0.0);
  for (Family& family : family_) {
    for (mpm::Column* column : { &family.b1, &family.b2, &family.strain, &family.tension })
      column->assign(n, 0.0);
    family.rupture_strain.assign(n, parameters_.rupture_strain.value_or(std::numeric_limits<double>::infinity()));
    family.broken.assign(n, 0);
  }
  for (std::size_t t = 0; t < n; ++t)
    lay(mesh, t);
  find_neighbours(mesh);
}

void Membrane::tear_at(std::size_t triangle, double tension)
{
  double& rupture_strain = family_[0].rupture_strain[triangle];
  rupture_strain = std::min(rupture_strain, family_[0].law.strain(tension));
}

/// Unstretched area, coefficients of the yarns and masses of a triangle.
void Membrane::lay(const TriangleMesh& mesh, std::size_t triangle)
{
  const Triangle& t = triangles_[triangle];
  const std::array<Vec3, 3> x{ mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]] };
  const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);  // its length is twice the area
  if (!(normal.squaredNorm() > 0.0))
    throw InputError("", "mesh", "triangle " + std::to_string(triangle), "must have an area");
  const std::array<double, 2> fullness =
      mesh.fullness.empty() ? std::array<double, 2>{ 1.0, 1.0 } : mesh.fullness[triangle];
  cloth_[triangle] = 0.5 * normal.norm() * fullness[0] * fullness[1];
  for (std::size_t f = 0; f < 2; ++f) {
    const Vec3& along = f == 0 ? mesh.warp[triangle] : mesh.weft[triangle];
    std::array<double, 3> b;  // grad N_k . a over the fullness, grad N_k = normal x (side across) / normal^2
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      b[k] = normal.cross(x[(k + 2) % 3] - x[(k + 1) % 3]).dot(along) / (normal.squaredNorm() * fullness[f]);
      largest = std::max(largest, std::abs(b[k]));
    }
    // A side along the yarns: its ends alone take part, by opposite coefficients.
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(b[k]) < no_part * largest) {
        b[k] = 0.0;
        b[(k + 2) % 3] = -b[(k + 1) % 3];
      }
    family_[f].b1[triangle] = b[1];
    family_[f].b2[triangle] = b[2];
  }
  const std::array<double, 3> parts = nearest_parts(x);
  for (std::size_t k = 0; k < 3; ++k) {
    nodes_.mass[t[k]] += parameters_.computational_mass * parts[k] * cloth_[triangle];
    nodes_.weight_mass[t[k]] += parameters_.mass * parts[k] * cloth_[triangle];
  }
}

/// Tension of a piece at its new strain, N/m. Where it breaks, what was stored in it and half of the last step's work,
/// the half that was done before, are gone.
double Membrane::carried(Family& family, std::size_t triangle, double strain)
{
  if (family.broken[triangle])
    return 0.0;
  const double before = family.strain[triangle];
  family.strain[triangle] = strain;
  if (strain < family.rupture_strain[triangle])
    return family.law.force(strain);
  const double lost =
      cloth_[triangle] * (family.law.energy(before) + 0.5 * family.law.force(before) * (strain - before));
  for (const std::uint32_t node : triangles_[triangle])
    nodes_.dissipated[node] += lost / 3.0;
  family.broken[triangle] = 1;
  if (ruptures_++ == 0)
    rupture_place_ = middle(triangle);
  return 0.0;
}

Vec3 Membrane::middle(std::size_t triangle) const
{
  const Triangle& t = triangles_[triangle];
  return (node(t[0]) + node(t[1]) + node(t[2])) / 3.0;
}

/// Tensions of all pieces from the nodes' positions, and what they pull at the nodes.
bool Membrane::pull()
{
  bool acts = false;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto [i0, i1, i2] = triangles_[t];
    const Vec3 x0 = node(i0), side1 = node(i1) - x0, side2 = node(i2) - x0;
    Vec3 force1 = Vec3::Zero(), force2 = Vec3::Zero();
    bool pulls = false;
    for (Family& family : family_) {
      const double b1 = family.b1[t], b2 = family.b2[t];
      const Vec3 g = b1 * side1 + b2 * side2;
      const double stretch = g.norm(), tension = carried(family, t, stretch - 1.0);
      family.tension[t] = tension;
      if (tension <= 0.0)
        continue;
      pulls = true;
      const double scale = cloth_[t] * tension / stretch;
      force1 -= scale * b1 * g;
      force2 -= scale * b2 * g;
    }
    tension_[t] = std::max(family_[0].tension[t], family_[1].tension[t]);
    if (!pulls)
      continue;
    acts = true;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto e = static_cast<Eigen::Index>(d);
      nodes_.force[d][i0] -= force1[e] + force2[e];
      nodes_.force[d][i1] += force1[e];
      nodes_.force[d][i2] += force2[e];
    }
  }
  return acts;
}

bool Membrane::update_forces(const MembraneLoad& load)
{
  for (auto* columns : { &nodes_.force, &external_ })
    for (mpm::Column& column : *columns)
      std::fill(column.begin(), column.end(), 0.0);
  bool acts = pull();
  if (!closed_ || (load.pressure == 0.0 && load.gradient == 0.0))
    return acts;
  add_pressure(load);
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (external_[d][i] != 0.0) {
        acts = true;
        nodes_.force[d][i] += external_[d][i];
      }
  return acts;
}

void Membrane::add_pressure(const MembraneLoad& load)
{
  const mpm::Column& z = nodes_.position[2];
  const double level = load.level ? *load.level : *std::max_element(z.begin(), z.end());
  for (const Triangle& t : triangles_) {
    // Virtual work of the pressure, linear on the triangle, with integral of N_i N_j = area (1 + delta_ij) / 12: the
    // exact derivative of the integral of p over the volume inside with respect to the nodes.
    const Vec3 x0 = node(t[0]), out = (node(t[1]) - x0).cross(node(t[2]) - x0);  // twice the area times the normal
    std::array<double, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = load.pressure + load.gradient * (level - z[t[k]]);
    const double sum = p[0] + p[1] + p[2];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t d = 0; d < 3; ++d)
        external_[d][t[k]] += (sum + p[k]) / 24.0 * out[static_cast<Eigen::Index>(d)];
  }
}

double Membrane::external_power() const
{
  double power = 0.0;
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      power += external_[d][i] * nodes_.velocity[d][i];
  return power;
}

double Membrane::tension_power() const
{
  double power = 0.0;
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      power -= (nodes_.force[d][i] - external_[d][i]) * nodes_.velocity[d][i];
  return power;
}

double Membrane::elastic_energy() const
{
  double energy = 0.0;
  for (const Family& family : family_)
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (!family.broken[t])
        energy += family.law.energy(family.strain[t]) * cloth_[t];
  return energy;
}

double Membrane::rupture_energy() const
{
  double energy = 0.0;
  for (const double lost : nodes_.dissipated)
    energy += lost;
  return energy;
}

double Membrane::largest_strain() const
{
  double largest = 0.0;
  for (const Family& family : family_)
    for (const double strain : family.strain)
      largest = std::max(largest, strain);
  return largest;
}

double Membrane::area() const
{
  double sum = 0.0;
  for (const Triangle& t : triangles_)
    sum += 0.5 * (node(t[1]) - node(t[0])).cross(node(t[2]) - node(t[0])).norm();
  return sum;
}

/// The flux of (0, 0, z) through the sheet: none of it goes through vertical planes.
double Membrane::enclosed_volume() const
{
  double volume = 0.0;
  if (!closed_)
    return volume;
  for (const Triangle& t : triangles_) {
    const Vec3 a = node(t[0]), b = node(t[1]), c = node(t[2]);
    volume += (a[2] + b[2] + c[2]) / 6.0 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  return volume;
}

std::size_t Membrane::active_pieces() const
{
  std::size_t active = 0;
  for (const Family& family : family_)
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      active += family.strain[t] >= slack_strain && !family.broken[t] ? 1 : 0;
  return active;
}

void Membrane::add_stiffness(mpm::FrequencyBound<3>& bound) const
{
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const Family& family : family_) {
      if (family.strain[t] < slack_strain || family.broken[t])
        continue;
      const std::array<double, 3> b{ -(family.b1[t] + family.b2[t]), family.b1[t], family.b2[t] };
      std::array<mpm::FrequencyBound<3>::SpanPoint, 3> points;
      std::size_t count = 0;
      for (std::size_t k = 0; k < 3; ++k)
        if (b[k] != 0.0)
          points[count++] = { node(triangles_[t][k]), b[k] };
      bound.add_span(points.data(), count, family.law.steepest() * cloth_[t]);
    }
}

}  // namespace geocontainer_mpm::geotextile
