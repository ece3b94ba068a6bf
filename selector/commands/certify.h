// elastogen certify: how wrong compiled kernels are.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_certify_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
