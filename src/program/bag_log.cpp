#include "bag_log.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <filesystem>
#include <set>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/ros/opening_conversion.h"

namespace geocontainer_mpm::program {
namespace {

/// `/barge/hull_opening` is a hull_opening, `/my_hull_opening` is not.
bool has_base_name(const std::string& topic, const std::string& name)
{
  return topic == name || (topic.size() > name.size() && topic[topic.size() - name.size() - 1] == '/' &&
                           topic.compare(topic.size() - name.size(), name.size(), name) == 0);
}

std::set<std::string> topics_of(const rosbag::Bag& bag)
{
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    topics.insert(connection->topic);
  return topics;
}

std::string join(const std::set<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

std::string choose_topic(const BagSource& source, const std::set<std::string>& topics)
{
  if (!source.topic.empty()) {
    for (const std::string& name : { source.topic, "/" + source.topic })
      if (topics.count(name) != 0)
        return name;
    throw InputError(source.path, "--opening-topic", source.topic, "is not in the bag; it has: " + join(topics));
  }
  for (const char* name : { "hull_opening", "joint_states" }) {
    std::set<std::string> found;
    for (const std::string& topic : topics)
      if (has_base_name(topic, name))
        found.insert(topic);
    if (found.size() > 1)
      throw InputError(source.path, name, join(found), "is ambiguous, choose one by --opening-topic");
    if (found.size() == 1)
      return *found.begin();
  }
  throw InputError(
      source.path, "hull_opening", "",
      "the bag has neither hull_opening nor joint_states (--opening-topic names another); it has: " + join(topics));
}

std::vector<barge::OpeningSample> read_topic(const rosbag::Bag& bag, const BagSource& source, const std::string& topic)
{
  const ros_bridge::OpeningJoints joints = { source.port_joint, source.starboard_joint };
  std::vector<barge::OpeningSample> samples;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    if (const auto opening = message.instantiate<HullOpening>()) {
      samples.push_back(ros_bridge::to_sample(*opening));
    } else if (const auto state = message.instantiate<sensor_msgs::JointState>()) {
      if (const auto sample = ros_bridge::to_sample(*state, joints))
        samples.push_back(*sample);
    } else {
      throw InputError(source.path, topic, message.getDataType(),
                       "must be geocontainer_mpm/HullOpening (of this version) or sensor_msgs/JointState");
    }
  }
  if (samples.empty())
    throw InputError(source.path, topic, "",
                     "holds no opening: no message, or no joint " + joints.port + " or " + joints.starboard);
  return samples;
}

}  // namespace

std::vector<barge::OpeningSample> read_bag(const BagSource& source)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(source.path, error))
    throw InputError("command line", "--bag", source.path, "is not a file");
  try {
    const rosbag::Bag bag(source.path, rosbag::bagmode::Read);
    return read_topic(bag, source, choose_topic(source, topics_of(bag)));
  } catch (const InputError&) {
    throw;
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError("command line", "--bag", source.path,
                     "is incomplete (recording was cut off); `rosbag reindex` may save it");
  } catch (const std::exception& exception) {  // rosbag's own, and whatever garbage makes the libraries under it throw
    throw InputError("command line", "--bag", source.path, std::string("is not a complete bag: ") + exception.what());
  }
}

}  // namespace geocontainer_mpm::program
