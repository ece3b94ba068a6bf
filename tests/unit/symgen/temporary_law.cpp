#include "temporary_law.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "runtime/error.h"

namespace elastogen::symgen {

TemporaryFolder::TemporaryFolder() {
  std::string name = testing::TempDir() + "elastogen_law_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw WorkError("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name,
                                             const std::string& text) const {
  const std::filesystem::path file = path_ / name;
  std::ofstream(file) << text;
  return file;
}

Law law_from_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_law(folder.write(name + ".toml", text));
}

Law law_with_term(const std::string& energy) {
  return law_from_text("own", R"(name = "own"
[[parameter]]
name = "lambda"
unit = "Pa"
[[parameter]]
name = "mu"
unit = "Pa"
[[term]]
name = "all"
energy = ")" + energy + "\"\n");
}

std::string error_of_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write(name + ".toml", text);
  try {
    (void)read_law(file);
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string place = folder.path().string() + "/";
    const std::size_t begin = message.find(place);
    return begin == std::string::npos ? message : message.erase(begin, place.size());
  }
  ADD_FAILURE() << "the law was accepted:\n" << text;
  return "";
}

Law shipped_law(const std::string& name) {
  return read_law(std::filesystem::path(ELASTOGEN_SOURCE_DIR) / "laws" / (name + ".toml"));
}

}  // namespace elastogen::symgen
