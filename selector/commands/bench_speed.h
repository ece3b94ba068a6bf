// elastogen bench limits, kernels, operators, compare, report
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_speed_benchmarks(CLI::App& bench, Context& context);

}  // namespace elastogen::selector
