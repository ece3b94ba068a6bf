#include "selector/io/projection.h"

#include <cmath>

namespace elastogen::selector {

Projection Projection::from_angles(double azimuth, double elevation) {
  const double sa = std::sin(azimuth), ca = std::cos(azimuth);
  const double se = std::sin(elevation), ce = std::cos(elevation);
  return {{ca, sa, 0}, {-sa * se, ca * se, ce}, {sa * ce, -ca * ce, se}};
}

}  // namespace elastogen::selector
