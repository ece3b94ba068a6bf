// Kernel tables of hooke-tet4-q1-none; link hooke_tet4_q1_none_f64.cpp and hooke_tet4_q1_none_f32.cpp.
#pragma once

#include "runtime/kernel_abi.h"

extern "C" {
const elastogen::KernelTable<double>* elastogen_kernels_hooke_tet4_q1_none_f64_simd();
const elastogen::KernelTable<float>* elastogen_kernels_hooke_tet4_q1_none_f32_simd();
}
