#pragma once
/// Boundary particles: a rigid body that is only its surface, moved by prescription (Hamad, Stolle and Moormann 2016,
/// section 2: the non-zero kinematic condition). They have no mass; they carry position, velocity and normal to the
/// grid.

#include <string>
#include <vector>

#include "geocontainer_mpm/contact/surface.h"

namespace geocontainer_mpm::contact {

class BoundaryBody {
public:
  /// Particles at most `spacing` (m) apart along `surface` in its reference position; Coulomb coefficient `friction`.
  BoundaryBody(std::string name, Surface surface, double friction, double spacing);

  /// Where the body is at the start and at the end of the step of `dt` seconds. Both poses have the same pivot.
  void set_motion(const RigidPose& start, const RigidPose& end, double dt);

  const std::string& name() const { return name_; }
  double friction() const { return friction_; }
  bool closed() const { return surface_.closed(); }
  std::size_t size() const { return reference_.size(); }
  /// Box around the surface before any motion, m.
  const Vec2& reference_lower() const { return reference_lower_; }
  const Vec2& reference_upper() const { return reference_upper_; }
  /// Position before any motion, m.
  const Vec2& reference(std::size_t particle) const { return reference_[particle]; }
  /// Position at the start of the step: the exact rigid motion of the reference, m.
  Vec2 position(std::size_t particle) const { return start_.apply(reference_[particle]); }
  /// Mean velocity over the step: carries the particle exactly to its next position, m/s.
  Vec2 velocity(std::size_t particle) const
  {
    return (end_.apply(reference_[particle]) - start_.apply(reference_[particle])) * inverse_dt_;
  }
  /// Unit, into the free side, at the start of the step.
  Vec2 normal(std::size_t particle) const { return start_.turn(normal_[particle]); }
  /// Mean velocity over the step of the body at a point, m/s.
  Vec2 velocity_at(const Vec2& point) const { return (end_.apply(start_.invert(point)) - point) * inverse_dt_; }
  /// Lever of a force at a point that moves with the body, mean over the step: from pivot + shift, m. With it
  /// force . shift + moment * turn is the work of a step, to the square of the step's turn over 12.
  Vec2 arm_at(const Vec2& point) const
  {
    const Vec2 lever = start_.invert(point) - start_.pivot;
    return 0.5 * (start_.turn(lever) + end_.turn(lever));
  }
  /// False only where the surface is certainly further than `reach` (m): a cheap first look.
  bool may_touch(const Vec2& point, double reach) const
  {
    const Vec2 x = start_.invert(point);
    return (x.array() >= reference_lower_.array() - reach).all() &&
           (x.array() <= reference_upper_.array() + reach).all();
  }
  /// Signed distance of a point to the surface at the start of the step, and the normal there.
  Nearest nearest(const Vec2& point) const;

private:
  std::string name_;
  Surface surface_;
  double friction_;
  std::vector<Vec2> reference_, normal_;
  Vec2 reference_lower_, reference_upper_;  ///< bounding box of the surface
  RigidPose start_, end_;
  double inverse_dt_ = 0.0;
};

}  // namespace geocontainer_mpm::contact
