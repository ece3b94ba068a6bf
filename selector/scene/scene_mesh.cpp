#include "selector/scene/scene_mesh.h"

#include <algorithm>

#include "selector/scene/bar_mesh.h"
#include "selector/scene/explicit_mesh.h"
#include "selector/scene/file_mesh.h"
#include "selector/scene/sphere_mesh.h"

namespace elastogen::selector {

std::int32_t region_number(Mesh& mesh, const std::string& name) {
  auto& names = mesh.region_names;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) names.push_back(name);
  return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

SceneMesh make_mesh(const Scene& scene) {
  if (scene.mesh_file) return make_file_mesh(*scene.mesh_file);
  if (scene.sphere) return make_sphere(*scene.sphere);
  return scene.bar ? make_bar(*scene.bar) : make_explicit_mesh(*scene.mesh);
}

}  // namespace elastogen::selector
