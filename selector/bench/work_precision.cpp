#include "selector/bench/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "runtime/error.h"
#include "selector/bench/calculix_scene.h"
#include "selector/bench/pareto.h"
#include "selector/bench/results_database.h"
#include "selector/bench/scene_process.h"
#include "selector/bench/thesis_beams.h"
#include "selector/bench/work_precision_report.h"
#include "selector/support/files.h"
#include "selector/support/names.h"
#include "selector/support/process.h"
#include "symgen/emit/content_hash.h"
#include "symgen/law/moduli.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

constexpr double calculix_tolerance = 1e-6;  // largest residual over the mean force

std::string file_name(const std::string& problem, const WorkPrecisionChoice& choice) {
  return fmt::format("{}_{}_{}_{}_{}_{:g}", problem, choice.association.text(), choice.resolution(),
                     choice.solver.method, precision_name(choice.solver.precision),
                     choice.solver.tolerance);
}

WorkPrecisionPoint start_point(const std::string& problem, const WorkPrecisionChoice& choice) {
  WorkPrecisionPoint point;
  point.problem = problem;
  point.program = "elastogen";
  point.association = choice.association.text();
  point.law = choice.association.law;
  point.element = choice.association.element;
  point.quadrature = choice.association.quadrature;
  point.resolution = choice.resolution();
  point.solver = choice.solver.method;
  point.precision = precision_name(choice.solver.precision);
  point.tolerance = choice.solver.tolerance;
  return point;
}

bool is_wanted(const WorkPrecisionProblem& problem, const WorkPrecisionOptions& options) {
  const auto& names = options.problems;
  return names.empty() ||
         std::find(names.begin(), names.end(), problem.text().problem) != names.end();
}

void check_options(const WorkPrecisionOptions& options,
                   const std::vector<std::unique_ptr<WorkPrecisionProblem>>& problems) {
  std::vector<std::string> names;
  for (const auto& problem : problems) names.push_back(problem->text().problem);
  for (const std::string& name : options.problems) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw InputError(fmt::format("there is no problem '{}'{}; there are: {}", name,
                                 did_you_mean(name, names), join(names, ", ")));
  }
  for (const std::string& name : options.selection.laws) {
    const symgen::Law law = symgen::read_law(symgen::find_law_file(name, options.law_folders));
    if (symgen::follows_from_young_poisson(law)) continue;
    throw InputError(fmt::format(
        "--law {}: the problems give young and poisson, which this law does not follow from",
        name));
  }
  const bool none = std::all_of(problems.begin(), problems.end(), [&](const auto& problem) {
    return problem->choices(options.selection).empty();
  });
  if (none) {
    throw InputError(
        fmt::format("--element {}: matches no element with its quadrature, as hexa8-q8 or tet10-q4",
                    join(options.selection.elements, ", ")));
  }
}

/// Fills in what `measure` finds, or why it finds nothing.
/// @return false when it took too long
template <class Measure>
bool try_measure(WorkPrecisionPoint& point, const Measure& measure) {
  try {
    const Measurement measurement = measure();
    point.value = measurement.value;
    point.error = measurement.error;
  } catch (const TookTooLong& error) {
    point.failure = error.what();
    return false;
  } catch (const WorkError& error) {
    point.failure = error.what();
  }
  return true;
}

class Benchmark {
 public:
  Benchmark(const WorkPrecisionOptions& options,
            const std::vector<std::unique_ptr<WorkPrecisionProblem>>& problems)
      : options_(options),
        problems_(problems),
        database_(options.out / "work_precision.sqlite"),
        run_(start_bench_run(options.threads)) {
    database_.begin_run(run_);
  }

  WorkPrecisionOutcome run();

 private:
  using Choices = std::vector<WorkPrecisionChoice>;
  /// What runs of growing meshes have in common.
  using Series = std::tuple<std::string, std::string, std::string, double>;

  void run_problem(const WorkPrecisionProblem& problem);
  void run_elastogen(const WorkPrecisionProblem& problem, const Choices& choices);
  void run_calculix(const WorkPrecisionProblem& problem, const Choices& choices);
  void measure(const WorkPrecisionProblem& problem, const WorkPrecisionChoice& choice,
               std::set<Series>& too_slow);
  void measure_calculix(const WorkPrecisionProblem& problem, const WorkPrecisionChoice& choice,
                        const std::string& element_type, std::set<Series>& too_slow);
  const SolvedScene* reference_of(const WorkPrecisionProblem& problem, const std::string& law);
  bool has_point(const WorkPrecisionPoint& point, const std::string& hash);
  void keep(const WorkPrecisionPoint& point, const std::string& hash);
  void report();

  [[nodiscard]] fs::path write_scene(const std::string& name, const std::string& text) const {
    const fs::path file = options_.out / "scenes" / (name + ".toml");
    write_text_file(file, text);
    return file;
  }
  /// Of a scene or deck, and all else that the figures depend on.
  [[nodiscard]] std::string hash_of(const std::string& text, const std::string& law) const {
    const std::string law_text =
        read_text_file(symgen::find_law_file(law, options_.law_folders), "law");
    const std::string threads = std::to_string(options_.threads);
    return symgen::content_hash(
        {text, law_text, run_.version, run_.processor, run_.compiler, threads});
  }
  [[nodiscard]] SceneProcess process(const fs::path& results) const {
    return {results, options_.threads,    options_.runs, options_.time_limit,
            false,   options_.law_folders};
  }

