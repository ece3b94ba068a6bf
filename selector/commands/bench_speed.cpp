#include "selector/commands/bench_speed.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <memory>

#include "runtime/error.h"
#include "selector/bench/speed/measure_speed.h"
#include "selector/bench/speed/speed_compare.h"
#include "selector/bench/speed/speed_files.h"
#include "selector/bench/speed/speed_report.h"
#include "selector/bench/speed/speed_table.h"
#include "selector/commands/associations.h"
#include "selector/scene/interrupt.h"
#include "selector/support/files.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

using Measure = std::function<void(const SpeedOptions&, const MachineLimits&,
                                   const std::function<void(const SpeedRecord&)>&)>;

/// What the command line says of a benchmark.
struct SpeedCommand {
  const char* benchmark = "";
  Measure measure;
  std::vector<std::string> patterns;  ///< what is measured when the user names none
  SpeedOptions options;
  std::filesystem::path out;
};

int usable_threads(const Context& context) {
  return context.threads > 0 ? context.threads : omp_get_num_procs();
}

int run_limits(const Context& context, bool json) {
  SpeedResults results;
  const int threads = usable_threads(context);
  results.run = start_bench_run(threads);
  results.limits = measure_limits(threads, [&](const std::string& line) { context.tell(line); });
  if (json) {
    fmt::print("{}", speed_json(results));
  } else {
    fmt::print("{}\n{}", results.run.processor, limits_text(results.limits));
  }
  return 0;
}

int run_speed(SpeedCommand command, const Context& context) {
  const InterruptGuard interrupt;
  SpeedOptions& options = command.options;
  options.law_folders = context.law_folders();
  options.loader = context.loader_options();
  options.tell = [&](const std::string& line) { context.tell(line); };
  options.interrupted = [&] { return interrupt.interrupted(); };
  AssociationFilter filter;
  filter.patterns = command.patterns;
  options.associations = find_associations(filter, options.law_folders);
  // A mistake in a law shall show before anything is measured.
  for (const symgen::AssociationId& id : options.associations) (void)read_law_of(id, context);
  if (options.threads.empty()) {
    options.threads = {1};
    if (usable_threads(context) > 1) options.threads.push_back(usable_threads(context));
  }

  const int most = *std::max_element(options.threads.begin(), options.threads.end());
  SpeedResults results;
  results.run = start_bench_run(most);
  SpeedDatabase database(command.out / "speed.sqlite", results.run);
  results.limits = measure_limits(most, options.tell);
  fmt::print("{}\n{}{}", results.run.processor, limits_text(results.limits),
             speed_table_head(command.benchmark));
  command.measure(options, results.limits, [&](const SpeedRecord& record) {
    database.add(record);
    results.records.push_back(record);
    fmt::print("{}", speed_table_line(record));
    std::fflush(stdout);
  });
  write_text_file(command.out / "speed.json", speed_json(results));
  write_text_file(command.out / "speed.html", speed_html(results));
  fmt::print("results: {} (.json, .sqlite, .html)\n", (command.out / "speed").string());
  return interrupt.interrupted() ? exit_interrupted : 0;
}

void add_common_options(CLI::App& sub, SpeedCommand& command) {
  sub.add_option("PATTERN", command.patterns, "Globs of whole ids")
      ->default_str(fmt::format("{}", fmt::join(command.patterns, " ")));
  sub.add_option("--seconds", command.options.seconds, "For each figure")
      ->check(CLI::Range(0.01, 60.0))
      ->capture_default_str();
  sub.add_option("--out", command.out, "Folder for speed.json, speed.sqlite and speed.html")
      ->type_name("DIR")
      ->capture_default_str();
}

void add_precision(CLI::App& sub, SpeedOptions& options) {
  sub.add_option("--precision", options.precisions, "Of the kernels: double, single")
      ->check(CLI::IsMember({"double", "single"}))
      ->default_str(fmt::format("{}", fmt::join(options.precisions, " ")));
}

void add_mesh(CLI::App& sub, SpeedOptions& options) {
  sub.add_option("--mesh", options.meshes,
                 "distorted: every element of a shape of its own; box-shaped: cut from cubes")
      ->check(CLI::IsMember({"distorted", "box-shaped"}))
      ->default_str(fmt::format("{}", fmt::join(options.meshes, " ")));
}

void add_product(CLI::App& sub, SpeedOptions& options) {
  sub.add_option("--product", options.strategies, "How tangent products are computed")
      ->check(CLI::IsMember({"recompute", "two-stage", "assembled"}))
      ->default_str(fmt::format("{}", fmt::join(options.strategies, " ")));
}

/// Of the associations that published figures are of, unless the user names others.
std::shared_ptr<SpeedCommand> new_command(const char* benchmark, Measure measure) {
  const auto command = std::make_shared<SpeedCommand>();
  command->benchmark = benchmark;
  command->measure = std::move(measure);
  command->patterns = {
      "hooke-tet4-q1-none", "stvk-tet4-q1-none",        "hooke-hexa8-q8-none",
      "stvk-hexa8-q8-none", "stvk-prism6-q6-none",      "stvk-pyramid5-q5-none",
      "stvk-tet10-q4-none", "neo_hookean-tet4-q1-none", "neo_hookean-hexa8-q8-none"};
  command->options.precisions = {"double"};
  command->out = std::filesystem::path("out") / benchmark;
  return command;
}

