// elastogen: the command line.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "runtime/error.h"
#include "selector/commands/bench.h"
#include "selector/commands/certify.h"
#include "selector/commands/check_law.h"
#include "selector/commands/command.h"
#include "selector/commands/evaluate.h"
#include "selector/commands/explain.h"
#include "selector/commands/generate.h"
#include "selector/commands/list.h"
#include "selector/commands/run.h"
#include "selector/support/names.h"

namespace {

using elastogen::selector::Context;

constexpr int exit_work_failed = 1;
constexpr int exit_wrong_call = 2;

constexpr const char* footer =
    R"(An association is law-element-quadrature-split, as in stvk-hexa8-q8-none.

Examples:
  elastogen run scenes/mixed_beam.toml --out out/mixed_beam   simulate, with kernels made on the fly
  elastogen list --law stvk --element hexa8                   which associations there are
  elastogen explain stvk-hexa8-q8-auto                        what one costs, and why
  elastogen generate 'stvk-*-q8-none' --out kernels           C++ sources for your own program
  elastogen check-law my_law.toml                             what a law has, proved or measured
  elastogen certify 'stvk-*-none'                             how wrong kernels can be
  elastogen bench work-precision --quick                      time against error, here
  elastogen evaluate hooke-tet4-q1-none --input case.json     one element, by numbers

Exit status: 0, 1 the work failed (no convergence, no compiler, disk full), 2 the call was wrong.
Environment: CXX (compiler), ELASTOGEN_LAWS (law folders), ELASTOGEN_CACHE_DIR (compiled kernels).)";

std::vector<CLI::App*> commands(CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

void declare(CLI::App& app, Context& context) {
  app.description("Kernels for elastic solids, generated from energies, and scenes run with them");
  app.footer(footer);
  app.set_version_flag("--version", "elastogen " ELASTOGEN_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--laws", context.user_law_folders,
                 "Folder of law files, searched first; repeatable")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_option("--profile", context.generate.profile, "Target profile that costs are weighed for")
      ->check(CLI::IsMember(elastogen::symgen::profile_names()))
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--grouping",
         [&context](const std::string& name) {
           context.generate.grouping = name == "algorithm6"
                                           ? elastogen::symgen::Grouping::algorithm6
                                           : elastogen::symgen::Grouping::minimum_cut;
         },
         "How grouped constants are chosen: by the cheapest cut, or all of them as in the "
         "thesis's algorithm 6")
      ->check(CLI::IsMember({"minimum-cut", "algorithm6"}))
      ->default_str("minimum-cut");
  app.add_option_function<std::string>(
         "--derive",
         [&context](const std::string& name) {
           context.generate.derivation = name == "ginac" ? elastogen::symgen::Derivation::ginac
                                                         : elastogen::symgen::Derivation::dag;
         },
         "Who takes the derivatives: the expression graph (forces by reverse mode, product by "
         "forward mode), or GiNaC, from the energy in nodal displacements")
      ->check(CLI::IsMember({"dag", "ginac"}))
      ->default_str("dag");
  app.add_flag_callback(
      "--no-stabilise", [&context] { context.generate.stabilise = false; },
      "Take laws as they are written: digits are lost near rest; for comparison");
  app.add_option("--threads", context.threads, "Threads; 0: all of the machine")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_flag("--no-cache", context.no_cache, "Compile kernels anew, and keep nothing");
  app.add_flag("--quiet", context.quiet, "No progress on standard error");
  elastogen::selector::add_list_command(app, context);
  elastogen::selector::add_explain_command(app, context);
  elastogen::selector::add_generate_command(app, context);
  elastogen::selector::add_check_law_command(app, context);
  elastogen::selector::add_evaluate_command(app, context);
  elastogen::selector::add_certify_command(app, context);
  elastogen::selector::add_bench_command(app, context);
  elastogen::selector::add_run_command(app, context);
  for (CLI::App* command : commands(app)) {
    command->footer(command->get_footer() +
                    "\nOptions of every command, such as --laws and --threads: elastogen --help");
  }
}

std::vector<std::string> command_names(CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands(app)) names.push_back(command->get_name());
  return names;
}

/// Words that the command line may hold: commands, or options of the command that was given.
std::string suggestion(CLI::App& app, const std::string& word) {
  if (!word.starts_with("-")) return elastogen::selector::did_you_mean(word, command_names(app));
  std::vector<std::string> known;
  const auto add_options = [&](const CLI::App& owner) {
    for (const CLI::Option* option : owner.get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
  };
  add_options(app);
  for (const CLI::App* command : app.get_subcommands()) add_options(*command);
  return elastogen::selector::did_you_mean(word, known);
}

int report_wrong_call(CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extras = app.remaining(true);
  std::string message = error.what();
  // The command that lacks one of its own, or the program, which lacks a command.
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  CLI::App& owner = chosen.empty() ? app : *chosen.front();
  const bool lacks_command =
      owner.get_require_subcommand_min() > 0 && owner.get_subcommands().empty();
  if (extras.empty() && lacks_command && error.get_name() == "RequiredError") {
    message =
        "no command; say what to do: " + elastogen::selector::join(command_names(owner), ", ");
  } else if (!extras.empty()) {
    const std::string& word = extras.front();
    const bool is_command = app.get_subcommands().empty() && !word.starts_with("-");
    const char* kind = is_command ? "command" : word.starts_with("-") ? "option" : "argument";
    const std::string nearest = is_command || word.starts_with("-") ? suggestion(app, word) : "";
    message = fmt::format("unknown {} '{}'{}", kind, word, nearest);
  }
  fmt::print(stderr, "error: {}\n(elastogen --help explains the call)\n", message);
  return exit_wrong_call;
}

int report(const char* text, int status) {
  fmt::print(stderr, "error: {}\n", text);
  return status;
}

/// Output that a full disk swallowed must not look like success.
int check_output(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  return report("standard output cannot be written", exit_work_failed);
}

/// Threads that wait for each other by spinning make a run several times slower as soon as the
/// machine has other work. OpenMP reads how to wait before main, so the program starts itself again
/// with the setting, unless the user has made one. A single thread waits for none, and saves the
/// hundredth of a second that this costs.
void let_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv);  // returns only where it fails: then threads spin, as by default
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app;
  Context context;
  declare(app, context);
  try {
    app.parse(argc, argv);
    if (context.threads != 1) let_threads_sleep(argv);
    return check_output(context.action());
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return report_wrong_call(app, error);
  } catch (const elastogen::InputError& error) {
    return report(error.what(), exit_wrong_call);
  } catch (const elastogen::InternalError& error) {
    return report(fmt::format("internal error (a bug of elastogen): {}", error.what()).c_str(),
                  exit_work_failed);
  } catch (const std::bad_alloc&) {
    return report("there is not enough memory for this", exit_work_failed);
  } catch (const std::exception& error) {
    return report(error.what(), exit_work_failed);
  }
}
