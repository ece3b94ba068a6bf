// elastogen bench: how fast, how accurate, on this machine.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_bench_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
