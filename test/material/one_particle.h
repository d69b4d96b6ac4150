#pragma once
/// A batch of one particle, driven by displacement-gradient increments, and an account of the work done on it that is
/// kept independently of the law: plain Eigen, Hughes & Winget (1980) written down as in the paper.

#include <Eigen/Dense>
#include <array>
#include <memory>

#include "geocontainer_mpm/material/law.h"
#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::material::testing {

inline constexpr double pi = 3.14159265358979323846;

template <int Dim>
class OneParticle {
public:
  explicit OneParticle(const Parameters& parameters) : parameters_(parameters), law_(make_law<Dim>(parameters))
  {
    for (std::size_t i = 0; i < gradient_.size(); ++i)
      batch_.velocity_gradient[i] = &gradient_[i];
    for (std::size_t i = 0; i < stress_.size(); ++i)
      batch_.stress[i] = &stress_[i];
    if (law_->needs_deformation())
      for (std::size_t i = 0; i < deformation_.size(); ++i)
        batch_.deformation[i] = &deformation_[i];
    set_entries(deformation_, Mat<Dim>::Identity());
    batch_.initial_volume = &initial_volume_;
    batch_.volume = &volume;
    batch_.separated_strain = &bank;
    batch_.elastic_energy = &elastic_energy;
    batch_.dissipated = &dissipated;
  }
  OneParticle(const OneParticle& other) : OneParticle(other.parameters_) { *this = other; }
  OneParticle& operator=(const OneParticle& other)
  {
    stress_ = other.stress_;
    deformation_ = other.deformation_;
    volume = other.volume;
    bank = other.bank;
    elastic_energy = other.elastic_energy;
    dissipated = other.dissipated;
    work = other.work;
    return *this;
  }

  /// The full tensor; in plane strain (2, 2) is the out-of-plane stress.
  Eigen::Matrix3d stress() const
  {
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
    if constexpr (Dim == 2) {
      s(0, 0) = stress_[0];
      s(1, 1) = stress_[1];
      s(0, 1) = s(1, 0) = stress_[2];
      s(2, 2) = stress_[3];
    } else {
      s << stress_[0], stress_[3], stress_[4], stress_[3], stress_[1], stress_[5], stress_[4], stress_[5], stress_[2];
    }
    return s;
  }
  void set_stress(const Eigen::Matrix3d& s)
  {
    set_components(s);
    law_->initialise(batch_, 0, 1);
  }

  Mat<Dim> deformation() const
  {
    return Eigen::Map<const Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(deformation_.data());
  }
  /// For laws that keep F.
  void set_deformation(const Mat<Dim>& f)
  {
    set_entries(deformation_, f);
    law_->initialise(batch_, 0, 1);
  }
  /// For fluids: at rest at this volume, of an initial one of 1.
  void set_volume(double v)
  {
    volume = v;
    law_->initialise(batch_, 0, 1);
  }
  /// The same state seen from a frame in which everything is turned by q.
  void turn(const Mat<Dim>& q)
  {
    Eigen::Matrix3d full = Eigen::Matrix3d::Identity();
    full.template topLeftCorner<Dim, Dim>() = q;
    set_components(full * stress() * full.transpose());
    set_entries(deformation_, q * deformation() * q.transpose());
  }

  static constexpr double usual_dt = 1.0 / 1024.0;  // a power of two: dt times the gradient is h to the last bit

  /// Moves the particle by x -> x + h x.
  void step(const Mat<Dim>& h, double dt = usual_dt)
  {
    set_entries(gradient_, h / dt);
    const Eigen::Matrix3d before = rotation(h) * stress() * rotation(h).transpose();
    const double old_volume = volume;
    law_->update(batch_, dt, 0, 1);
    const double mid = 0.5 * (old_volume + volume);
    work += mid * 0.5 * (before + stress()).cwiseProduct(strain(h)).sum();
  }

  Stiffness stiffness() const { return law_->stiffness(batch_, 0, 1); }

