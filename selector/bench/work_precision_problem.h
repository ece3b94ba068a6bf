// The problems of the benchmark of time against error: what is solved, and how wrong a result is.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/model.h"
#include "selector/bench/work_precision_report.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// How a scene is solved.
struct SolverChoice {
  std::string method;  ///< "cholesky", "cg", "cholesky_cg"; of motions the scheme
  Precision precision = Precision::double_precision;
  double tolerance = 0;  ///< Newton's relative residual; of motions a part of the step, below
};

/// What one point is computed with.
struct WorkPrecisionChoice {
  symgen::AssociationId association;
  std::vector<int> cells;  ///< as the problem's mesh has them: of a bar three, of a sphere two
  SolverChoice solver;

  [[nodiscard]] std::string resolution() const;  ///< "48x8x8"
};

/// A solved scene.
struct SolvedScene {
  nlohmann::json summary;             ///< of elastogen; null of another program
  std::filesystem::path folder;       ///< of elastogen's results
  std::vector<double> positions;      ///< of nodes at rest, [3 * node + component], m
  std::vector<double> displacements;  ///< likewise; both empty where no result.vtu was written
};

struct Measurement {
  double value = 0;  ///< the problem's quantity, SI
  double error = 0;  ///< of it, or of the whole field, relative to the reference
};

/// Which points of a problem are wanted.
struct WorkPrecisionSelection {
  std::vector<std::string> laws;      ///< empty: the problem's own
  std::vector<std::string> elements;  ///< globs of "hexa8-q8"; empty: all
  bool quick = false;                 ///< coarse meshes and one solver
};

class WorkPrecisionProblem {
 public:
  virtual ~WorkPrecisionProblem() = default;

  [[nodiscard]] virtual const ProblemText& text() const = 0;
  /// From coarse to fine for each association, solver and tolerance.
  [[nodiscard]] virtual std::vector<WorkPrecisionChoice> choices(
      const WorkPrecisionSelection& selection) const = 0;
  /// The scene file of a choice.
  [[nodiscard]] virtual std::string scene(const WorkPrecisionChoice& choice) const = 0;
  /// The over-resolved choice whose result is the reference of a law; none: the reference is exact.
  [[nodiscard]] virtual std::optional<WorkPrecisionChoice> reference(
      const std::string& law) const = 0;
  /// @param reference  solved from `reference`, or null
  /// @throws WorkError  a result that does not have what is measured
  [[nodiscard]] virtual Measurement measure(const WorkPrecisionChoice& choice,
                                            const SolvedScene& solved,
                                            const SolvedScene* reference) const = 0;
  /// Whether `measure` needs nothing but positions and displacements, so that another program's
  /// results can be measured, too.
  [[nodiscard]] virtual bool measures_displacements() const = 0;
};

/// bending, torsion, sphere, sphere_large, bar_dynamics.
/// @param law_folders  where laws are looked for
[[nodiscard]] std::vector<std::unique_ptr<WorkPrecisionProblem>> work_precision_problems(
    const std::vector<std::filesystem::path>& law_folders);

}  // namespace elastogen::selector
