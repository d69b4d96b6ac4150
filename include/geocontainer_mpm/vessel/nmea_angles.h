#pragma once
/// The sentences of this package: hull angles as XDR, in and out, and the release as one proprietary sentence, out.

#include <string>
#include <vector>

#include "geocontainer_mpm/vessel/figures.h"
#include "geocontainer_mpm/vessel/nmea0183.h"

namespace geocontainer_mpm::vessel {

/// How this vessel's transducers are called.
struct NmeaNames {
  std::string talker = "II";       ///< of the sentences sent: two capitals or digits, not beginning with P
  std::string port = "HULL_PORT";  ///< transducer names in XDR
  std::string starboard = "HULL_STBD";
};

enum class HullHalf { port, starboard };

struct HullAngle {
  HullHalf half;
  double angle_rad;
};

/// The watched transducers of an XDR (quadruples of type, value, unit, name), which are those of type A (angle) and
/// unit D (degrees) with a name of `names`. Other sentences and transducers are not ours and no fault.
std::vector<HullAngle> read_hull_angles(const Sentence& sentence, const NmeaNames& names, NmeaCounts& counts);

/// `$--XDR,A,<port>,D,<name>,A,<starboard>,D,<name>*hh`, degrees with four decimals; two sentences where one would be
/// too long. An angle that is not finite is sent as an empty field.
std::vector<std::string> write_hull_angles(double port_rad, double starboard_rad, const NmeaNames& names);

/// `$PGCM,1,<state>,<peak utilisation, %>,<peak tension, N/m>,<tension now, N/m>,<centroid z, m>,<width, m>,<release
/// time, s>,<lag, s>*hh`: version of the sentence, W waiting, R releasing, O out, H hung up, N no release, S stopped;
/// an unknown figure is an empty field.
std::string write_release(const ReleaseFigures& figures);

}  // namespace geocontainer_mpm::vessel
