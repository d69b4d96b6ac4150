#pragma once
/// What a run leaves for its user: the summary file and a table.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace geocontainer_mpm::program {

/// Throws an InputError naming `option` where a file at `path` could not be written; found before a long run.
void check_output(const std::string& option, const std::string& path);

/// Replaces the file at once (written beside it, then renamed): a reader sees the old text or the new one, never half.
/// Throws an InputError naming the option.
void write_file(const std::string& option, const std::string& path, const std::string& text);

/// The main results, for people.
std::string table(const nlohmann::ordered_json& summary);

}  // namespace geocontainer_mpm::program
