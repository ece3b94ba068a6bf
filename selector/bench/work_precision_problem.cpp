#include "selector/bench/work_precision_problem.h"

#include "selector/bench/bar_motion_problem.h"
#include "selector/bench/beam_problems.h"
#include "selector/bench/sphere_problem.h"

namespace elastogen::selector {

std::vector<std::unique_ptr<WorkPrecisionProblem>> work_precision_problems(
    const std::vector<std::filesystem::path>& law_folders) {
  std::vector<std::unique_ptr<WorkPrecisionProblem>> problems;
  problems.push_back(make_bending_problem());
  problems.push_back(make_torsion_problem());
  problems.push_back(make_sphere_problem(false, law_folders));
  problems.push_back(make_sphere_problem(true, law_folders));
  problems.push_back(make_bar_motion_problem());
  return problems;
}

}  // namespace elastogen::selector