void add_kernels(CLI::App& bench, Context& context) {
  const auto command = new_command("kernels", measure_kernels);
  command->options.precisions = {"double", "single"};
  CLI::App* sub = bench.add_subcommand(
      "kernels", "Time per element of compiled kernels, operands in cache, against the peak");
  sub->footer(
      "Least and median of many samples of the thread's processor time, in one thread; flops are\n"
      "those of the generated code, a multiply-add being two.\n"
      "Examples:\n"
      "  elastogen bench kernels\n"
      "  elastogen bench kernels 'my_law-*-none' --laws . --precision single --out speed");
  add_common_options(*sub, *command);
  add_precision(*sub, command->options);
  sub->callback([command, &context] {
    context.action = [command, &context] {
      command->options.threads = {1};
      return run_speed(*command, context);
    };
  });
}

void add_operators(CLI::App& bench, Context& context) {
  const auto command = new_command("operators", measure_operators);
  SpeedOptions& options = command->options;
  options.meshes = {"distorted", "box-shaped"};
  options.strategies = {"recompute", "two-stage", "assembled"};
  CLI::App* sub = bench.add_subcommand(
      "operators",
      "Time per element of forces, energy and tangent products on beams: gather, kernel, addition");
  sub->footer(
      "Products stand side by side for every strategy, with the `rebuild` that two-stage and\n"
      "assembled ones need after each linearisation: n products cost rebuild + n product. The\n"
      "roofline is the greater of flops over the peak and bytes over the bandwidth that a triad "
      "of\n"
      "as many bytes reaches. Results are those of one thread and of all (--threads before the\n"
      "command).\n"
      "Examples:\n"
      "  elastogen bench operators stvk-tet4-q1-none --elements 100000\n"
      "  elastogen --threads 1 bench operators 'neo_hookean-*-none' --mesh distorted");
  add_common_options(*sub, *command);
  sub->add_option("--elements", options.elements,
                  "Sizes of the beams; default: 10^4 to 10^6 tetrahedra, 2 10^4 to 2 10^5 others")
      ->check(CLI::Range(std::size_t(1), std::size_t(200000000)));
  add_precision(*sub, options);
  add_mesh(*sub, options);
  add_product(*sub, options);
  sub->callback([command, &context] {
    context.action = [command, &context] { return run_speed(*command, context); };
  });
}

void add_scaling(CLI::App& bench, Context& context) {
  const auto command = new_command("scaling", measure_scaling);
  command->patterns = {"stvk-tet4-q1-none", "stvk-hexa8-q8-none"};
  SpeedOptions& options = command->options;
  options.meshes = {"distorted"};
  options.orders = {"natural", "random", "reordered"};
  options.strategies = {"recompute"};
  CLI::App* sub = bench.add_subcommand(
      "scaling", "Time per element by number of elements, their order in memory, and threads");
  sub->footer(
      "natural: as a bar is cut; random: nodes and elements numbered without thought, and\n"
      "passed over so; reordered: the same mesh as models take it, along a space-filling curve\n"
      "(ModelOptions::reorder). One thread and all (--threads before the command). Sizes that\n"
      "would not fit into memory are left out.\n"
      "Example:\n"
      "  elastogen bench scaling stvk-tet4-q1-none --elements 100000 1000000 --order natural");
  add_common_options(*sub, *command);
  sub->add_option("--elements", options.elements,
                  "Sizes of the beams; default: 10^3 to 10^7 tetrahedra, to 10^6 others")
      ->check(CLI::Range(std::size_t(1), std::size_t(200000000)));
  sub->add_option("--order", options.orders, "Of nodes and elements")
      ->check(CLI::IsMember({"natural", "random", "reordered"}))
      ->default_str("natural random reordered");
  add_mesh(*sub, options);
  add_product(*sub, options);
  sub->callback([command, &context] {
    context.action = [command, &context] { return run_speed(*command, context); };
  });
}

struct PeersCommand {
  PeerOptions peers;
  std::vector<std::string> names;              ///< globs
  std::vector<std::filesystem::path> folders;  ///< of the user
};

/// Peers that the user's names mean, in the user's folders and in the shipped one.
std::vector<Peer> chosen_peers(const PeersCommand& command) {
  std::vector<std::filesystem::path> folders = command.folders;
  const std::filesystem::path shipped = shared_folder() / "bench" / "peers";
  if (std::filesystem::is_directory(shipped)) folders.push_back(shipped);
  const std::vector<Peer> all = find_peers(folders);
  std::vector<Peer> chosen;
  std::vector<std::string> known;
  for (const Peer& peer : all) {
    known.push_back(peer.name);
    const bool is_named =
        std::any_of(command.names.begin(), command.names.end(),
                    [&](const std::string& name) { return matches_glob(name, peer.name); });
    if (is_named) chosen.push_back(peer);
  }
  if (chosen.empty()) {
    throw InputError(fmt::format("no peer is named '{}'; there are {}",
                                 fmt::join(command.names, "', '"),
                                 known.empty() ? "none" : join(known, ", ")));
  }
  return chosen;
}

