#pragma once

namespace geocontainer_mpm {

/// Lists what of a run is state, and so goes into a checkpoint (src/record/state_list.h). A friend of every class that
/// keeps state to itself.
struct StateAccess;

}  // namespace geocontainer_mpm
