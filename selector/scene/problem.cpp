#include "selector/scene/problem.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/error.h"
#include "selector/io/coincident_nodes.h"
#include "selector/io/displacement_field.h"
#include "selector/scene/located_error.h"
#include "selector/scene/materials.h"
#include "selector/scene/rigid_motions.h"
#include "selector/scene/select_nodes.h"

namespace elastogen::selector {
namespace {

/// The laws of all associations. A law that the scene lists itself hides one of the same name in
/// the folders.
std::map<std::string, symgen::Law> read_laws(
    const Scene& scene, const std::vector<SceneMesh::Block>& blocks,
    const std::vector<std::filesystem::path>& law_folders) {
  std::map<std::string, symgen::Law> own, used;
  for (const std::filesystem::path& file : scene.law_files) {
    symgen::Law law = symgen::read_law(file);
    own.insert_or_assign(law.name, std::move(law));
  }
  for (const SceneMesh::Block& block : blocks) {
    const std::string& name = block.association.law;
    if (used.contains(name)) continue;
    const auto listed = own.find(name);
    used.emplace(name,
                 listed != own.end()
                     ? listed->second
                     : with_location(block.association_where, block.path + ".association", [&] {
                         return symgen::read_law(symgen::find_law_file(name, law_folders));
                       }));
  }
  return used;
}

/// A rule for polynomial laws only must not meet another.
void check_quadrature(const SceneMesh::Block& block, const symgen::Law& law) {
  const symgen::AssociationId& id = block.association;
  if (symgen::find_quadrature(id.element, id.quadrature).polynomial_laws_only && !law.polynomial) {
    throw InputError(fmt::format(
        "{}: {}.association = '{}': the quadrature '{}' is only for laws that are polynomials of "
        "the displacement gradient, which '{}' is not: take one of {}",
        block.association_where, block.path, id.text(), id.quadrature, law.name,
        fmt::join(symgen::quadrature_names(id.element), ", ")));
  }
}

std::vector<BlockMaterial> block_materials(const Scene& scene,
                                           const std::vector<SceneMesh::Block>& blocks,
                                           const std::map<std::string, symgen::Law>& laws) {
  const std::vector<std::size_t> material_of = materials_of_blocks(scene.materials, blocks);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    std::vector<const symgen::Law*> its_laws;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (material_of[b] == m) its_laws.push_back(&laws.at(blocks[b].association.law));
    }
    check_material_keys(scene.materials[m], its_laws);
  }
  std::vector<BlockMaterial> result;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const symgen::Law& law = laws.at(blocks[b].association.law);
    check_quadrature(blocks[b], law);
    const MaterialDescription& material = scene.materials[material_of[b]];
    result.push_back({law.name, law_parameters(material, law), material.density});
  }
  return result;
}

/// The constraints of a scene with the nodes that each selects.
using SelectedConstraints =
    std::vector<std::pair<const ConstraintDescription*, std::vector<std::int32_t>>>;

SelectedConstraints select_constraints(const Scene& scene, const SceneMesh& mesh) {
  SelectedConstraints selected;
  for (const ConstraintDescription& description : scene.constraints) {
    selected.emplace_back(&description, select_nodes(mesh, description.nodes));
  }
  return selected;
}

/// Two constraints may fix the same node, or move it to the same place with the load. What has a
/// course of its own, a rotation or a history, must be alone.
///
/// @param node  its number in messages
void check_alone(const ConstraintDescription& one, const ConstraintDescription& other,
                 std::uint64_t node) {
  const auto has_own_course = [](const auto& d) { return d.rotation || d.history; };
  if (!has_own_course(one) && !has_own_course(other)) return;
  throw InputError(fmt::format(
      "{}: constraint: node {} is selected here and by the constraint of {}, and one of the two "
      "moves in a course of its own: select it once",
      other.nodes.where, node, one.nodes.where));
}

