// Law files: any bytes give a law or an InputError, never a crash.
#include "input_file.h"
#include "runtime/error.h"
#include "symgen/law/law.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)elastogen::symgen::read_law(elastogen::fuzz::input_file("stvk.toml", data, size));
  } catch (const elastogen::InputError&) {
    // what a wrong file must end in
  }
  return 0;
}