  const WorkPrecisionOptions& options_;
  const std::vector<std::unique_ptr<WorkPrecisionProblem>>& problems_;
  ResultsDatabase database_;
  BenchRun run_;
  WorkPrecisionOutcome outcome_;
  std::map<std::pair<std::string, std::string>, SolvedScene> references_;  // by problem and law
  std::set<Series> with_kernels_;
  std::vector<std::string> thesis_;   // sections of the page
  std::size_t done_ = 0, total_ = 0;  // points of a problem
};

WorkPrecisionOutcome Benchmark::run() {
  if (options_.calculix && !have_calculix()) {
    options_.tell("CalculiX is not installed (Debian: calculix-ccx): without its points");
  }
  for (const auto& problem : problems_) {
    if (!is_wanted(*problem, options_) || options_.interrupted()) continue;
    try {
      run_problem(*problem);
    } catch (const WorkError&) {
      // Of a reference: without it there is no error to measure. Ctrl-C ends it, too.
      if (!options_.interrupted()) throw;
    }
    report();
  }
  if (options_.interrupted()) outcome_.status = WorkPrecisionStatus::interrupted;
  return outcome_;
}

void Benchmark::run_problem(const WorkPrecisionProblem& problem) {
  const Choices choices = problem.choices(options_.selection);
  if (choices.empty()) return;
  done_ = 0;
  total_ = choices.size();
  run_elastogen(problem, choices);
  if (options_.calculix && have_calculix() && problem.measures_displacements()) {
    run_calculix(problem, choices);
  }
  if (options_.thesis && problem.text().problem == "bending" && !options_.interrupted()) {
    thesis_ = thesis_sections_of(
        {options_.out / "thesis", process({}), options_.tell, options_.interrupted});
  }
}

void Benchmark::run_elastogen(const WorkPrecisionProblem& problem, const Choices& choices) {
  std::set<Series> too_slow;
  for (const WorkPrecisionChoice& choice : choices) {
    if (options_.interrupted()) return;
    ++done_;
    measure(problem, choice, too_slow);
  }
}

const SolvedScene* Benchmark::reference_of(const WorkPrecisionProblem& problem,
                                           const std::string& law) {
  const std::string& name = problem.text().problem;
  const std::optional<WorkPrecisionChoice> choice = problem.reference(law);
  if (!choice) return nullptr;
  const auto known = references_.find({name, law});
  if (known != references_.end()) return &known->second;

  const fs::path folder = options_.out / "references" / (name + "_" + law);
  const std::string text = problem.scene(*choice);
  const fs::path scene = folder / "scene.toml";
  const bool solved = fs::exists(scene) && fs::exists(folder / "summary.json") &&
                      read_text_file(scene, "scene") == text;
  if (!solved) {
    options_.tell(fmt::format("{}: the reference of {}: {} {}", name, law,
                              choice->association.text(), choice->resolution()));
    fs::remove(folder / "summary.json");
    write_text_file(scene, text);
    SceneProcess how = process(folder);
    how.time_limit = 0;
    how.runs = 1;
    how.threads = 0;
    WorkPrecisionPoint unused;
    (void)run_scene(scene, how, unused);
  }
  return &references_.emplace(std::pair(name, law), read_solved_scene(folder)).first->second;
}

bool Benchmark::has_point(const WorkPrecisionPoint& point, const std::string& hash) {
  if (!database_.find({point.problem, point.program, point.association, point.resolution,
                       point.solver, point.precision, point.tolerance, hash})) {
    return false;
  }
  ++outcome_.kept;
  return true;
}

void Benchmark::keep(const WorkPrecisionPoint& point, const std::string& hash) {
  database_.insert(point, hash);
  ++outcome_.measured;
  outcome_.failed += point.succeeded() ? 0 : 1;
  const std::string what =
      fmt::format("{} {}/{}  {} {} {} {:g}", point.problem, done_, total_, point.association,
                  point.resolution, point.solver_text(), point.tolerance);
  options_.tell(point.succeeded()
                    ? fmt::format("{}: error {:.3g} %, {:.3g} s ({:.3g} s solve)", what,
                                  100 * point.error, point.process_seconds, point.solve_seconds)
                    : fmt::format("{}: {}", what, point.failure));
}

