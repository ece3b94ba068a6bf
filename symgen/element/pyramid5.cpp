#include "symgen/element/shapes.h"

namespace elastogen::symgen {

Element make_pyramid5() {
  Element element;
  element.name = "pyramid5";
  element.shape = ReferenceShape::pyramid;
  element.coordinates = reference_coordinates();
  const GiNaC::ex xi = element.coordinates[0];
  const GiNaC::ex eta = element.coordinates[1];
  const GiNaC::ex mu = element.coordinates[2];
  element.nodes = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  // The four lateral faces are where these vanish; a base node lies on two of them, its function
  // is the product of the other two.
  const GiNaC::ex face_pp = xi + eta + mu - 1;
  const GiNaC::ex face_np = -xi + eta + mu - 1;
  const GiNaC::ex face_nn = -xi - eta + mu - 1;
  const GiNaC::ex face_pn = xi - eta + mu - 1;
  const GiNaC::ex scale = 4 * (1 - mu);
  element.shape_functions = {face_np * face_nn / scale, face_nn * face_pn / scale,
                             face_pp * face_pn / scale, face_pp * face_np / scale, mu};
  return element;
}

}  // namespace elastogen::symgen
