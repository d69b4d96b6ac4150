#pragma once
/// Runs the members of an ensemble and says what they have in common.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geocontainer_mpm/ensemble/distribution.h"
#include "geocontainer_mpm/ensemble/statistics.h"
#include "geocontainer_mpm/scene/simulation.h"

namespace geocontainer_mpm::ensemble {

/// How a member ended.
enum class Ending {
  completed,   ///< reached the end of the scene
  failed,      ///< could not be built, or the solver had to stop; see `why`
  interrupted  ///< was not run to its end because the user stopped it
};
const char* to_string(Ending ending);

/// A result of a member that statistics are made of.
struct Figure {
  const char* name;  ///< as in the summary
  const char* unit;  ///< `1` for a number without
};
/// Peak tension and utilisation, release time, residual tension, final width and height.
const std::vector<Figure>& figures();
/// Indices in figures(). A member that was not released lacks the release time.
std::size_t peak_tension_figure();
std::size_t peak_utilisation_figure();
std::size_t release_time_figure();
std::size_t width_figure();

struct Member {
  Ending ending = Ending::interrupted;
  std::string why;  ///< of one that failed, one sentence
  scene::Outcome outcome = scene::Outcome::none;
  std::vector<std::optional<double>> figures;  ///< in the order of figures(); none: it has not come to that
  std::size_t ruptures = 0;                    ///< pieces of sheets that broke
  std::uint64_t digest = 0;
};

/// From where it is to the end of its scene, or until `done()` says that there is nothing more to see; interrupted when
/// `stop()` says so.
Member advance_member(scene::Simulation& simulation, const std::function<bool(const scene::Simulation&)>& done,
                      const std::function<bool()>& stop);
Member failed_member(const std::string& why);

/// Runs one member on one thread, until `stop()` says so. `open` gives the run its opening. Never throws: what goes
/// wrong is in the result.
Member run_member(const scene::SceneDescription& scene, const std::function<void(scene::Simulation&)>& open,
                  const std::function<bool()>& stop);

/// Runs members on so many threads, whichever is free taking the next one. The result does not depend on their number.
/// `run(i)` gives member i; `done()` is called after each, by one thread at a time.
std::vector<Member> run_members(std::size_t count, int threads, const std::function<Member(std::size_t)>& run,
                                const std::function<void()>& done);

/// Of one figure.
struct FigureSummary {
  double p10 = 0.0, p50 = 0.0, p90 = 0.0;               ///< infinite: not within the run
  std::vector<std::optional<double>> rank_correlation;  ///< with each input, in their order
  std::optional<std::size_t> most_important;            ///< input whose correlation is largest and not chance alone
};

/// Of the members that completed.
struct Summary {
  std::size_t members = 0, completed = 0;
  std::map<scene::Outcome, std::size_t> outcomes;
  std::optional<Share> hung_up, ruptured,
      overloaded;                      ///< overloaded: more tension than sheet or seam bears; none: no member
  std::vector<FigureSummary> figures;  ///< in the order of figures(); empty: no member
  double chance = 1.0;                 ///< correlations below it say nothing, see chance_correlation()
};

/// `values`: what was drawn, as draw() gives it.
Summary summarise(const std::vector<Member>& members, const std::vector<std::vector<std::string>>& values);

/// As JSON text and back: for other processes. Numbers keep their bits.
std::string to_text(const std::vector<Member>& members);
std::vector<Member> from_text(const std::string& text);

}  // namespace geocontainer_mpm::ensemble
