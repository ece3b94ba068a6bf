// What a run's solver has to warn of.
#pragma once

#include <string>
#include <vector>

#include "selector/scene/summary.h"

namespace elastogen::selector {

/// An equilibrium that is unstable or known to rounding only, and a method that got nowhere.
[[nodiscard]] std::vector<std::string> solver_warnings(const RunSummary& summary);

}  // namespace elastogen::selector
