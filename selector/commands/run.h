// elastogen run: simulates a scene with kernels made on the fly.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

/// `run SCENE [--out DIR] [--cells NXxNYxNZ] [--json]`. Exit status: 0 converged, 1 not converged
/// (what was computed is written), 130 ended by Ctrl-C at the next iteration (likewise).
void add_run_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