void check_equal(const ConstraintDescription& one, const ConstraintDescription& other,
                 std::size_t component, std::uint64_t node) {
  if (one.displacement[component] == other.displacement[component]) return;
  throw InputError(fmt::format(
      "{}: constraint: along {} node {} is given the displacement {} here and {} by the constraint "
      "of {}: give it one",
      other.nodes.where, "xyz"[component], node, *other.displacement[component],
      one.displacement[component].value_or(0), one.nodes.where));
}

Constraints make_constraints(const SelectedConstraints& selected, const Mesh& mesh) {
  Constraints constraints(mesh.num_nodes(), mesh.dim);
  const auto dim = static_cast<std::size_t>(mesh.dim);
  std::vector<const ConstraintDescription*> owners(dim * mesh.num_nodes(), nullptr);
  for (const auto& [description, nodes] : selected) {
    for (const std::int32_t node : nodes) {
      for (std::size_t c = 0; c < dim; ++c) {
        const std::optional<double>& value = description->displacement[c];
        if (!value) continue;
        const ConstraintDescription*& owner = owners[dim * static_cast<std::size_t>(node) + c];
        if (owner) {
          const std::uint64_t number = mesh.node_number(static_cast<std::size_t>(node));
          check_alone(*owner, *description, number);
          check_equal(*owner, *description, c, number);
        }
        owner = description;
        with_location(description->nodes.where, "constraint", [&] {
          constraints.prescribe(static_cast<std::size_t>(node), static_cast<int>(c), *value);
        });
      }
    }
  }
  return constraints;
}

PrescribedMotion make_motion(const SelectedConstraints& selected, const Mesh& mesh,
                             const Constraints& constraints) {
  PrescribedMotion motion(constraints);
  for (const auto& [description, nodes] : selected) {
    if (!description->moves()) continue;
    const History history = description->history.value_or(History());
    if (description->rotation) motion.rotate(mesh, nodes, *description->rotation, history);
    for (int c = 0; c < mesh.dim; ++c) {
      const double value = description->displacement[static_cast<std::size_t>(c)].value_or(0);
      if (value == 0) continue;
      for (const std::int32_t node : nodes) {
        motion.translate(static_cast<std::size_t>(node), c, value, history);
      }
    }
  }
  return motion;
}

/// Where nodes lie on each other, the parts of a body may have been meant to be one.
std::string advice_on_coincident_nodes(const SceneMesh& mesh) {
  const CoincidentNodes found = find_coincident_nodes(mesh.mesh);
  if (found.count == 0) return "";
  return fmt::format(
      "; {} nodes lie on another node (node {} on node {} first), where the body is "
      "not joined: if it should be, merge them{}",
      found.count, mesh.mesh.node_number(found.first[1]), mesh.mesh.node_number(found.first[0]),
      mesh.merge_advice.empty() ? "" : " (" + mesh.merge_advice + ")");
}

void check_held(const Scene& scene, const SceneMesh& scene_mesh, const Constraints& constraints) {
  const Mesh& mesh = scene_mesh.mesh;
  const std::string remedy =
      "fix enough with [[constraint]], for instance a whole face: "
      "plane = { x = 0 }, fixed = " +
      std::string(mesh.dim == 2 ? "[\"x\", \"y\"]" : "[\"x\", \"y\", \"z\"]");
  if (constraints.num_constrained() == 0) {
    throw InputError(fmt::format("{}: nothing is fixed, statics has no answer: {}",
                                 scene.file.string(), remedy));
  }
  const FreeRigidMotion motion = find_free_rigid_motion(mesh, constraints);
  if (motion.count > 0) {
    throw InputError(fmt::format(
        "{}: the constraints leave {} of the {} rigid motions of {}, for example {}: statics has "
        "no "
        "answer; {}{}",
        scene.file.string(), motion.count, mesh.dim == 2 ? 3 : 6,
        motion.num_parts == 1 ? "the body"
                              : fmt::format("the part with node {} (the mesh has {} parts)",
                                            mesh.node_number(motion.node), motion.num_parts),
        motion.example, remedy,
        motion.num_parts == 1 ? "" : advice_on_coincident_nodes(scene_mesh)));
  }
}

