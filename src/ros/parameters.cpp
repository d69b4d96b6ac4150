#include "geocontainer_mpm/ros/parameters.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ros_bridge {
namespace {

using XmlRpc::XmlRpcValue;

/// Takes values out of the parameter struct by key and remembers which keys are known.
class Reader {
public:
  Reader(const XmlRpcValue& tree, std::string source) : tree_(tree), source_(std::move(source))
  {
    if (tree_.valid() && tree_.getType() != XmlRpcValue::TypeStruct)
      throw InputError(source_, "private parameters", "", "must be a dictionary");
  }

  void read(const char* key, std::string& value)
  {
    if (const auto found = find(key))
      value = static_cast<std::string&>(expect(key, *found, XmlRpcValue::TypeString, "must be text"));
  }

  void read(const char* key, bool& value)
  {
    if (const auto found = find(key))
      value = static_cast<bool&>(expect(key, *found, XmlRpcValue::TypeBoolean, "must be true or false"));
  }

  void read(const char* key, int& value, int lowest, int highest)
  {
    const auto found = find(key);
    if (!found)
      return;
    const std::string allowed = fmt::format("must be a whole number from {} to {}", lowest, highest);
    value = static_cast<int&>(expect(key, *found, XmlRpcValue::TypeInt, allowed));
    if (value < lowest || value > highest)
      fail(key, *found, allowed);
  }

  /// Open below, closed above: (above, highest]. `above` itself is allowed when `closed`.
  void read(const char* key, double& value, double above, double highest, bool closed = false)
  {
    const auto found = find(key);
    if (!found)
      return;
    const std::string allowed = fmt::format("must be a number in {}{}, {}{}", closed ? '[' : '(', above, highest,
                                            std::isinf(highest) ? ')' : ']');
    if (found->getType() == XmlRpcValue::TypeInt)
      value = static_cast<int&>(*found);
    else
      value = static_cast<double&>(expect(key, *found, XmlRpcValue::TypeDouble, allowed));
    const bool high_enough = closed ? value >= above : value > above;
    if (!std::isfinite(value) || !high_enough || value > highest)
      fail(key, *found, allowed);
  }

  void read(const char* key, std::vector<std::string>& values)
  {
    const auto found = find(key);
    if (!found)
      return;
    const char* const allowed = "must be a list of texts of the form dotted.key=value";
    expect(key, *found, XmlRpcValue::TypeArray, allowed);
    for (int i = 0; i < found->size(); ++i)
      values.push_back(static_cast<std::string&>(expect(key, (*found)[i], XmlRpcValue::TypeString, allowed)));
  }

  void refuse_unknown()
  {
    if (!tree_.valid())
      return;
    for (auto& entry : tree_)
      if (known_.count(entry.first) == 0)
        fail(entry.first, entry.second, "is not a parameter of this node; known are " + joined());
  }

  [[noreturn]] void fail(const std::string& key, const XmlRpcValue& value, const std::string& allowed) const
  {
    std::string text = value.valid() ? value.toXml() : "";
    if (value.getType() == XmlRpcValue::TypeString)
      text = static_cast<std::string>(XmlRpcValue(value));
    throw InputError(source_, "~" + key, text, allowed);
  }

private:
  XmlRpcValue* find(const char* key)
  {
    known_.insert(key);
    return tree_.valid() && tree_.hasMember(key) ? &tree_[key] : nullptr;
  }

  XmlRpcValue& expect(const std::string& key, XmlRpcValue& value, XmlRpcValue::Type type,
                      const std::string& allowed) const
  {
    if (value.getType() != type)
      fail(key, value, allowed);
    return value;
  }

  std::string joined() const
  {
    std::string text;
    for (const std::string& key : known_)
      text += (text.empty() ? "" : ", ") + key;
    return text;
  }

  XmlRpcValue tree_;
  std::string source_;
  std::set<std::string> known_;
};

void require_text(const Reader& reader, const char* key, const std::string& value)
{
  if (value.empty())
    reader.fail(key, XmlRpcValue(), "must be given and not be empty");
}

void require_writable_directory(const Reader& reader, const char* key, const std::filesystem::path& directory)
{
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error) || ::access(directory.c_str(), W_OK | X_OK) != 0)
    reader.fail(key, XmlRpcValue(directory.string()), "must be (in) an existing directory that this node may write to");
}

}  // namespace

NodeParameters parse_parameters(const XmlRpcValue& tree, const std::string& source)
{
  NodeParameters parameters;
  const double unlimited = std::numeric_limits<double>::infinity();
  Reader reader(tree, source);
  reader.read("scene", parameters.scene);
  reader.read("scene_overrides", parameters.scene_overrides);
  reader.read("threads", parameters.threads, 1, 256);
  reader.read("autostart", parameters.autostart);
  reader.read("port_joint", parameters.joints.port);
  reader.read("starboard_joint", parameters.joints.starboard);
  reader.read("queue_size", parameters.queue_size, 1, 10'000'000);
  reader.read("max_future_s", parameters.max_future_s, 0.0, unlimited);
  reader.read("time_jump_back_s", parameters.time_jump_back_s, 0.0, unlimited);
  reader.read("transport_patience_s", parameters.transport_patience_s, 0.0, 60.0, true);
  reader.read("finish_when_source_leaves", parameters.finish_when_source_leaves);
  reader.read("fixed_frame", parameters.fixed_frame);
  reader.read("barge_frame", parameters.barge_frame);
  reader.read("display_width_m", parameters.display_width_m, 0.0, unlimited);
  reader.read("publish_rate_hz", parameters.publish_rate_hz, 0.0, 1000.0);
  reader.read("soil_stride", parameters.soil_stride, 1, 1'000'000);
  reader.read("record", parameters.record);
  reader.read("save_directory", parameters.save_directory);
  reader.read("service_timeout_s", parameters.service_timeout_s, 0.0, 3600.0);
  reader.read("diagnostic_period", parameters.diagnostic_period, 0.0, 3600.0);
  reader.refuse_unknown();

  require_text(reader, "scene", parameters.scene);
  require_text(reader, "port_joint", parameters.joints.port);
  require_text(reader, "starboard_joint", parameters.joints.starboard);
  require_text(reader, "fixed_frame", parameters.fixed_frame);
  require_text(reader, "barge_frame", parameters.barge_frame);
  if (parameters.joints.port == parameters.joints.starboard)
    reader.fail("starboard_joint", XmlRpcValue(parameters.joints.starboard), "must differ from ~port_joint");
  require_writable_directory(reader, "save_directory", parameters.save_directory);
  if (!parameters.record.empty()) {
    const std::filesystem::path directory = std::filesystem::path(parameters.record).parent_path();
    require_writable_directory(reader, "record", directory.empty() ? "." : directory);
  }
  return parameters;
}

NodeParameters load_parameters(const ros::NodeHandle& private_handle)
{
  XmlRpcValue tree;
  private_handle.getParam(private_handle.getNamespace(), tree);  // stays invalid when there is none at all
  return parse_parameters(tree, private_handle.getNamespace());
}

}  // namespace geocontainer_mpm::ros_bridge
