#pragma once
/// A split hull: two mirrored rigid halves that turn about one hinge axis along x.
///
/// Frame: the y-z plane of `base_link` (component 0 = y to port, component 1 = z up; x forward points at the viewer who
/// sees y to the left, so that counter-clockwise in (y, z) is positive about +x). An opening angle is >= 0 and turns
/// the port half by +angle and the starboard half by -angle about +x: what hangs below the hinge moves outboard.

#include <vector>

#include "geocontainer_mpm/barge/opening_signal.h"
#include "geocontainer_mpm/contact/surface.h"
#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::barge {

enum class HullHalf { port, starboard };

class SplitHull {
public:
  /// `port_section_m`: the closed port half as an open polyline with the free side on the left walking along it, on
  /// y >= 0 (its lip touches the mirror image at y = 0 when the hopper is tight). Throws InputError naming
  /// `key_prefix.hinge_m` or `key_prefix.port_section_m[i]`.
  SplitHull(const Vec2& hinge_m, std::vector<Vec2> port_section_m, const std::string& key_prefix);

  const Vec2& hinge_m() const { return hinge_m_; }
  /// Closed section of a half. Starboard is the mirror image in reversed order, so that its free side is on the left
  /// too.
  const std::vector<Vec2>& closed_section_m(HullHalf half) const;
  /// Pose of a half at an opening angle (>= 0: open).
  contact::RigidPose pose(HullHalf half, double opening_rad) const;
  contact::RigidPose pose(HullHalf half, const OpeningAngles& opening) const;
  std::vector<Vec2> section_m(HullHalf half, const OpeningAngles& opening) const;

  /// Width of the narrowest passage between the halves: horizontal distance between the vertical tangents to the port
  /// half from starboard and to the starboard half from port, m. Negative where the halves would overlap.
  double slot_width_m(const OpeningAngles& opening) const;
  /// Level (z) of the lowest point of either half, m: what is wholly below it has left the hull.
  double lowest_level_m(const OpeningAngles& opening) const;

private:
  Vec2 hinge_m_;
  std::vector<Vec2> port_;
  std::vector<Vec2> starboard_;
};

/// The polyline with every corner replaced by an arc of `radius_m` tangent to both its sides, itself given as chords
/// that turn by `max_turn_rad` at most; their ends lie on the arc, the first and the last on the sides. End points
/// stay. Straight-on vertices stay as they are. Throws InputError naming `key` when the radius is negative or not
/// finite, or an arc does not fit between its neighbours, or the line turns back on itself.
std::vector<Vec2> round_corners(const std::vector<Vec2>& line_m, double radius_m, double max_turn_rad,
                                const std::string& key);

}  // namespace geocontainer_mpm::barge
