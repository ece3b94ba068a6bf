// Inputs of `evaluate`: any bytes give a case or an InputError, never a crash.
#include <string>

#include "input_file.h"
#include "runtime/error.h"
#include "selector/commands/evaluation_case.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const elastogen::symgen::Law law =
      elastogen::symgen::read_law(ELASTOGEN_SOURCE_DIR "/laws/neo_hookean.toml");
  static const elastogen::symgen::Element& element = elastogen::symgen::find_element("tet4");
  try {
    const auto input = elastogen::selector::read_evaluation_case(
        std::string(reinterpret_cast<const char*>(data), size), "case.json", law, element);
    elastogen::selector::check_rest_shape(input, "case.json", element,
                                          elastogen::symgen::find_quadrature("tet4", "q1"));
  } catch (const elastogen::InputError&) {
    // what a wrong input must end in
  }
  return 0;
}
