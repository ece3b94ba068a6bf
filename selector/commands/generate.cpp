#include "selector/commands/generate.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>

#include "selector/commands/associations.h"
#include "selector/commands/kernel_folder.h"

namespace elastogen::selector {
namespace {

struct GenerateCommandOptions {
  AssociationFilter filter;
  std::string folder = "kernels";
  std::vector<std::string> targets{"cpu"};
};

/// The profile of a target, unless --profile names one for all.
const std::map<std::string, std::string> default_profiles = {{"cpu", "x86-cache"},
                                                             {"opencl", "gpu"}};

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (const auto& [target, profile] : default_profiles) names.push_back(target);
  return names;
}

/// Each law of the associations, read once.
std::map<std::string, symgen::Law> read_laws(const std::vector<symgen::AssociationId>& ids,
                                             const Context& context) {
  std::map<std::string, symgen::Law> laws;
  for (const symgen::AssociationId& id : ids) {
    if (!laws.contains(id.law)) laws.emplace(id.law, read_law_of(id, context));
  }
  return laws;
}

int run_generate(const GenerateCommandOptions& options, bool profile_is_given,
                 const Context& context) {
  // Everything that can be wrong in the call is found before the first file is written.
  const std::vector<symgen::AssociationId> ids =
      find_associations(options.filter, context.law_folders());
  const std::map<std::string, symgen::Law> laws = read_laws(ids, context);
  const std::set<std::string> targets(options.targets.begin(), options.targets.end());
  KernelFolder folder(options.folder);

  std::size_t num_generated = 0;
  for (const symgen::AssociationId& id : ids) {
    const symgen::Law& law = laws.at(id.law);
    std::map<std::string, symgen::GeneratedAssociation> by_profile;  // targets may share it
    for (const std::string& target : targets) {
      symgen::GenerateOptions generate = context.generate;
      if (!profile_is_given) generate.profile = default_profiles.at(target);
      if (!by_profile.contains(generate.profile)) {
        by_profile.emplace(generate.profile, symgen::generate_association(id, law, generate));
      }
      const symgen::GeneratedAssociation& generated = by_profile.at(generate.profile);
      const bool is_new =
          folder.write(generated, {target, generate.profile},
                       target == "cpu" ? cpu_files(generated, law) : opencl_files(generated));
      fmt::print("{}  {}  {}  {:.2f} s\n", is_new ? "generated " : "up to date", id.text(), target,
                 generated.seconds);
      std::fflush(stdout);
      if (is_new) ++num_generated;
    }
  }
  fmt::print("{} of {} new or changed in {}\n", num_generated, ids.size() * targets.size(),
             options.folder);
  return 0;
}

}  // namespace

void add_generate_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<GenerateCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "generate", "C++ and OpenCL C sources of kernels, and what was up to date");
  command->footer(
      "Writes for each association and target, and lists in manifest.json:\n"
      "  cpu     kernel templates, and tables for packs of doubles and floats; they need the "
      "headers\n"
      "          runtime/kernel_*.h; profile x86-cache\n"
      "  opencl  a program ID.cl for float, or double with -D ELASTOGEN_DOUBLE; it includes\n"
      "          opencl/prelude.cl; profile gpu\n"
      "--profile names another profile, for every target.\n"
      "Unchanged kernels are left alone, others in the folder stay. In CMake: "
      "elastogen_add_kernels.\n"
      "Examples:\n"
      "  elastogen generate stvk-hexa8-q8-none hooke-tet4-q1-none --out kernels\n"
      "  elastogen generate 'stvk-*-q8-*' --profile x86-dram --out kernels\n"
      "  elastogen generate stvk-hexa8-q8-none --target cpu,opencl --out kernels");
  command->add_option("PATTERN", options->filter.patterns, "Ids or globs of associations")
      ->required();
  command->add_option("--out", options->folder, "Folder of the sources")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--target", options->targets, "Languages of the sources: cpu, opencl")
      ->delimiter(',')
      ->check(CLI::IsMember(target_names()))
      ->capture_default_str();
  const CLI::Option* profile = app.get_option("--profile");
  command->callback([options, profile, &context] {
    context.action = [options, profile, &context] {
      return run_generate(*options, profile->count() > 0, context);
    };
  });
}

}  // namespace elastogen::selector
