// The Cholesky factorisation that suits a body's size.
#pragma once

#include <memory>

#include "runtime/cholesky_factor.h"

namespace elastogen::selector {

/// Eigen's column by column, where that takes less than 50 million multiplications; above, the
/// supernodal one of libexec/elastogen/elastogen-supernodal.so, which is loaded then.
/// `analyze` throws WorkError when that cannot be loaded.
[[nodiscard]] std::unique_ptr<CholeskyFactor> make_best_cholesky();

}  // namespace elastogen::selector
