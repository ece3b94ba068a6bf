// Kernel tables of hooke-hexa8-q8-none; link hooke_hexa8_q8_none_f64.cpp and hooke_hexa8_q8_none_f32.cpp.
#pragma once

#include "runtime/kernel_abi.h"

extern "C" {
const elastogen::KernelTable<double>* elastogen_kernels_hooke_hexa8_q8_none_f64_simd();
const elastogen::KernelTable<float>* elastogen_kernels_hooke_hexa8_q8_none_f32_simd();
}