std::vector<NodalForce> make_forces(const Scene& scene, const SceneMesh& mesh) {
  std::vector<NodalForce> forces;
  for (const LoadDescription& load : scene.loads) {
    if (!load.force) continue;
    const std::vector<std::int32_t> nodes = select_nodes(mesh, load.nodes);
    std::array<double, 3> share = *load.force;
    for (double& component : share) component /= static_cast<double>(nodes.size());
    for (const std::int32_t node : nodes) {
      forces.push_back({static_cast<std::size_t>(node), share});
    }
  }
  return forces;
}

std::vector<SurfaceLoad> make_surface_loads(const Scene& scene, const SceneMesh& mesh) {
  std::vector<SurfaceLoad> loads;
  for (const LoadDescription& load : scene.loads) {
    if (!load.force) loads.push_back(make_surface_load(mesh, load));
  }
  return loads;
}

/// The curve, known to reach over the whole bar.
std::optional<DeflectionCurve> read_reference(const Scene& scene, const SceneMesh& mesh) {
  if (!scene.reference || scene.reference->file.extension() != ".csv") return std::nullopt;
  return with_location(scene.reference->where, "reference.file", [&] {
    DeflectionCurve curve = read_curve_csv(scene.reference->file);
    DeflectionCurve sections{mesh.mesh.dim, mesh.section_x, {}};
    sections.displacement.resize(sections.size());
    (void)distance(sections, curve);
    return std::optional(std::move(curve));
  });
}

/// The displacements of another result at this mesh's nodes.
std::optional<std::vector<double>> read_reference_displacement(const Scene& scene,
                                                               const Mesh& mesh) {
  if (!scene.reference || scene.reference->file.extension() != ".vtu") return std::nullopt;
  return with_location(scene.reference->where, "reference.file", [&] {
    return displacements_at(scene.reference->file, mesh.positions, mesh.dim);
  });
}

SolverChoice choose_solver(const Scene& scene, const Mesh& mesh) {
  if (scene.dynamics && is_explicit(scene.dynamics->options.scheme)) return {};
  SolverChoice choice = choose_linear_solver(
      mesh, scene.dynamics ? SolverTask::implicit_step : SolverTask::equilibrium,
      memory_for_factor());
  if (scene.solver.method) {
    choice.kind = *scene.solver.method;
    choice.reason = "the scene says so";
    choice.fall_back_after = 0;
  }
  return choice;
}

}  // namespace

Problem prepare(const Scene& scene, const std::vector<std::filesystem::path>& law_folders) {
  SceneMesh mesh = make_mesh(scene);
  std::map<std::string, symgen::Law> laws = read_laws(scene, mesh.blocks, law_folders);
  std::vector<BlockMaterial> materials = block_materials(scene, mesh.blocks, laws);
  const SelectedConstraints selected = select_constraints(scene, mesh);
  Constraints constraints = make_constraints(selected, mesh.mesh);
  PrescribedMotion motion = make_motion(selected, mesh.mesh, constraints);
  if (!scene.dynamics) check_held(scene, mesh, constraints);
  std::vector<NodalForce> forces = make_forces(scene, mesh);
  std::vector<SurfaceLoad> surface_loads = make_surface_loads(scene, mesh);
  std::vector<Probe> probes;
  for (const ProbeDescription& probe : scene.probes) {
    probes.push_back({probe.name, select_nodes(mesh, probe.nodes)});
  }
  SolverChoice solver = choose_solver(scene, mesh.mesh);
  std::optional<DeflectionCurve> reference = read_reference(scene, mesh);
  std::optional<std::vector<double>> displacement = read_reference_displacement(scene, mesh.mesh);
  return {std::move(mesh),   std::move(laws),      std::move(materials),     std::move(constraints),
          std::move(motion), std::move(forces),    std::move(surface_loads), std::move(probes),
          std::move(solver), std::move(reference), std::move(displacement)};
}

}  // namespace elastogen::selector
