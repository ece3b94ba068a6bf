#include "selector/bench/thesis_tables.h"

#include <limits>

namespace elastogen::selector {

double ThesisDistances::of(std::string_view element) const {
  if (element == "hexa8") return hexahedra;
  if (element == "prism6") return prisms;
  if (element == "pyramid5") return pyramids;
  if (element == "tet4") return tetrahedra;
  return std::numeric_limits<double>::quiet_NaN();
}

const std::array<ThesisDistances, 5>& thesis_table_6_6() {
  static const std::array<ThesisDistances, 5> rows = {{
      {"MMT", 3072, 0.0007906, 0.0012905, 0.0053035, 0.0446796},
      {"MMT", 6000, 0.0006380, 0.0012286, 0.0043081, 0.0323418},
      {"MMT", 10800, 0.0005798, 0.0011668, 0.0033639, 0.0202163},
      {"MMT", 16644, 0.0004615, 0.0010429, 0.0032380, 0.0105572},
      {"Abaqus", 16644, 0.0005081, 0.0010618, std::numeric_limits<double>::quiet_NaN(), 0.0159292},
  }};
  return rows;
}

const std::array<ThesisTorsion, 3>& thesis_table_6_7() {
  static const std::array<ThesisTorsion, 3> rows = {{
      {"corotational finite elements, tetrahedra", 0.0271394, 0.0619858, 0.0006462},
      {"MMT, hexahedra", 0.0369966, 0.0788980, 0.0014110},
      {"MMT, mixed elements", 0.0403100, 0.0724200, 0.0015811},
  }};
  return rows;
}

double thesis_deflection(double x) {
  constexpr double density = 1000, gravity = 9.81, young = 100e6, length = 8, height = 1;
  return -density * gravity / (2 * young * height * height) * x * x *
         (6 * length * length - 4 * length * x + x * x);
}

}  // namespace elastogen::selector
