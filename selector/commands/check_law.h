// elastogen check-law: what a constitutive law has, proved or measured.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_check_law_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
