#pragma once
/// What is not known for certain: a scene's numbers as distributions.

#include <limits>
#include <string>
#include <vector>

namespace geocontainer_mpm::ensemble {

enum class Shape { uniform, triangular, normal, lognormal };
const char* to_string(Shape shape);

/// Distribution of one number, in its own unit.
struct Distribution {
  Shape shape = Shape::uniform;
  /// Ends. Of `normal` and `lognormal` what lies outside is cut off, and they may be open.
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  /// `triangular`: the most likely value; `normal`: the mean, `lognormal`: the median, both before the cut.
  double middle = 0.0;
  /// `normal`: standard deviation, > 0; `lognormal`: factor > 1, two of three draws lie between the median over it and
  /// the median times it; both before the cut.
  double spread = 0.0;

  /// Value below which the part `p` of all draws lies, 0 < p < 1.
  double quantile(double p) const;
  /// Throws InputError naming `key.<parameter>`.
  void validate(const std::string& key) const;
};

/// A scene key that is drawn.
struct Input {
  std::string key;  ///< dotted, as for `--set`
  Distribution distribution;
};

/// Reads a YAML file with a map `draw` of distributions by scene key (docs/how-to.md). Throws InputError. Whether a
/// scene has the keys shows when it is loaded with values for them.
std::vector<Input> load_inputs(const std::string& path);
std::vector<Input> parse_inputs(const std::string& yaml, const std::string& source);

/// Below which the part `p` of a standard normal distribution lies: algorithm AS 241 (Wichura 1988, Appl. Statist.
/// 37:477), relative accuracy 1e-16.
double normal_quantile(double p);

}  // namespace geocontainer_mpm::ensemble
