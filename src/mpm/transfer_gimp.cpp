#include "transfer_loops.h"

namespace geocontainer_mpm::mpm {

template struct TransferLoops<2, Shape::gimp>;
template struct TransferLoops<3, Shape::gimp>;

}  // namespace geocontainer_mpm::mpm
