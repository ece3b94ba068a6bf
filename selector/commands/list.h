// elastogen list: the associations that exist.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_list_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