void add_peers(CLI::App& bench, Context& context) {
  const auto also = std::make_shared<PeersCommand>();
  const auto command = new_command(
      "peers", [also](const SpeedOptions& options, const MachineLimits& limits, const auto& add) {
        measure_peers(options, also->peers, limits, add);
      });
  also->names = {"*"};
  SpeedOptions& options = command->options;
  options.meshes = {"distorted"};
  options.strategies = {"recompute", "assembled"};
  CLI::App* sub = bench.add_subcommand(
      "peers", "Operators beside those of other programs: same mesh, law, machine and minute");
  sub->footer(
      "Each peer is a folder with a program `run` (bench/peers/README.md says what it is given "
      "and\n"
      "what it says), which builds what it needs the first time. Its forces and products must be\n"
      "elastogen's to 1e-9, or it is left out. In every round elastogen is measured and then each "
      "peer;\n"
      "the ratio is its least time to elastogen's of that round: median, least and greatest. A "
      "missing\n"
      "package is said in a line. Whole static solves beside CalculiX: `bench work-precision`.\n"
      "Examples:\n"
      "  elastogen bench peers\n"
      "  elastogen bench peers stvk-tet4-q1-none --peer ffcx --rounds 5\n"
      "  elastogen bench peers 'stvk-*-none' --peers my_peers --elements 10000");
  add_common_options(*sub, *command);
  sub->add_option("--peer", also->names, "Globs of peers")->default_str("*");
  sub->add_option("--peers", also->folders, "Folders of more peers")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  sub->add_option("--rounds", also->peers.rounds, "Of elastogen and every peer")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  sub->add_option("--elements", options.elements,
                  "Size of the beam; default: 100000, of quadratic elements 20000")
      ->expected(1)
      ->check(CLI::Range(std::size_t(1), std::size_t(200000000)));
  add_mesh(*sub, options);
  add_product(*sub, options);
  sub->callback([command, also, &context] {
    context.action = [command, also, &context] {
      also->peers.peers = chosen_peers(*also);
      also->peers.with_matrix = std::any_of(also->peers.peers.begin(), also->peers.peers.end(),
                                            [](const Peer& peer) { return peer.name == "sparse"; });
      also->peers.work = command->out;
      command->options.threads = {1};
      return run_speed(*command, context);
    };
  });
}

void add_compare(CLI::App& bench, Context& context) {
  const auto files = std::make_shared<std::array<std::filesystem::path, 2>>();
  CLI::App* sub = bench.add_subcommand(
      "compare", "What changed between two results of kernels or operators, beyond their noise");
  sub->footer(
      "A record's noise is how far its median lies above its least time, at least 2 %.\n"
      "Example:\n  elastogen bench compare before/speed.json after/speed.json");
  sub->add_option("BEFORE", (*files)[0], "speed.json")->required();
  sub->add_option("AFTER", (*files)[1], "speed.json")->required();
  sub->callback([files, &context] {
    context.action = [files] {
      fmt::print("{}", compare_speed(read_speed_json((*files)[0]), read_speed_json((*files)[1])));
      return 0;
    };
  });
}

void add_report(CLI::App& bench, Context& context) {
  struct ReportCommand {
    std::vector<std::filesystem::path> files;
    std::filesystem::path out = "speed.html";
  };
  const auto command = std::make_shared<ReportCommand>();
  CLI::App* sub =
      bench.add_subcommand("report", "A page with rooflines of results of kernels and operators");
  sub->footer("Example:\n  elastogen bench report out/kernels/speed.json out/operators/speed.json");
  sub->add_option("FILE", command->files, "speed.json; machine and limits are those of the last")
      ->required();
  sub->add_option("--out", command->out, "The page")->type_name("FILE")->capture_default_str();
  sub->callback([command, &context] {
    context.action = [command] {
      SpeedResults all;
      for (const std::filesystem::path& file : command->files) {
        SpeedResults results = read_speed_json(file);
        all.run = results.run;
        all.limits = results.limits;
        all.records.insert(all.records.end(), results.records.begin(), results.records.end());
      }
      write_text_file(command->out, speed_html(all));
      fmt::print("page: {}\n", command->out.string());
      return 0;
    };
  });
}

}  // namespace

void add_speed_benchmarks(CLI::App& bench, Context& context) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* limits = bench.add_subcommand(
      "limits", "What this machine can do at most: multiply-adds, and bandwidth by size");
  limits->footer("The loops are compiled as kernels are, with the same compiler and flags.");
  limits->add_flag("--json", *json, "Print JSON");
  limits->callback([json, &context] {
    context.action = [json, &context] { return run_limits(context, *json); };
  });
  add_kernels(bench, context);
  add_operators(bench, context);
  add_scaling(bench, context);
  add_peers(bench, context);
  add_compare(bench, context);
  add_report(bench, context);
}

}  // namespace elastogen::selector
