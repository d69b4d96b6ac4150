#include "case.h"

#include <fmt/format.h>

#include <algorithm>

#include "angles_csv.h"
#include "geocontainer_mpm/error.h"
#ifdef GEOCONTAINER_MPM_WITH_ROS
#include "bag_log.h"
#endif

namespace geocontainer_mpm::program {

scene::SceneDescription load_case(const Options& options, const std::vector<std::string>& overrides)
{
  scene::SceneDescription scene = scene::load_scene(options.scene, overrides);
  if (options.until_s)
    scene.time.end_s = std::min(scene.time.end_s, *options.until_s);
  if (!scene.hull && (!options.bag.empty() || !options.angles.empty()))
    throw InputError(options.scene, "hull", "", "missing, but a log of opening angles needs a hull to open");
  return scene;
}

std::vector<barge::OpeningSample> read_log(const Options& options)
{
  if (!options.angles.empty())
    return read_angles_csv(options.angles);
  if (options.bag.empty())
    return {};
#ifdef GEOCONTAINER_MPM_WITH_ROS
  return read_bag({ options.bag, options.opening_topic, options.port_joint, options.starboard_joint });
#else
  throw InputError("command line", "--bag", options.bag, "this simulate was built without ROS and reads no bags");
#endif
}

void open_hull(const Options& options, const std::vector<barge::OpeningSample>& samples, scene::Simulation& simulation)
{
  if (samples.empty()) {
    simulation.use_scene_opening();
    return;
  }
  barge::OpeningSignal& opening = simulation.opening();
  for (const barge::OpeningSample& sample : samples)
    opening.add(sample);
  if (opening.empty())
    throw InputError(options.angles.empty() ? options.bag : options.angles, "opening", "",
                     fmt::format("none of its {} samples is believable (keys under hull.signal)", samples.size()));
  opening.finish();
}

}  // namespace geocontainer_mpm::program
