#include "selector/commands/list.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "selector/commands/associations.h"

namespace elastogen::selector {
namespace {

struct ListOptions {
  AssociationFilter filter;
  bool json = false;
};

/// Ids that differ only in their split share a line:  law  element  quadrature  splits.
void print_table(const std::vector<symgen::AssociationId>& ids) {
  std::size_t law_width = 3;
  for (const symgen::AssociationId& id : ids) law_width = std::max(law_width, id.law.size());
  fmt::print("{:<{}}  {:<9} {:<11} {}\n", "law", law_width, "element", "quadrature", "splits");
  for (std::size_t first = 0; first < ids.size();) {
    const symgen::AssociationId& id = ids[first];
    std::string splits;
    std::size_t next = first;
    while (next < ids.size() && ids[next].law == id.law && ids[next].element == id.element &&
           ids[next].quadrature == id.quadrature) {
      splits += (splits.empty() ? "" : " ") + ids[next++].split;
    }
    fmt::print("{:<{}}  {:<9} {:<11} {}\n", id.law, law_width, id.element, id.quadrature, splits);
    first = next;
  }
  fmt::print("\n{} association{}; an id reads {}\n", ids.size(), ids.size() == 1 ? "" : "s",
             ids.empty() ? "law-element-quadrature-split" : ids.front().text());
}

int run_list(const ListOptions& options, const Context& context) {
  const std::vector<symgen::AssociationId> ids =
      find_associations(options.filter, context.law_folders());
  if (!options.json) {
    print_table(ids);
    return 0;
  }
  nlohmann::json array = nlohmann::json::array();
  for (const symgen::AssociationId& id : ids) array.push_back(id.text());
  fmt::print("{}\n", array.dump(2));
  return 0;
}

}  // namespace

void add_list_command(CLI::App& app, Context& context) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* command = app.add_subcommand("list", "The associations that match");
  command->footer(
      "Options take names or globs and may be repeated.\n"
      "Examples:\n"
      "  elastogen list --element hexa8 --split none\n"
      "  elastogen list 'stvk-*-q8-*' --json");
  command->add_option("PATTERN", options->filter.patterns, "Globs of whole ids");
  command->add_option("--law", options->filter.laws, "Only these laws")->allow_extra_args(false);
  command->add_option("--element", options->filter.elements, "Only these elements")
      ->allow_extra_args(false);
  command->add_option("--quadrature", options->filter.quadratures, "Only these quadratures")
      ->allow_extra_args(false);
  command->add_option("--split", options->filter.splits, "Only these splits")
      ->allow_extra_args(false);
  command->add_flag("--json", options->json, "Print a JSON array of ids");
  command->callback([options, &context] {
    context.action = [options, &context] { return run_list(*options, context); };
  });
}

}  // namespace elastogen::selector
