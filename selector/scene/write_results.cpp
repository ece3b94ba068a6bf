#include "selector/scene/write_results.h"

#include <algorithm>
#include <optional>
#include <string>

#include "runtime/error.h"
#include "selector/io/curve_picture.h"
#include "selector/io/deformed_picture.h"
#include "selector/io/gnuplot.h"
#include "selector/io/history_picture.h"

namespace elastogen::selector {
namespace {

/// Curves that vary less than this part of those that vary most are left out of pictures.
constexpr double visible_range = 1e-2;
constexpr std::size_t most_curves = 8;

/// Writes a picture; one that cannot be drawn costs a warning, not the results.
template <class Draw>
void try_picture(const std::string& name, RunSummary& summary, const Draw& draw) {
  try {
    draw(summary.folder / name);
    summary.files.push_back(name);
  } catch (const WorkError& error) {
    summary.warnings.push_back(error.what());
  }
}

/// The columns of all probes for one quantity ('u', 'r', 'm') that vary enough to be seen.
std::vector<std::size_t> visible_columns(const std::vector<std::string>& names,
                                         const std::vector<double>& ranges, std::size_t first,
                                         char quantity) {
  std::vector<std::size_t> columns;
  double largest = 0;
  for (std::size_t c = first; c < names.size() && c < ranges.size(); ++c) {
    if (names[c][names[c].size() - 2] != quantity) continue;
    columns.push_back(c);
    largest = std::max(largest, ranges[c]);
  }
  std::erase_if(columns, [&](std::size_t c) { return !(ranges[c] > visible_range * largest); });
  if (columns.size() > most_curves) columns.resize(most_curves);
  return columns;
}

void draw_history_of(const std::filesystem::path& file, const RunSummary& summary,
                     const Recorder& recorder) {
  const Scene& scene = *summary.scene;
  const std::vector<std::string>& names = recorder.columns();
  const std::vector<double> ranges = column_ranges(recorder.history_file());
  const std::size_t first_probe = (scene.dynamics ? 3 : 2) + (scene.output.energy ? 1 : 0);
  std::vector<HistoryPanel> panels = {
      {"mean displacement [m]", visible_columns(names, ranges, first_probe, 'u'), false},
      {"reaction [N]", visible_columns(names, ranges, first_probe, 'r'), false},
      {"moment of reactions [N m]", visible_columns(names, ranges, first_probe, 'm'), false}};
  if (scene.dynamics) panels.push_back({"kinetic energy [J]", {2}, true});
  std::erase_if(panels, [](const HistoryPanel& panel) { return panel.columns.empty(); });
  if (panels.empty()) return;
  draw_history(file, recorder.history_file(), names, 1, scene.dynamics ? "t [s]" : "load factor",
               panels, scene.title);
}

void write_pictures(RunSummary& summary, const Recorder& recorder) {
  if (!have_gnuplot()) {
    summary.warnings.push_back(
        "gnuplot is not installed, so there are no pictures (package gnuplot-nox)");
    return;
  }
  const Scene& scene = *summary.scene;
  const SceneResults& results = *summary.results;
  try_picture("deformed.png", summary, [&](const std::filesystem::path& file) {
    draw_deformed(file, summary.problem->mesh.mesh, values_of(results.state.displacement),
                  scene.title);
  });
  if (scene.output.history) {
    try_picture("history.png", summary, [&](const std::filesystem::path& file) {
      draw_history_of(file, summary, recorder);
    });
  }
  if (!results.curve) return;
  std::optional<NamedCurve> reference;
  if (summary.problem->reference) {
    reference = NamedCurve{scene.reference->label, *summary.problem->reference};
  }
  try_picture("deflection.png", summary, [&](const std::filesystem::path& file) {
    draw_curve(file, *results.curve, reference, scene.title);
  });
}

}  // namespace

void write_results(RunSummary& summary, const Recorder& recorder) {
  const OutputSettings& output = summary.scene->output;
  const SceneResults& results = *summary.results;
  if (output.vtu) {
    write_state(summary.folder / "result.vtu", summary.problem->mesh, results.state,
                results.energy_density);
    summary.files.push_back("result.vtu");
  }
  for (const std::string& file : recorder.files()) summary.files.push_back(file);
  if (output.curve && results.curve) {
    write_curve_csv(summary.folder / "deflection.csv", *results.curve,
                    summary.scene->title + ": mean displacement of each section [m]");
    summary.files.push_back("deflection.csv");
  }
  if (output.picture) write_pictures(summary, recorder);
  summary.files.push_back("summary.json");
}

}  // namespace elastogen::selector
