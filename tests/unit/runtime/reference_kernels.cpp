#include "tests/unit/runtime/reference_kernels.h"

namespace elastogen::test {

template struct ReferenceKernels<Hexa8, 4, false>;
template struct ReferenceKernels<Hexa8, 8, false>;
template struct ReferenceKernels<Hexa8, 8, true>;
template struct ReferenceKernels<Tet4, 1, false>;
template struct ReferenceKernels<Tet4, 4, false>;
template struct ReferenceKernels<Tet4, 8, false>;
template struct ReferenceKernels<Tet4, 8, true>;

}  // namespace elastogen::test
