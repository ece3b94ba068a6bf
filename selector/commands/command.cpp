#include "selector/commands/command.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "runtime/error.h"
#include "symgen/quadrature/quadrature.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

void add_named_folder(std::vector<fs::path>& folders, const fs::path& folder,
                      const std::string& named_by) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError(
        fmt::format("{} '{}' is not a folder; it must be one that holds law files "
                    "(NAME.toml)",
                    named_by, folder.string()));
  }
  folders.push_back(folder);
}

}  // namespace

fs::path shared_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "elastogen";
}

std::vector<fs::path> Context::law_folders() const {
  std::vector<fs::path> folders;
  for (const fs::path& folder : user_law_folders) add_named_folder(folders, folder, "--laws");
  if (const char* variable = std::getenv("ELASTOGEN_LAWS")) {
    std::istringstream list(variable);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) add_named_folder(folders, folder, "ELASTOGEN_LAWS folder");
    }
  }
  const fs::path shipped = shared_folder() / "laws";
  std::error_code error;
  if (fs::is_directory(shipped, error)) folders.push_back(shipped);
  return folders;
}

LoaderOptions Context::loader_options() const {
  LoaderOptions options;
  options.generate = generate;
  options.use_cache = !no_cache;
  options.threads = threads;
  options.progress = [this](const std::string& line) { tell(line); };
  return options;
}

void Context::tell(const std::string& line) const {
  if (!quiet) fmt::print(stderr, "{}\n", line);
}

symgen::Law read_law_of(const symgen::AssociationId& id, const Context& context) {
  symgen::Law law = symgen::read_law(symgen::find_law_file(id.law, context.law_folders()));
  symgen::check_association(id, law);
  return law;
}

}  // namespace elastogen::selector
