#pragma once
/// Rules that tie several keys together; those of a single key stand in description_grammar.h.

#include "geocontainer_mpm/scene/description.h"

namespace geocontainer_mpm::scene {

/// Throws InputError without a source. Every key by itself is within its limits already.
void check_rules(const SceneDescription& scene);

}  // namespace geocontainer_mpm::scene
