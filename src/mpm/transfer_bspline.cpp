#include "transfer_loops.h"

namespace geocontainer_mpm::mpm {

template struct TransferLoops<2, Shape::bspline2>;
template struct TransferLoops<3, Shape::bspline2>;

}  // namespace geocontainer_mpm::mpm
