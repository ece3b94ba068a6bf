// What stands for the tangent, and how its product is computed.
#pragma once

#include <string_view>

namespace elastogen {

/// How the product (df/dU) V is computed; all agree to rounding.
enum class TangentProduct {
  recompute,  ///< from the displacement, by the kernel `product`
  two_stage,  ///< `linearize` stores state once, `apply` uses it in every product
  assembled,  ///< `stiffness` is assembled once, every product is one with the sparse matrix
  /// recompute or two_stage, whichever costs less by the kernels' operations and what must be read
  /// (cheaper_product.h). Never assembled, which pays only after dozens of products and in cache.
  automatic,
};

/// "recompute", "two-stage", "assembled", "auto"
[[nodiscard]] std::string_view tangent_product_name(TangentProduct product);

/// What stands for the tangent about a linearisation point.
enum class TangentForm {
  exact,
  /// The assembled stiffness with each element's matrix projected to a positive semi-definite one
  /// (project_semidefinite.h): a direction of Newton's method that descends. Products are those of
  /// the matrix, whatever TangentProduct says.
  semidefinite,
};

}  // namespace elastogen
