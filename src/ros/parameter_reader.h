#pragma once
/// Reads a node's private parameters, strictly: every key known, every type and range right, or one line that says what
/// is not.

#include <fmt/format.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::ros_bridge {

/// Takes values out of the parameter struct by key and remembers which keys are known.
class ParameterReader {
public:
  using XmlRpcValue = XmlRpc::XmlRpcValue;

  /// `within`: of a dictionary among the parameters its name and a slash.
  ParameterReader(const XmlRpcValue& tree, std::string source, std::string within = "")
      : tree_(tree), source_(std::move(source)), within_(std::move(within))
  {
    if (tree_.valid() && tree_.getType() != XmlRpcValue::TypeStruct)
      throw InputError(source_, within_.empty() ? "private parameters" : "~" + within_, "", "must be a dictionary");
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

  /// Points [y, z], m; replaces what is there.
  void read(const char* key, std::vector<std::array<double, 2>>& points)
  {
    const auto found = find(key);
    if (!found)
      return;
    const char* const allowed = "must be a list of points [y, z], m";
    expect(key, *found, XmlRpcValue::TypeArray, allowed);
    points.clear();
    for (int i = 0; i < found->size(); ++i) {
      XmlRpcValue& point = expect(key, (*found)[i], XmlRpcValue::TypeArray, allowed);
      if (point.size() != 2)
        fail(key, *found, allowed);
      points.push_back({ number(key, point[0], allowed), number(key, point[1], allowed) });
    }
  }

  /// A reader of the dictionary under this key; of an empty one when there is none.
  ParameterReader dictionary(const char* key)
  {
    const auto found = find(key);
    return { found ? *found : XmlRpcValue(), source_, within_ + key + "/" };
  }

  /// Readers of the dictionaries in the list under this key.
  std::vector<ParameterReader> dictionaries(const char* key)
  {
    std::vector<ParameterReader> readers;
    const auto found = find(key);
    if (!found)
      return readers;
    expect(key, *found, XmlRpcValue::TypeArray, "must be a list of dictionaries");
    for (int i = 0; i < found->size(); ++i)
      readers.emplace_back((*found)[i], source_, fmt::format("{}{}[{}]/", within_, key, i));
    return readers;
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
    throw InputError(source_, "~" + within_ + key, text, allowed);
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

  double number(const std::string& key, XmlRpcValue& value, const std::string& allowed) const
  {
    if (value.getType() == XmlRpcValue::TypeInt)
      return static_cast<int&>(value);
    const double read = expect(key, value, XmlRpcValue::TypeDouble, allowed);
    if (!std::isfinite(read))
      fail(key, value, allowed);
    return read;
  }

  std::string joined() const
  {
    std::string text;
    for (const std::string& key : known_)
      text += (text.empty() ? "" : ", ") + key;
    return text;
  }

  XmlRpcValue tree_;
  std::string source_, within_;
  std::set<std::string> known_;
};

}  // namespace geocontainer_mpm::ros_bridge
