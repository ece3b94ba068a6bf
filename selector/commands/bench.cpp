#include "selector/commands/bench.h"

#include <fmt/format.h>

#include <memory>

#include "runtime/error.h"
#include "selector/bench/work_precision.h"
#include "selector/commands/bench_speed.h"
#include "selector/scene/interrupt.h"

namespace elastogen::selector {
namespace {

int run_bench(WorkPrecisionOptions options, const Context& context) {
  const InterruptGuard interrupt;
  options.law_folders = context.law_folders();
  options.threads = context.threads > 0 ? context.threads : 1;
  options.tell = [&](const std::string& line) { context.tell(line); };
  options.interrupted = [&] { return interrupt.interrupted(); };
  const WorkPrecisionOutcome outcome = run_work_precision(options);
  for (const std::string& sentence : outcome.sentences) fmt::print("{}\n", sentence);
  fmt::print("{} points measured, {} known from before, {} without a figure; page: {}\n",
             outcome.measured, outcome.kept, outcome.failed, outcome.page.string());
  if (outcome.status == WorkPrecisionStatus::complete) return 0;
  fmt::print(stderr, "error: interrupted; the same call goes on from here\n");
  return exit_interrupted;
}

}  // namespace

void add_bench_command(CLI::App& app, Context& context) {
  CLI::App* bench = app.add_subcommand("bench", "How fast, and how accurate, on this machine");
  bench->require_subcommand(1);
  add_speed_benchmarks(*bench, context);

  const auto options = std::make_shared<WorkPrecisionOptions>();
  options->out = "out/work_precision";
  const auto without_calculix = std::make_shared<bool>(false);
  const auto without_thesis = std::make_shared<bool>(false);
  CLI::App* sub = bench->add_subcommand(
      "work-precision",
      "Time against error: elements, laws, quadratures, resolutions and solvers on problems whose "
      "solution is known");
  sub->footer(
      "Runs a beam in bending, a beam in torsion, a thick sphere under pressure at small and at\n"
      "large strain, and a bar that starts to hang, each point as a process of its own, and "
      "CalculiX\n"
      "on the same meshes where it is installed. Writes a page with charts (work_precision.html),\n"
      "tables (work_precision.csv, .sqlite) and the scenes of all points into --out. Points that "
      "the\n"
      "folder has are not measured again: what was interrupted goes on.\n"
      "All of it takes an hour or two; --quick a few minutes.\n"
      "Examples:\n"
      "  elastogen bench work-precision --quick\n"
      "  elastogen bench work-precision --problem bending --element 'hexa*' --law stvk\n"
      "  elastogen bench work-precision --problem sphere_large --law my_law --laws .");
  sub->add_option("--problem", options->problems,
                  "bending, torsion, sphere, sphere_large, bar_dynamics; default: all");
  sub->add_option("--law", options->selection.laws,
                  "Laws, in the place of each problem's own; they must follow from young and "
                  "poisson");
  sub->add_option("--element", options->selection.elements,
                  "Globs of elements with their quadrature, as in 'hexa*-q8'; default: all");
  sub->add_flag("--quick", options->selection.quick,
                "Two coarse meshes of each element, one solver, without the thesis's beams");
  sub->add_option("--runs", options->runs,
                  "Of each point, for the median; a single one where it takes over two seconds")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  sub->add_option("--time-limit", options->time_limit,
                  "Seconds for one run; finer meshes of what took longer are left out")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub->add_flag("--no-calculix", *without_calculix, "Without CalculiX, even where it is installed");
  sub->add_flag("--no-thesis", *without_thesis,
                "Without the beams of tables 6.6 and 6.7 of X. Faure's thesis");
  sub->add_option("--out", options->out, "Folder for the results")
      ->type_name("DIR")
      ->capture_default_str();
  sub->callback([=, &context] {
    options->calculix = !*without_calculix;
    options->thesis = !*without_thesis && !options->selection.quick;
    context.action = [options, &context] { return run_bench(*options, context); };
  });
}

}  // namespace elastogen::selector
