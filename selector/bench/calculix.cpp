#include "selector/bench/calculix.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>

#include "runtime/error.h"
#include "selector/support/files.h"
#include "selector/support/process.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

/// The last lines of an output, where programs say why they stop.
std::string tail(const std::string& output) {
  constexpr std::size_t most = 1500;
  std::size_t first = output.size() > most ? output.size() - most : 0;
  if (first > 0) first = output.find('\n', first) + 1;
  return output.substr(first);
}

/// Calls `use` for every line of a text, without its end.
template <class Use>
void for_each_line(std::string_view text, Use&& use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    use(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

std::string_view skip_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text;
}

/// Reads a number of Fortran's form E13.6 and moves behind it. An exponent of three digits has no
/// letter: 1.000000-104.
bool read_number(std::string_view& text, double& number) {
  text = skip_blanks(text);
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range)
    number = 0;
  else if (error != std::errc())
    return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    number = text.front() == '-' ? 0 : std::numeric_limits<double>::infinity();
    text.remove_prefix(std::min(text.find(' '), text.size()));
  }
  return true;
}

/// Displacements of the last block of the .dat file.
std::vector<double> read_displacement(const fs::path& file, std::size_t num_nodes) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> displacement(3 * num_nodes, missing);
  for_each_line(read_text_file(file, "CalculiX's result"), [&](std::string_view line) {
    line = skip_blanks(line);
    std::size_t node = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), node);
    if (error != std::errc() || node < 1 || node > num_nodes) return;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    for (std::size_t i = 0; i < 3; ++i) {
      double& u = displacement[3 * (node - 1) + i];
      if (!read_number(line, u)) u = missing;
    }
  });
  for (const double u : displacement) {
    if (!std::isfinite(u)) {
      throw WorkError(
          fmt::format("{}: CalculiX has no displacement for every node", file.string()));
    }
  }
  return displacement;
}

/// Iterations and the solver's name, from lines such as " iteration 3" and
/// " Factoring the system of equations using the symmetric spooles solver" or
/// "Solving the system of equations using the iterative solver".
void read_output(const std::string& output, CalculixResult& result) {
  for_each_line(output, [&](std::string_view line) {
    line = skip_blanks(line);
    if (line.starts_with("iteration ") &&
        line.find_first_not_of("0123456789 ", 10) == std::string_view::npos) {
      ++result.iterations;
    }
    const std::string_view before = "system of equations using the ", symmetric = "symmetric ";
    const std::size_t found = line.find(before);
    if (found != std::string_view::npos) {
      line.remove_prefix(found + before.size());
      if (line.starts_with(symmetric)) line.remove_prefix(symmetric.size());
      result.solver = line.substr(0, line.find(" solver"));
    }
  });
}

void check_success(const ProcessResult& process, const CalculixProblem& problem,
                   const fs::path& deck) {
  if (process.timed_out) {
    throw TookTooLong(fmt::format("{}: CalculiX was stopped after {:g} s; its output ends with\n{}",
                                  deck.string(), problem.time_limit, tail(process.output)));
  }
  if (process.signal != 0) {
    throw WorkError(fmt::format("{}: CalculiX was ended by signal {}; its output ends with\n{}",
                                deck.string(), process.signal, tail(process.output)));
  }
  if (process.exit_status != 0 || process.output.find("Job finished") == std::string::npos) {
    throw WorkError(fmt::format("{}: CalculiX failed with status {}; its output ends with\n{}",
                                deck.string(), process.exit_status, tail(process.output)));
  }
}

}  // namespace

bool have_calculix() { return find_program("ccx").has_value(); }

std::string calculix_version() {
  // "This is Version 2.20", and exit status 1
  const std::string output = run_process({"ccx", "-v"}).output;
  const std::string_view before = "Version ";
  const std::size_t found = output.find(before);
  if (found == std::string::npos) {
    throw WorkError("ccx -v does not tell CalculiX's version: " + tail(output));
  }
  const std::size_t first = found + before.size();
  return "CalculiX " + output.substr(first, output.find_first_of(" \r\n", first) - first);
}

CalculixResult run_calculix(const CalculixProblem& problem, const fs::path& folder,
                            const std::string& name) {
  const auto file = [&](std::string_view extension) {
    return folder / (name + std::string(extension));
  };
  if (!have_calculix()) {
    throw WorkError("CalculiX's program ccx is not in PATH; Debian has it as calculix-ccx");
  }
  write_text_file(file(".inp"), calculix_deck(problem));
  std::error_code ignored;
  fs::remove(file(".dat"), ignored);  // of an earlier run, which must not pass for this one's

  ProcessOptions options;
  options.folder = folder;
  options.time_limit = problem.time_limit;
  const std::string threads = fmt::format("{}", problem.threads);
  for (const char* variable : {"OMP_NUM_THREADS", "NUMBER_OF_CPUS", "CCX_NPROC_STIFFNESS",
                               "CCX_NPROC_RESULTS", "CCX_NPROC_EQUATION_SOLVER"}) {
    options.environment.emplace_back(variable, threads);
  }
  const ProcessResult process = run_process({"ccx", "-i", name}, options);
  check_success(process, problem, file(".inp"));

  CalculixResult result;
  result.wall_seconds = process.wall_seconds;
  result.cpu_seconds = process.cpu_seconds;
  read_output(process.output, result);
  if (result.iterations == 0) result.iterations = 1;
  result.displacement = read_displacement(file(".dat"), problem.mesh->num_nodes());
  for (const char* extension : {".dat", ".frd", ".cvg", ".sta", ".12d"}) {
    fs::remove(file(extension), ignored);
  }
  fs::remove(folder / "spooles.out", ignored);
  return result;
}

}  // namespace elastogen::selector