  static Eigen::Matrix3d midpoint_gradient(const Mat<Dim>& h)
  {
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
    const Mat<Dim> identity = Mat<Dim>::Identity();
    g.topLeftCorner<Dim, Dim>() = h * (identity + 0.5 * h).inverse();
    return g;
  }
  /// Turned into the frame at the end of the step.
  static Eigen::Matrix3d strain(const Mat<Dim>& h)
  {
    const Eigen::Matrix3d g = midpoint_gradient(h);
    const Eigen::AngleAxisd turn(rotation(h));
    const Eigen::Matrix3d half = Eigen::AngleAxisd(0.5 * turn.angle(), turn.axis()).toRotationMatrix();
    return half * (0.5 * (g + g.transpose())) * half.transpose();
  }
  static Eigen::Matrix3d rotation(const Mat<Dim>& h)
  {
    const Eigen::Matrix3d g = midpoint_gradient(h), half_spin = 0.25 * (g - g.transpose());
    return (Eigen::Matrix3d::Identity() - half_spin).inverse() * (Eigen::Matrix3d::Identity() + half_spin);
  }

  double volume = 1.0, bank = 0.0, elastic_energy = 0.0, dissipated = 0.0;
  double work = 0.0;  ///< trapezoidal work done on the particle, J

private:
  void set_components(const Eigen::Matrix3d& s)
  {
    if constexpr (Dim == 2)
      stress_ = { s(0, 0), s(1, 1), s(0, 1), s(2, 2) };
    else
      stress_ = { s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2) };
  }
  static void set_entries(std::array<double, Dim * Dim>& entries, const Mat<Dim>& m)
  {
    Eigen::Map<Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(entries.data()) = m;
  }

  Parameters parameters_;
  std::unique_ptr<Law<Dim>> law_;
  std::array<double, Dim * Dim> gradient_{}, deformation_{};
  double initial_volume_ = 1.0;
  std::array<double, stress_size<Dim>> stress_{};
  Batch<Dim> batch_{};
};

inline Parameters elastic_soil()
{
  Parameters p;
  p.law = LawName::linear_elastic;
  p.density_kg_per_m3 = 1600.0;
  p.young_modulus_pa = 1e7;
  p.poisson_ratio = 0.3;
  return p;
}

inline Parameters finite(LawName law)
{
  Parameters p = elastic_soil();
  p.law = law;
  return p;
}

inline Parameters slurry(LawName law)
{
  Parameters p;
  p.law = law;
  p.density_kg_per_m3 = 1300.0;
  p.bulk_modulus_pa = 1e6;
  p.viscosity_pa_s = 2.0;
  if (law == LawName::bingham) {
    p.yield_stress_pa = 50.0;
    p.regularisation_rate_per_s = 0.05;
  }
  return p;
}

inline Parameters sand(double friction_deg = 33.0, double dilation_deg = 0.0)
{
  Parameters p = elastic_soil();
  p.law = LawName::mohr_coulomb;
  p.friction_angle_deg = friction_deg;
  p.dilation_angle_deg = dilation_deg;
  return p;
}

inline Parameters clayey(double friction_deg = 25.0, double dilation_deg = 5.0, double cohesion = 1e4,
                         double cutoff = 3e3)
{
  Parameters p = sand(friction_deg, dilation_deg);
  p.cohesion_pa = cohesion;
  p.tension_cutoff_pa = cutoff;
  return p;
}

inline Eigen::Vector3d principal(const Eigen::Matrix3d& stress)  // smallest first
{
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress).eigenvalues();
}

inline double slope(double angle_deg)
{
  const double s = std::sin(angle_deg * pi / 180.0);
  return (1.0 + s) / (1.0 - s);
}

/// How far a stress is beyond yield or cut-off, Pa.
inline double yield_excess(const Parameters& p, const Eigen::Matrix3d& stress)
{
  const Eigen::Vector3d s = principal(stress);
  const double k = slope(p.friction_angle_deg);
  return std::max(k * s(2) - s(0) - 2.0 * p.cohesion_pa * std::sqrt(k), s(2) - p.tension_cutoff_pa);
}

}  // namespace geocontainer_mpm::material::testing
