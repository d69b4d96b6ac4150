#pragma once
/// What a scene asks to be measured, as time series.

#include <string>
#include <vector>

#include "geocontainer_mpm/scene/frame.h"
#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/state_access.h"

namespace geocontainer_mpm::scene {

/// Series are plain data and grow by one row a sample; a copy taken before some samples undoes them.
template <int Dim>
class Probes {
public:
  /// Places the tracers of point probes in the model. Throws InputError for a probe that lies on nothing.
  Probes(const SceneDescription& scene, Model<Dim>& model);

  bool empty() const { return series_.empty(); }
  /// One row in every series. `angle_rad`: rotation of every boundary body.
  void sample(const Model<Dim>& model, double time_s, const std::vector<double>& angle_rad);
  /// All samples since the start.
  const std::vector<ProbeFrame>& series() const { return series_; }
  /// A frame is due: from here on another one's samples begin.
  void close_frame();
  /// The samples between the last two frames.
  std::vector<ProbeFrame> of_frame() const;

private:
  friend struct geocontainer_mpm::StateAccess;

  /// What one probe looks at.
  struct Target {
    ProbeDescription probe;
    std::size_t index = 0;    ///< of its tracer, body, sheet or boundary body
    std::size_t node = 0;     ///< of the sheet's point that is followed
    double turned_rad = 0.0;  ///< rotation of a body at the last sample
    double last_s = 0.0;      ///< time of the last sample
    BoundaryTotal<Dim> last;  ///< of a surface, then
  };
  struct Row;  // fills the columns of one sample, see probes.cpp

  void sample_point(const Target& target, const Model<Dim>& model, Row& row) const;
  void sample_body(Target& target, const Model<Dim>& model, Row& row) const;
  void sample_section(const Target& target, const Model<Dim>& model, Row& row) const;
  void sample_geotextile(const Target& target, const Model<Dim>& model, Row& row) const;
  void sample_surface(Target& target, const Model<Dim>& model, double angle_rad, double time_s, Row& row) const;
  void sample_manufactured(const Target& target, const Model<Dim>& model, double time_s, Row& row) const;

  double cell_size_;
  std::vector<Target> targets_;
  std::vector<ProbeFrame> series_;
  std::size_t frame_begin_ = 0, frame_end_ = 0;  ///< rows of the last frame
};

}  // namespace geocontainer_mpm::scene
