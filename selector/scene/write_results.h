// What a run leaves in its folder when it ends.
#pragma once

#include "selector/scene/recorder.h"
#include "selector/scene/summary.h"

namespace elastogen::selector {

/// Writes what the scene asks for, each file whole as soon as it is there, and adds their names to
/// the summary; summary.json itself is left to the caller. A picture that cannot be drawn costs a
/// warning in the summary.
/// @throws WorkError  when a file cannot be written
void write_results(RunSummary& summary, const Recorder& recorder, FieldEvaluator& fields);

}  // namespace elastogen::selector
