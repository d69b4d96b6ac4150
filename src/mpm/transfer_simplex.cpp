#include "transfer_loops.h"

namespace geocontainer_mpm::mpm {

template struct TransferLoops<2, Shape::linear_simplex>;
template struct TransferLoops<3, Shape::linear_simplex>;

}  // namespace geocontainer_mpm::mpm
