#pragma once
/// What should make a reader doubt a run that came to its end: laws that its own figures break.

#include <string>
#include <vector>

#include "geocontainer_mpm/scene/description.h"
#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::scene {

/// Largest part of what changed hands that the energy balance may be open by, and largest change of the soil's volume.
constexpr double doubtful_share = 0.03;

/// Weight of all bodies and sheets in air, N/m.
double weight_in_air_n_per_m(const SceneDescription& scene);

/// One sentence a doubt, at the end of a run. `weight_n_per_m`: of all bodies and sheets as they are now, less
/// buoyancy.
///
/// What weight can do to a sheet at rest: below any level under which the hull does not reach it, a container is held
/// by the sheet's two legs, which carry the weight below that level and what the fill above presses on it; the fill
/// above is itself part of the weight, so that two upright legs share no more than all of it (equilibrium; the design
/// rule tension_hanging). On a bed the thrust of the fill on an upright cut takes the legs' place and is less:
/// gamma h^2 / 4 in a tube of fluid without pressure at its top (Leshchinsky et al. 1996), at most h / (2 b) of
/// W = gamma b h. More than W / 2 at rest is therefore locked in, and not by weight. A container that still waits in a
/// closed hull is not judged: it may have been laid in taut.
std::vector<std::string> doubts(const StatusFrame& status, const EnergyFrame& energy, double weight_n_per_m);

}  // namespace geocontainer_mpm::scene
