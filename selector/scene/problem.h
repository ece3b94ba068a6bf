// A scene made ready for the runtime: mesh, laws, materials, constraints, loads, probes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/constraints.h"
#include "runtime/prescribed_motion.h"
#include "runtime/solver_choice.h"
#include "selector/io/deflection_curve.h"
#include "selector/scene/scene.h"
#include "selector/scene/scene_mesh.h"
#include "selector/scene/surface_load.h"
#include "symgen/law/law.h"

namespace elastogen::selector {

/// What one block's elements are made of.
struct BlockMaterial {
  std::string law;                 ///< key of Problem::laws
  std::vector<double> parameters;  ///< in the law's order
  double density = 0;              ///< [kg/m^3]
};

/// A force at a node [N].
struct NodalForce {
  std::size_t node = 0;
  std::array<double, 3> force{};
};

/// Nodes whose mean displacement and reaction are reported.
struct Probe {
  std::string name;
  std::vector<std::int32_t> nodes;
};

struct Problem {
  SceneMesh mesh;
  std::map<std::string, symgen::Law> laws;  ///< by name
  std::vector<BlockMaterial> materials;     ///< of each block
  Constraints constraints;
  PrescribedMotion motion;  ///< over time; in statics over the load factor
  std::vector<NodalForce> forces;
  std::vector<SurfaceLoad> surface_loads;
  std::vector<Probe> probes;
  SolverChoice solver;                       ///< what the scene says, else what suits the mesh
  std::optional<DeflectionCurve> reference;  ///< at most one of the two
  std::optional<std::vector<double>> reference_displacement;  ///< [dim * node + component], m
};

/// Makes the mesh, reads the laws and checks everything that needs them.
///
/// @param law_folders  where laws are looked for that the scene does not list in `laws`
/// @throws InputError  with file, line, what was found and what is allowed; in particular when
///                     constraints leave a rigid motion
[[nodiscard]] Problem prepare(const Scene& scene,
                              const std::vector<std::filesystem::path>& law_folders);

}  // namespace elastogen::selector
