// What a run tells about itself: summary.json, and the same for people.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/model.h"
#include "selector/scene/motion_run.h"
#include "selector/scene/simulation.h"

namespace elastogen::selector {

/// How one association's kernels were got.
struct KernelOrigin {
  std::string association;
  std::string scalar;  ///< "double", "float"
  bool up_to_date = false;
  double generate_seconds = 0;
  double compile_seconds = 0;
};

/// Wall times of the phases [s].
struct PhaseTimes {
  double mesh = 0;     ///< reading and checking the scene, making the mesh
  double kernels = 0;  ///< generating, compiling, loading
  double setup = 0;    ///< grouped constants, checks of rest shapes, loads
  double solve = 0;    ///< Newton, or all time steps; with the record of the steps
  double output = 0;   ///< writing results and pictures
};

/// Everything that stands in a summary.
struct RunSummary {
  const Scene* scene = nullptr;
  const Problem* problem = nullptr;
  const SceneResults* results = nullptr;
  std::optional<NewtonResult> newton;  ///< of statics
  std::optional<MotionPlan> plan;      ///< of dynamics; so is the next
  std::optional<MotionResult> motion;
  std::optional<RunPosition> resumed_from;  ///< where the checkpoint was
  std::vector<KernelOrigin> kernels;
  std::vector<GroupSummary> groups;
  std::vector<std::string> operations;  ///< that the run calls
  TangentProduct tangent = TangentProduct::recompute;
  SkippedWork skipped;
  bool reordered = false;  ///< the mesh was scattered (ModelOptions::reorder)
  int threads = 0;
  PhaseTimes times;
  std::vector<std::string> warnings;
  std::filesystem::path folder;
  std::vector<std::string> files;  ///< in `folder`
};

/// Operations that exist but were not generated, because the scene's run calls none of them.
[[nodiscard]] std::vector<std::string> skipped_operations(
    const std::vector<std::string>& generated);

/// The content of summary.json, described in docs/scene.md.
[[nodiscard]] nlohmann::ordered_json summary_json(const RunSummary& summary);

/// The same as lines for a terminal.
[[nodiscard]] std::string summary_text(const RunSummary& summary);

}  // namespace elastogen::selector
