#include <cstdio>

#include "hooke_tet4_q1_none_tables.h"
#include "stvk_tet4_q1_none_tables.h"

int main() {
  std::printf("%s %d\n", elastogen_kernels_hooke_tet4_q1_none_f64_simd()->association,
              elastogen_kernels_hooke_tet4_q1_none_f64_simd()->lanes);
  std::printf("%s %d\n", elastogen_kernels_stvk_tet4_q1_none_f32_simd()->association,
              elastogen_kernels_stvk_tet4_q1_none_f32_simd()->lanes);
}
