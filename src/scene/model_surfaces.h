#pragma once
/// Geotextiles and rigid surfaces at the start, from their descriptions in the section.

#include <string>

#include "geocontainer_mpm/scene/model.h"
#include "geocontainer_mpm/scene/prescribed_motion.h"

namespace geocontainer_mpm::scene {

/// A geotextile as it is described, not yet in a field; in space the surface of the body that it encloses.
template <int Dim>
ModelSheet<Dim> lay_sheet(const std::string& name, const GeotextileDescription& description,
                          const SceneDescription& scene);

/// A rigid surface drawn in the section: in space it reaches through all of it.
template <int Dim>
contact::BoundaryBody<Dim> rigid_surface(const std::string& name, contact::Surface section, double friction,
                                         double spacing, const SceneDescription& scene);

/// Half of an end of the hopper.
contact::BoundaryBody<3> bulkhead(const HullPart& part, double spacing, const HullDescription& hull);

}  // namespace geocontainer_mpm::scene
