// One element as JSON: what `evaluate` reads.
#pragma once

#include <string>

#include "symgen/element/element.h"
#include "symgen/law/law.h"
#include "symgen/pipeline.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {

/// Reads and checks
///   {"rest_positions": [[x, y, z], ...], "parameters": {...}, "displacement": [[...]],
///    "direction": [[...]]}
/// in metres, a row for each node; `direction` may be absent. Parameters have the law's own names,
/// or are `young` [Pa] and `poisson` where all parameters follow from them.
///
/// @param source  what the text is called in messages ("case.json")
/// @throws InputError  no JSON, unknown or missing key, wrong sizes, parameters outside their range
[[nodiscard]] symgen::ElementCase read_evaluation_case(const std::string& text,
                                                       const std::string& source,
                                                       const symgen::Law& law,
                                                       const symgen::Element& element);

/// @throws InputError  when the Jacobian determinant is not above rounding at every point of the
///                     rule (the element is inverted or degenerate)
void check_rest_shape(const symgen::ElementCase& input, const std::string& source,
                      const symgen::Element& element, const symgen::Quadrature& quadrature);

/// @throws InputError  unless the rest shape is of a geometry variant, "box" or "affine", in the
///                     element's node order
void check_rest_shape_is(const std::string& geometry, const symgen::ElementCase& input,
                         const std::string& source, const symgen::Element& element);

}  // namespace elastogen::selector
