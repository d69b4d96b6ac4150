#pragma once
/// Both hull angles as one measurement, from messages that bring them together or one after the other.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "geocontainer_mpm/vessel/nmea_angles.h"
#include "geocontainer_mpm/vessel/stamp.h"

namespace geocontainer_mpm::vessel {

struct OpeningSample {
  Stamp stamp;  ///< of the later of the two angles
  double port_rad = 0.0;
  double starboard_rad = 0.0;
};

/// Each angle is used once: a half that has gone silent is not made up from its last value.
class OpeningPair {
public:
  /// Two angles further apart in time than this are not one measurement.
  explicit OpeningPair(std::chrono::nanoseconds most_apart) : most_apart_(most_apart) {}

  /// A sample when this angle completes one.
  std::optional<OpeningSample> add(HullHalf half, Stamp stamp, double angle_rad)
  {
    std::optional<Angle>& mine = half == HullHalf::port ? port_ : starboard_;
    unpaired_ += mine.has_value() ? 1 : 0;
    mine = Angle{ stamp, angle_rad };
    if (!port_ || !starboard_)
      return std::nullopt;
    const auto apart =
        port_->stamp < starboard_->stamp ? starboard_->stamp - port_->stamp : port_->stamp - starboard_->stamp;
    if (apart > most_apart_) {
      (port_->stamp < starboard_->stamp ? port_ : starboard_).reset();
      ++unpaired_;
      return std::nullopt;
    }
    const OpeningSample sample{ std::max(port_->stamp, starboard_->stamp), port_->angle_rad, starboard_->angle_rad };
    port_.reset();
    starboard_.reset();
    return sample;
  }

  /// Angles for which the other half did not come.
  std::uint64_t unpaired() const { return unpaired_; }

private:
  struct Angle {
    Stamp stamp;
    double angle_rad;
  };
  std::chrono::nanoseconds most_apart_;
  std::optional<Angle> port_, starboard_;
  std::uint64_t unpaired_ = 0;
};

}  // namespace geocontainer_mpm::vessel
