#include "selector/scene/write_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
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

/// The columns of all probes for one quantity that vary enough to be seen.
std::vector<std::size_t> visible_columns(const std::vector<HistoryColumn>& columns,
                                         const std::vector<double>& ranges,
                                         const std::string& quantity) {
  std::vector<std::size_t> visible;
  double largest = 0;
  for (std::size_t c = 0; c < columns.size() && c < ranges.size(); ++c) {
    if (columns[c].quantity != quantity) continue;
    visible.push_back(c);
    largest = std::max(largest, ranges[c]);
  }
  std::erase_if(visible, [&](std::size_t c) { return !(ranges[c] > visible_range * largest); });
  if (visible.size() > most_curves) visible.resize(most_curves);
  return visible;
}

/// The quantity of the columns that show what the picture does.
std::string column_quantity(const PictureField& picture) {
  const FieldShape shape = field_shapes(*picture.field).front();
  if (shape.components.empty()) return shape.name;
  return shape.name + "." + shape.components[static_cast<std::size_t>(picture.component)];
}

void draw_history_of(const std::filesystem::path& file, const RunSummary& summary,
                     const Recorder& recorder) {
  const Scene& scene = *summary.scene;
  const std::vector<HistoryColumn>& columns = recorder.columns();
  const std::vector<double> ranges = column_ranges(recorder.history_file());
  std::vector<HistoryPanel> panels = {
      {"mean displacement [m]", visible_columns(columns, ranges, "u"), false},
      {"reaction [N]", visible_columns(columns, ranges, "r"), false},
      {"moment of reactions [N m]", visible_columns(columns, ranges, "m"), false}};
  if (const auto& picture = summary.results->picture) {
    const std::string quantity = column_quantity(*scene.output.fields.picture);
    panels.push_back({picture->unit.empty() ? picture->title
                                            : fmt::format("{} [{}]", picture->title, picture->unit),
                      visible_columns(columns, ranges, quantity), false});
  }
  if (scene.dynamics) panels.push_back({"kinetic energy [J]", {2}, true});
  std::erase_if(panels, [](const HistoryPanel& panel) { return panel.columns.empty(); });
  if (panels.empty()) return;
  std::vector<std::string> names;
  for (const HistoryColumn& column : columns) names.push_back(column.name);
  draw_history(file, recorder.history_file(), names, 1, scene.dynamics ? "t [s]" : "load factor",
               panels, scene.title);
}

void write_pictures(RunSummary& summary, const Recorder& recorder) {
  if (!have_gnuplot()) {
    summary.warnings.emplace_back(
        "gnuplot is not installed, so there are no pictures (package gnuplot-nox)");
    return;
  }
  const Scene& scene = *summary.scene;
  const SceneResults& results = *summary.results;
  const Mesh& mesh = summary.problem->mesh.mesh;
  const std::span<const double> displacement = values_of(results.state.displacement);
  try_picture("deformed.png", summary, [&](const std::filesystem::path& file) {
    draw_deformed(file, mesh, displacement, displacement_colours(mesh, displacement), scene.title);
  });
  if (results.picture) {
    try_picture(stress_picture, summary, [&](const std::filesystem::path& file) {
      draw_deformed(file, mesh, displacement,
                    {results.picture->title, results.picture->unit, results.picture->values},
                    scene.title);
    });
  }
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

void write_results(RunSummary& summary, const Recorder& recorder, FieldEvaluator& fields) {
  const OutputSettings& output = summary.scene->output;
  const SceneResults& results = *summary.results;
  if (output.vtu) {
    write_state(summary.folder / "result.vtu", summary.problem->mesh, results.state, output.fields,
                results.fields);
    summary.files.push_back("result.vtu");
    if (!results.fields.points.empty()) {
      write_points(summary.folder / points_file, results.state, fields, results.fields);
      summary.files.emplace_back(points_file);
    }
  }
  for (const std::string& file : recorder.files()) summary.files.push_back(file);
  if (output.curve && results.curve) {
    write_curve_csv(summary.folder / "deflection.csv", *results.curve,
                    summary.scene->title + ": mean displacement of each section [m]");
    summary.files.push_back("deflection.csv");
  }
  if (!results.trouble.empty()) {
    summary.warnings.push_back(fmt::format("stress: {}", results.trouble));
  }
  if (output.picture) write_pictures(summary, recorder);
  summary.files.push_back("summary.json");
}

}  // namespace elastogen::selector
