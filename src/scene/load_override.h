#pragma once
/// `dotted.key=value` overrides of a scene.

#include <yaml-cpp/yaml.h>

#include <string>

namespace geocontainer_mpm::scene {

/// Where messages say that an overridden value came from, after the scene's file.
inline constexpr const char* override_source = "--set";

/// Puts the value into the tree and returns the dotted key. Throws InputError (source `--set`) for a key that the
/// grammar does not have or that belongs to something the scene does not have. Its type is checked on reading.
std::string apply_override(const YAML::Node& root, const std::string& assignment);

}  // namespace geocontainer_mpm::scene
