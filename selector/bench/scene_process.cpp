#include "selector/bench/scene_process.h"

#include <fmt/format.h>

#include <algorithm>

#include "selector/io/displacement_field.h"
#include "selector/support/files.h"
#include "selector/support/process.h"

namespace elastogen::selector {
namespace {

/// The last line of a program's output that says something.
std::string last_line(const std::string& output) {
  const std::size_t end = output.find_last_not_of("\n ");
  if (end == std::string::npos) return "";
  const std::size_t begin = output.find_last_of('\n', end);
  return output.substr(begin + 1, end - begin);
}

ProcessResult run_once(const std::filesystem::path& scene, const SceneProcess& how,
                       double time_limit) {
  std::vector<std::string> command = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                      "--quiet", "--threads", std::to_string(how.threads)};
  for (const std::filesystem::path& folder : how.law_folders) {
    command.insert(command.end(), {"--laws", folder.string()});
  }
  command.insert(command.end(), {"run", scene.string(), "--out", how.results.string()});
  ProcessOptions options;
  options.time_limit = time_limit;
  ProcessResult result = run_process(command, options);
  if (result.timed_out) {
    throw TookTooLong(fmt::format("took longer than {:g} s", time_limit));
  }
  if (result.signal != 0 || result.exit_status != 0) {
    throw WorkError(result.signal != 0 ? fmt::format("ended by signal {}", result.signal)
                                       : last_line(result.output));
  }
  return result;
}

nlohmann::json read_summary(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_text_file(folder / "summary.json", "summary"));
}

struct TimedRun {
  ProcessResult process;
  nlohmann::json summary;
};

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void fill_in(const std::vector<TimedRun>& runs, WorkPrecisionPoint& point) {
  std::vector<double> wall, cpu;
  for (const TimedRun& run : runs) {
    wall.push_back(run.process.wall_seconds);
    cpu.push_back(run.process.cpu_seconds);
  }
  point.runs = static_cast<int>(runs.size());
  point.process_seconds = middle(wall);
  point.process_seconds_min = *std::min_element(wall.begin(), wall.end());
  point.cpu_seconds = middle(cpu);
  const auto median = std::find(wall.begin(), wall.end(), point.process_seconds);
  const nlohmann::json& summary = runs[static_cast<std::size_t>(median - wall.begin())].summary;
  point.num_elements = summary.at("mesh").at("elements");
  point.num_dofs = 3 * summary.at("mesh").at("nodes").get<std::size_t>();
  const nlohmann::json& seconds = summary.at("seconds");
  point.mesh = seconds.at("mesh");
  point.kernels = seconds.at("kernels");
  point.setup = seconds.at("setup");
  point.output = seconds.at("output");
  point.linearization = seconds.value("solve_tangents", 0.0);
  point.linear_solve = seconds.value("solve_linear_systems", 0.0);
  point.forces = seconds.value("solve_forces", 0.0);
  point.solve_seconds = point.setup + seconds.at("solve").get<double>();
}

}  // namespace

SolvedScene run_scene(const std::filesystem::path& scene, const SceneProcess& how,
                      WorkPrecisionPoint& point) {
  if (how.makes_kernels) (void)run_once(scene, how, 0);
  std::vector<TimedRun> runs;
  while (true) {
    TimedRun run = {run_once(scene, how, how.time_limit), read_summary(how.results)};
    const bool is_long = run.process.wall_seconds > long_run_seconds;
    runs.push_back(std::move(run));
    if (is_long || static_cast<int>(runs.size()) >= how.runs) break;
  }
  fill_in(runs, point);
  return read_solved_scene(how.results);
}

SolvedScene read_solved_scene(const std::filesystem::path& folder) {
  SolvedScene solved{read_summary(folder), folder, {}, {}};
  const auto& files = solved.summary.at("files");
  if (std::find(files.begin(), files.end(), "result.vtu") != files.end()) {
    ResultField field = read_result_field(folder / "result.vtu");
    solved.positions = std::move(field.positions);
    solved.displacements = std::move(field.displacements);
  }
  return solved;
}

}  // namespace elastogen::selector
