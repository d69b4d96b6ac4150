#pragma once
/// Boundary particles: a rigid body that is only its surface, moved by prescription (Hamad, Stolle and Moormann 2016,
/// section 2: the non-zero kinematic condition). They have no mass; they carry position, velocity and normal to the
/// grid.
///
/// In three dimensions a body is a section that is extruded along x, or a flat plate across x (a bulkhead). Where they
/// close a corner together both reach a little further than it: a point that is pressed a hair into the one must not
/// lose sight of the other.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geocontainer_mpm/contact/surface.h"

namespace geocontainer_mpm::contact {

template <int Dim>
class BoundaryBody {
public:
  /// In the plane. Particles at most `spacing` (m) apart along `surface` in its reference position; Coulomb coefficient
  /// `friction`.
  BoundaryBody(std::string name, Surface surface, double friction, double spacing)
      : BoundaryBody(std::move(name), std::move(surface), friction)
  {
    static_assert(Dim == 2, "in space a surface has a stretch of x");
    line_up(spacing);
  }
  /// In space: `section` extruded. Beyond the ends of the stretch there is nothing.
  BoundaryBody(std::string name, Surface section, Along along, double friction, double spacing)
      : BoundaryBody(std::move(name), std::move(section), friction)
  {
    static_assert(Dim == 3, "in the plane a surface has no stretch of x");
    extrude(along, spacing);
  }
  /// A flat plate across x, at x = `at_x`: the inside of a closed section, whichever way it runs. Free on the side
  /// `free_side` (1 or -1) along x. It is thin: nothing sees it from further behind than half its spacing.
  static BoundaryBody plate(std::string name, Surface outline, double at_x, double free_side, double friction,
                            double spacing)
  {
    static_assert(Dim == 3, "a plate lies across x");
    BoundaryBody body(std::move(name), std::move(outline), friction);
    body.fill_outline(at_x, free_side, spacing);
    return body;
  }

  /// Where the body is at the start and at the end of the step of `dt` seconds. Both poses have the same pivot.
  void set_motion(const RigidPose& start, const RigidPose& end, double dt)
  {
    start_ = start;
    end_ = end;
    inverse_dt_ = dt > 0.0 ? 1.0 / dt : 0.0;
  }

  const std::string& name() const { return name_; }
  double friction() const { return friction_; }
  /// Is the section, or the outline of a plate?
  bool closed() const { return surface_.closed(); }
  std::size_t size() const { return reference_.size(); }
  /// Box around the surface before any motion, m.
  const Vec<Dim>& reference_lower() const { return reference_lower_; }
  const Vec<Dim>& reference_upper() const { return reference_upper_; }
  /// Position before any motion, m.
  const Vec<Dim>& reference(std::size_t particle) const { return reference_[particle]; }
  /// In space: joins the particles to the whole surface. Seen from the free side they run counter-clockwise.
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  /// Position at the start of the step: the exact rigid motion of the reference, m.
  Vec<Dim> position(std::size_t particle) const { return start_.apply(reference_[particle]); }
  /// Mean velocity over the step: carries the particle exactly to its next position, m/s.
  Vec<Dim> velocity(std::size_t particle) const
  {
    return (end_.apply(reference_[particle]) - start_.apply(reference_[particle])) * inverse_dt_;
  }
  /// Unit, into the free side, at the start of the step.
  Vec<Dim> normal(std::size_t particle) const { return start_.turn(normal_[particle]); }
  /// Mean velocity over the step of the body at a point, m/s.
  Vec<Dim> velocity_at(const Vec<Dim>& point) const { return (end_.apply(start_.invert(point)) - point) * inverse_dt_; }
  /// Lever in the section of a force at a point that moves with the body, mean over the step: from pivot + shift, m.
  /// With it force . shift + moment * turn is the work of a step, to the square of the step's turn over 12.
  Vec2 arm_at(const Vec<Dim>& point) const
  {
    const Vec2 lever = start_.invert(in_section(point)) - start_.pivot;
    return 0.5 * (start_.turn(lever) + end_.turn(lever));
  }
  /// False only where the surface is certainly further than `reach` (m): a cheap first look.
  bool may_touch(const Vec<Dim>& point, double reach) const
  {
    if constexpr (Dim == 3)  // motion leaves x alone
      if (point[0] < reference_lower_[0] - reach || point[0] > reference_upper_[0] + reach)
        return false;
    const Vec2 x = start_.invert(in_section(point));
    return (x.array() >= in_section(reference_lower_).array() - reach).all() &&
           (x.array() <= in_section(reference_upper_).array() + reach).all();
  }
  /// Signed distance of a point to the surface at the start of the step, and the normal there.
  Nearest<Dim> nearest(const Vec<Dim>& point) const;

private:
  BoundaryBody(std::string name, Surface surface, double friction);
  void line_up(double spacing);
  void extrude(const Along& along, double spacing);
  void fill_outline(double at_x, double free_side, double spacing);
  void add_lattice(const std::array<Vec<3>, 4>& corner, const Vec<3>& normal, double spacing);

  std::string name_;
  Surface surface_;
  double friction_;
  std::vector<Vec<Dim>> reference_, normal_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Vec<Dim> reference_lower_, reference_upper_;  ///< bounding box of the surface
  double free_side_ = 0.0;                      ///< of a plate, along x; 0: not a plate
  double depth_ = 0.0;                          ///< of a plate: nothing sees it from further behind, m
  RigidPose start_, end_;
  double inverse_dt_ = 0.0;
};

}  // namespace geocontainer_mpm::contact
