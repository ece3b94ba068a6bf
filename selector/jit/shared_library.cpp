#include "selector/jit/shared_library.h"

#include <dlfcn.h>

namespace elastogen::selector {

SharedLibrary::SharedLibrary(const std::filesystem::path& file) {
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw BadLibrary(dlerror());
  handle_ = std::shared_ptr<void>(handle, [](void* h) { dlclose(h); });
}

void* SharedLibrary::symbol(const std::string& name) const {
  void* const found = dlsym(handle_.get(), name.c_str());
  if (found == nullptr) throw BadLibrary("it does not export '" + name + "'");
  return found;
}

}  // namespace elastogen::selector
