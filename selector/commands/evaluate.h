// elastogen evaluate: one element, numbers in and out as JSON.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_evaluate_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
