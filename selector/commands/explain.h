// elastogen explain: what one association costs, and why.
#pragma once

#include "selector/commands/command.h"

namespace elastogen::selector {

void add_explain_command(CLI::App& app, Context& context);

}  // namespace elastogen::selector
