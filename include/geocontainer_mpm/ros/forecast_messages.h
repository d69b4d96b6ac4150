#pragma once
/// From forecasts to messages: pure functions, no node, no master. Positions stay in the barge's frame: where the barge
/// will be is not known.

#include <geocontainer_mpm/ReleaseEnsemble.h>
#include <geocontainer_mpm/ReleaseForecast.h>

#include <string>

#include "geocontainer_mpm/alarm/alarm_book.h"
#include "geocontainer_mpm/forecast/forecast.h"
#include "geocontainer_mpm/forecast/live_ensemble.h"

namespace geocontainer_mpm::ros_bridge {

/// Names the first quantity that is not finite, or nothing: such a forecast reaches no topic.
std::string first_non_finite(const forecast::Forecast& forecast);

/// `limits`: of the utilisation.
ReleaseForecast to_release_forecast(const forecast::Forecast& forecast, bool stale, const alarm::Limits& limits,
                                    const std::string& barge_frame);
ReleaseEnsemble to_release_ensemble(const forecast::EnsembleForecast& ensemble);

}  // namespace geocontainer_mpm::ros_bridge
