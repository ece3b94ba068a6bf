#include "selector/commands/generate.h"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "selector/commands/associations.h"
#include "selector/commands/kernel_folder.h"

namespace elastogen::selector {
namespace {

struct GenerateCommandOptions {
  AssociationFilter filter;
  std::string folder = "kernels";
  std::string target = "cpp";
};

/// Each law of the associations, read once.
std::map<std::string, symgen::Law> read_laws(const std::vector<symgen::AssociationId>& ids,
                                             const Context& context) {
  std::map<std::string, symgen::Law> laws;
  for (const symgen::AssociationId& id : ids) {
    if (!laws.contains(id.law)) laws.emplace(id.law, read_law_of(id, context));
  }
  return laws;
}

int run_generate(const GenerateCommandOptions& options, const Context& context) {
  // Everything that can be wrong in the call is found before the first file is written.
  const std::vector<symgen::AssociationId> ids =
      find_associations(options.filter, context.law_folders());
  const std::map<std::string, symgen::Law> laws = read_laws(ids, context);
  KernelFolder folder(options.folder);

  const symgen::GenerateOptions& generate = context.generate;
  std::size_t num_generated = 0;
  for (const symgen::AssociationId& id : ids) {
    const symgen::Law& law = laws.at(id.law);
    if (folder.is_up_to_date(id, symgen::association_hash(id, law, generate))) {
      fmt::print("up to date  {}\n", id.text());
      continue;
    }
    const symgen::GeneratedAssociation generated = symgen::generate_association(id, law, generate);
    const std::size_t bytes =
        folder.write(generated, {options.target, generate.profile}, source_files(generated, law));
    fmt::print("generated   {}  {:.2f} s, {} bytes\n", id.text(), generated.seconds, bytes);
    std::fflush(stdout);
    ++num_generated;
  }
  fmt::print("{} of {} generated in {}\n", num_generated, ids.size(), options.folder);
  return 0;
}

}  // namespace

void add_generate_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<GenerateCommandOptions>();
  CLI::App* command =
      app.add_subcommand("generate", "C++ sources of kernels, and what was up to date");
  command->footer(
      "Writes for each association its kernel templates, tables for packs of doubles and floats,\n"
      "and manifest.json. Sources need the headers runtime/kernel_abi.h and "
      "runtime/kernel_support.h.\n"
      "Unchanged kernels are left alone, others in the folder stay. In CMake: "
      "elastogen_add_kernels.\n"
      "Examples:\n"
      "  elastogen generate stvk-hexa8-q8-none hooke-tet4-q1-none --out kernels\n"
      "  elastogen generate 'stvk-*-q8-*' --profile x86-cache --out kernels");
  command->add_option("PATTERN", options->filter.patterns, "Ids or globs of associations")
      ->required();
  command->add_option("--out", options->folder, "Folder of the sources")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--target", options->target, "Language of the sources")
      ->check(CLI::IsMember({"cpp"}))
      ->capture_default_str();
  command->callback([options, &context] {
    context.action = [options, &context] { return run_generate(*options, context); };
  });
}

}  // namespace elastogen::selector
