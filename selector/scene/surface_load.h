// A pressure or a traction on a part of the surface, ready to be applied and reported.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "runtime/surface_loads.h"
#include "selector/scene/scene.h"
#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {

struct SurfaceLoad {
  std::string description;  ///< "pressure 10000 Pa on boundary 'inside'"
  std::vector<SurfaceFace> faces;
  std::optional<double> pressure;                 ///< [Pa]; else
  std::optional<std::array<double, 3>> traction;  ///< [Pa]
  double area = 0;                                ///< of the rest surface [m^2]
  std::array<double, 3> resultant{};              ///< [N]
};

/// The surface load that a load with a pressure or a traction is.
/// @throws InputError  as select_faces
[[nodiscard]] SurfaceLoad make_surface_load(const SceneMesh& mesh, const LoadDescription& load);

/// f += the load's nodal forces [N], [dim * node + component].
void add_surface_load(const Mesh& mesh, const SurfaceLoad& load, VectorRef f);

}  // namespace elastogen::selector
