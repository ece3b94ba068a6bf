#include "selector/bench/thesis_beams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "selector/bench/beam_problems.h"
#include "selector/bench/thesis_sections.h"
#include "selector/io/displacement_field.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

struct Beam {
  std::string association;
  std::vector<int> cells;
};

/// Cells that make 3072, 6000, 10800 and 16464 elements (the thesis prints 16644 for the last).
const std::vector<Beam>& bending_beams() {
  static const std::vector<Beam> beams = [] {
    std::vector<Beam> all;
    for (const auto& cells : {std::vector{48, 8, 8}, {60, 10, 10}, {75, 12, 12}, {84, 14, 14}}) {
      all.push_back({"stvk-hexa8-q8-none", cells});
    }
    for (const auto& cells : {std::vector{24, 8, 8}, {30, 10, 10}, {54, 10, 10}, {42, 14, 14}}) {
      all.push_back({"stvk-prism6-q6-none", cells});
    }
    for (const char* association : {"stvk-pyramid5-q5-none", "stvk-tet4-q1-none"}) {
      for (const auto& cells : {std::vector{32, 4, 4}, {40, 5, 5}, {50, 6, 6}, {56, 7, 7}}) {
        all.push_back({association, cells});
      }
    }
    return all;
  }();
  return beams;
}

/// A scene's results, and how long it took, unless the folder has them.
SolvedScene solve(const ThesisBeams& beams, const std::string& name, const std::string& text) {
  const fs::path folder = beams.folder / name, scene = folder / "scene.toml";
  if (!fs::exists(scene) || !fs::exists(folder / "summary.json") ||
      read_text_file(scene, "scene") != text) {
    beams.tell("thesis: " + name);
    fs::remove(folder / "summary.json");
    write_text_file(scene, text);
    SceneProcess how = beams.process;
    how.results = folder;
    how.time_limit = 0;
    how.runs = 1;
    WorkPrecisionPoint unused;
    return run_scene(scene, how, unused);
  }
  return read_solved_scene(folder);
}

SolverChoice cg(double tolerance) { return {"cg", Precision::double_precision, tolerance}; }

/// Mean deflection of each section of nodes with the same x at rest.
ThesisCurve deflection(const SolvedScene& solved, const std::string& element) {
  std::map<long, std::pair<double, int>> sections;  // x in 1e-9 m: sum of u_z, nodes
  for (std::size_t k = 0; k < solved.positions.size(); k += 3) {
    auto& [sum, count] = sections[std::lround(1e9 * solved.positions[k])];
    sum += solved.displacements[k + 2];
    ++count;
  }
  ThesisCurve curve{element, solved.summary.at("mesh").at("elements"), {}, {}};
  for (const auto& [x, section] : sections) {
    curve.x.push_back(1e-9 * static_cast<double>(x));
    curve.uz.push_back(section.first / section.second);
  }
  return curve;
}

double at(const ThesisCurve& curve, double x) {
  const auto above = std::lower_bound(curve.x.begin() + 1, curve.x.end() - 1, x);
  const auto k = static_cast<std::size_t>(above - curve.x.begin());
  const double part = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
  return (1 - part) * curve.uz[k - 1] + part * curve.uz[k];
}

double mean_distance(const ThesisCurve& curve, const ThesisCurve& converged) {
  double sum = 0;
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    sum += std::abs(curve.uz[k] - at(converged, curve.x[k]));
  }
  return sum / static_cast<double>(curve.x.size());
}

std::vector<std::string> bending_sections(const ThesisBeams& beams) {
  const std::vector<BeamSection> fine = {{1.0, "stvk-hexa20-q27-none"}};
  const ThesisCurve converged = deflection(
      solve(beams, "bending_converged", bending_scene(fine, {32, 8, 8}, cg(1e-9))), "hexa20");
  std::vector<ThesisCurve> curves;
  std::vector<ThesisFigure> figures;
  for (const Beam& beam : bending_beams()) {
    if (beams.interrupted()) return {};
    const std::vector<BeamSection> sections = {{1.0, beam.association}};
    const std::string element = symgen::AssociationId::parse(beam.association).element;
    const SolvedScene solved =
        solve(beams, fmt::format("bending_{}_{}", element, fmt::join(beam.cells, "x")),
              bending_scene(sections, beam.cells, cg(1e-8)));
    const ThesisCurve& curve = curves.emplace_back(deflection(solved, element));
    const nlohmann::json& seconds = solved.summary.at("seconds");
    figures.push_back({element, curve.num_elements, mean_distance_to_line(curve),
                       mean_distance(curve, converged),
                       seconds.at("setup").get<double>() + seconds.at("solve").get<double>()});
  }
  return {thesis_table_6_6_html(figures, mean_distance_to_line(converged)),
          thesis_curves_html(curves, converged), thesis_figure_6_16_html(figures)};
}

std::string torsion_section(const ThesisBeams& beams) {
  const std::vector<BeamSection> fine = {{1.0, "stvk-hexa20-q8-none"}};
  const std::vector<BeamSection> hexahedra = {{1.0, "stvk-hexa8-q8-none"}};
  const std::vector<BeamSection> mixed = {{0.25, "stvk-prism6-q6-none"},
                                          {0.50, "stvk-pyramid5-q5-none"},
                                          {0.75, "stvk-hexa8-q8-none"},
                                          {1.00, "stvk-tet4-q1-none"}};
  const SolvedScene converged =
      solve(beams, "torsion_converged", torsion_scene(fine, {24, 6, 6}, cg(1e-8)));
  std::vector<TorsionFigure> figures;
  const auto add = [&](const std::string& mesh, const SolvedScene& solved) {
    const FieldDistance distance =
        field_distance(solved.displacements,
                       displacements_at(converged.folder / "result.vtu", solved.positions, 3), 3);
    figures.push_back({mesh, "hexa20 24x6x6", distance.mean, distance.maximum, distance.minimum});
  };
  add("hexa8 48x8x8",
      solve(beams, "torsion_hexa8", torsion_scene(hexahedra, {48, 8, 8}, cg(1e-8))));
  add("mixed 32x5x5", solve(beams, "torsion_mixed", torsion_scene(mixed, {32, 5, 5}, cg(1e-8))));
  return thesis_table_6_7_html(figures);
}

}  // namespace

std::vector<std::string> thesis_sections_of(const ThesisBeams& beams) {
  std::vector<std::string> sections = bending_sections(beams);
  if (sections.empty() || beams.interrupted()) return {};
  sections.insert(sections.begin(), "<h2>The beams of X. Faure's thesis (2014)</h2>\n");
  sections.push_back(torsion_section(beams));
  return sections;
}

}  // namespace elastogen::selector
