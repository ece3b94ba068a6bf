// Scene files: any bytes give a scene or an InputError, never a crash.
#include "input_file.h"
#include "runtime/error.h"
#include "selector/scene/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)elastogen::selector::read_scene(elastogen::fuzz::input_file("scene.toml", data, size));
  } catch (const elastogen::InputError&) {
    // what a wrong file must end in
  }
  return 0;
}
