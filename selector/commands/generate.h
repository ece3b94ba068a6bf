// elastogen generate: kernel sources and their manifest.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_generate_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