void Benchmark::measure(const WorkPrecisionProblem& problem, const WorkPrecisionChoice& choice,
                        std::set<Series>& too_slow) {
  const std::string& name = problem.text().problem;
  WorkPrecisionPoint point = start_point(name, choice);
  const Series series{point.association, point.solver, point.precision, point.tolerance};
  const std::string text = problem.scene(choice), hash = hash_of(text, point.law);
  if (too_slow.contains(series) || has_point(point, hash)) return;

  const SolvedScene* reference = reference_of(problem, point.law);
  const fs::path scene = write_scene(file_name(name, choice), text);
  point.scene = fs::relative(scene, options_.out).string();
  if (!try_measure(point, [&] {
        SceneProcess how = process(options_.out / "last_run");
        // The first and coarsest mesh of a series.
        how.makes_kernels = with_kernels_.insert(series).second;
        return problem.measure(choice, run_scene(scene, how, point), reference);
      })) {
    too_slow.insert(series);
  }
  // Ctrl-C ends the process that is measured, too: that is no figure.
  if (!options_.interrupted()) keep(point, hash);
}

void Benchmark::run_calculix(const WorkPrecisionProblem& problem, const Choices& choices) {
  std::set<Series> too_slow;
  std::set<std::string> seen;  // solver, tolerance and quadrature are ours, not CalculiX's
  for (const WorkPrecisionChoice& choice : choices) {
    const auto& [law, element] = std::tie(choice.association.law, choice.association.element);
    if (!calculix_has_law(law)) continue;
    for (const std::string& type : calculix_elements(element)) {
      if (options_.interrupted()) return;
      if (!seen.insert(fmt::format("{} {} {}", law, type, choice.resolution())).second) continue;
      measure_calculix(problem, choice, type, too_slow);
    }
  }
}

void Benchmark::measure_calculix(const WorkPrecisionProblem& problem,
                                 const WorkPrecisionChoice& choice, const std::string& element_type,
                                 std::set<Series>& too_slow) {
  const std::string& name = problem.text().problem;
  WorkPrecisionPoint point = start_point(name, choice);
  point.program = "calculix";
  point.association = choice.association.law + " " + element_type;
  point.element = element_type;
  point.quadrature.clear();
  point.solver = "spooles";
  point.precision = "double";
  point.tolerance = calculix_tolerance;
  const Series series{point.association, point.solver, point.precision, point.tolerance};
  if (too_slow.contains(series)) return;

  const fs::path scene_file = write_scene(file_name(name, choice), problem.scene(choice));
  const Scene scene = read_scene(scene_file);
  const Problem prepared = prepare(scene, options_.law_folders);
  const TomlTable& material = scene.materials.front().table;
  CalculixProblem deck =
      calculix_problem(scene, prepared, element_type, material.number("young", positive_number),
                       material.number("poisson", any_number));
  deck.tolerance = calculix_tolerance;
  deck.threads = options_.threads;
  deck.time_limit = options_.time_limit;
  const std::string hash = hash_of(calculix_deck(deck), choice.association.law);
  if (has_point(point, hash)) return;

  const SolvedScene* reference = reference_of(problem, choice.association.law);
  const std::string deck_name = fmt::format("{}_{}_{}", name, element_type, point.resolution);
  point.scene = (fs::path("decks") / (deck_name + ".inp")).string();
  point.num_elements = prepared.mesh.mesh.num_elements();
  point.num_dofs = prepared.constraints.num_dofs();
  if (!try_measure(point, [&] {
        std::vector<std::pair<double, double>> times;  // wall, CPU
        SolvedScene solved;
        do {
          CalculixResult result =
              elastogen::selector::run_calculix(deck, options_.out / "decks", deck_name);
          times.emplace_back(result.wall_seconds, result.cpu_seconds);
          point.solver = result.solver;
          solved.displacements = std::move(result.displacement);
        } while (static_cast<int>(times.size()) < options_.runs &&
                 times.back().first <= long_run_seconds);
        std::sort(times.begin(), times.end());
        point.runs = static_cast<int>(times.size());
        std::tie(point.process_seconds, point.cpu_seconds) = times[times.size() / 2];
        point.process_seconds_min = times.front().first;
        solved.positions = prepared.mesh.mesh.positions;
        return problem.measure(choice, solved, reference);
      })) {
    too_slow.insert(series);
  }
  if (!options_.interrupted()) keep(point, hash);
}

void Benchmark::report() {
  const std::vector<WorkPrecisionPoint> points = database_.points_like(run_);
  write_points_csv(options_.out / "work_precision.csv", points);
  std::vector<ProblemText> texts;
  outcome_.sentences.clear();
  for (const auto& problem : problems_) {
    texts.push_back(problem->text());
    std::vector<WorkPrecisionPoint> own;
    std::copy_if(points.begin(), points.end(), std::back_inserter(own),
                 [&](const auto& point) { return point.problem == problem->text().problem; });
    for (const std::string& sentence : work_precision_sentences(own)) {
      outcome_.sentences.push_back(problem->text().title + ": " + sentence);
    }
  }
  outcome_.page = options_.out / "work_precision.html";
  write_text_file(outcome_.page, work_precision_html(points, texts, run_, thesis_));
}

}  // namespace

WorkPrecisionOutcome run_work_precision(const WorkPrecisionOptions& options) {
  const auto problems = work_precision_problems(options.law_folders);
  check_options(options, problems);
  return Benchmark(options, problems).run();
}

}  // namespace elastogen::selector
