#include "selector/scene/surface_load.h"

#include <fmt/format.h>

#include <span>

#include "selector/scene/select_faces.h"

namespace elastogen::selector {

SurfaceLoad make_surface_load(const SceneMesh& mesh, const LoadDescription& load) {
  SurfaceLoad result;
  result.faces = select_faces(mesh, load.nodes);
  result.pressure = load.pressure;
  result.traction = load.traction;
  result.description =
      load.pressure
          ? fmt::format("pressure {:.6g} Pa on {}", *load.pressure, load.nodes.description)
          : fmt::format("traction [{:.6g}] Pa on {}", fmt::join(*load.traction, ", "),
                        load.nodes.description);
  result.area = surface_area(mesh.mesh, result.faces);
  Vector forces = Vector::Zero(static_cast<Eigen::Index>(mesh.mesh.positions.size()));
  add_surface_load(mesh.mesh, result, forces);
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    result.resultant[static_cast<std::size_t>(i % mesh.mesh.dim)] += forces[i];
  }
  return result;
}

void add_surface_load(const Mesh& mesh, const SurfaceLoad& load, VectorRef f) {
  if (load.pressure) {
    add_pressure(mesh, load.faces, *load.pressure, f);
  } else {
    const std::span<const double> traction = *load.traction;
    add_traction(mesh, load.faces, traction.first(static_cast<std::size_t>(mesh.dim)), f);
  }
}

}  // namespace elastogen::selector
