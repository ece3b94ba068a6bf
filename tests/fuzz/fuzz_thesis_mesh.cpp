// The thesis's mesh triples: any bytes, divided at lines "----", give a mesh or an InputError,
// never a crash.
#include <string>
#include <string_view>

#include "input_file.h"
#include "runtime/error.h"
#include "selector/io/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view divider = "----\n";
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  std::filesystem::path obj;
  for (const char* name : {"mesh.obj", "mesh.element", "mesh.info"}) {
    const std::size_t end = std::min(rest.find(divider), rest.size());
    const std::filesystem::path file =
        elastogen::fuzz::input_file(name, reinterpret_cast<const std::uint8_t*>(rest.data()), end);
    if (obj.empty()) obj = file;
    rest.remove_prefix(std::min(rest.size(), end + divider.size()));
  }
  try {
    (void)elastogen::selector::read_mesh_file(obj);
  } catch (const elastogen::InputError&) {
    // what a wrong file must end in
  }
  return 0;
}
