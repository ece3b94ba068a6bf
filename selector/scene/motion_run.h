// A scene's motion in time: from its plan to the state in which it ends.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "selector/scene/recorder.h"

namespace elastogen::selector {

/// A motion's steps, known before the first is made.
struct MotionPlan {
  IntegratorOptions options;            ///< complete
  std::int64_t num_steps = 0;           ///< up to the end of time
  std::optional<double> critical_step;  ///< of explicit schemes, about the body at rest [s]
};

/// Fraction of the critical step that explicit schemes take where the scene gives no step.
inline constexpr double safe_fraction = 0.9;

/// Most rows of history.csv and files of the series that are written unless the scene asks for
/// more.
inline constexpr std::int64_t usual_rows = 1000;
inline constexpr std::int64_t usual_files = 100;

/// @throws InputError  a step that is unstable for the scheme
[[nodiscard]] MotionPlan plan_motion(const Scene& scene, const Problem& problem, Model& model);

/// Which of so many steps are recorded, as the scene says or by the usual numbers.
[[nodiscard]] RecordIntervals intervals_of(const OutputSettings& output, std::int64_t num_steps);

enum class MotionStatus { at_rest, end_of_time, interrupted, failed };

struct MotionResult {
  MotionStatus status = MotionStatus::end_of_time;
  std::string reason;      ///< one sentence when failed
  std::int64_t steps = 0;  ///< complete since time 0
  double time = 0;         ///< that of the last complete step [s]
  LinearSolverKind method = LinearSolverKind::conjugate_gradient;  ///< of the last step
  std::int64_t linear_iterations = 0;  ///< of this run of the program; so are those below
  std::int64_t force_evaluations = 0;
  std::int64_t halvings = 0;
  std::int64_t steps_made = 0;
  double seconds = 0;  ///< all steps with their records [s]
};

/// What the run asks and tells while it goes on.
struct RunHooks {
  std::function<void(const std::string&)> tell;  ///< a line of progress
  std::function<bool()> interrupted;             ///< whether to stop after this step
};

/// Makes the steps up to rest or the end of time, and records them.
///
/// @param start  the checkpoint to go on from; none: from the scene's start
/// @param end    out: the last complete step
/// @throws InputError, WorkError  as make_integrator and Recorder; a step that fails is no
///                                exception but the result's status
[[nodiscard]] MotionResult run_motion(const Scene& scene, const Problem& problem, Model& model,
                                      const MotionPlan& plan, Recorder& recorder,
                                      const Checkpoint* start, const RunHooks& hooks,
                                      BodyState& end);

}  // namespace elastogen::selector
