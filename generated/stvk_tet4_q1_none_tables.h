// Kernel tables of stvk-tet4-q1-none; link stvk_tet4_q1_none_f64.cpp and stvk_tet4_q1_none_f32.cpp.
#pragma once

#include "runtime/kernel_abi.h"

extern "C" {
const elastogen::KernelTable<double>* elastogen_kernels_stvk_tet4_q1_none_f64_simd();
const elastogen::KernelTable<float>* elastogen_kernels_stvk_tet4_q1_none_f32_simd();
}
