// What a scene file says, as records. docs/scene.md describes the file key by key.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/linear_solver.h"
#include "selector/scene/constraint_table.h"
#include "selector/scene/dynamics_table.h"
#include "selector/scene/field_table.h"
#include "selector/scene/mesh_file_table.h"
#include "selector/scene/start.h"
#include "selector/scene/toml_table.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// A part of a bar along x, cut into elements of one kind.
struct SectionDescription {
  std::string path;         ///< "bar.section[1]"
  double until = 1;         ///< end, as a fraction of the bar's length
  std::string until_where;  ///< "scene.toml:14", for messages; so are those below
  symgen::AssociationId association;
  std::string association_where;
  std::string region;
  std::string region_where;
};

/// A box within a bar whose elements are of a region of their own.
struct InclusionDescription {
  std::string path;   ///< "bar.inclusion[0]"
  NodeSelection box;  ///< of the middles of its elements
  std::string region;
  std::string region_where;
};

/// A bar [0, length] x [0, width] x [0, height], divided into a grid of cells that every section
/// cuts into its elements (thesis, section 5.3 and codes 19 and 23). A bar without width is plane:
/// [0, length] x [0, height].
struct BarDescription {
  std::array<double, 3> size{};  ///< length, width, height along x, y, z; or length, height, 0 [m]
  std::array<int, 3> cells{};    ///< along x, y, z; 0 along z in the plane
  std::string cells_where;
  std::vector<SectionDescription> sections;
  std::vector<InclusionDescription> inclusions;  ///< later ones prevail
};

/// The part x, y, z >= 0 of a thick sphere about the origin, cut into elements of one kind.
struct SphereDescription {
  double inner = 0, outer = 0;  ///< radii [m], inner < outer
  std::array<int, 2> cells{};   ///< along an edge of the surface (make_sphere), in layers
  std::string cells_where;
  symgen::AssociationId association;
  std::string association_where;
  std::string region;
  std::string region_where;
};

/// Elements written out by hand.
struct BlockDescription {
  std::string path;  ///< "mesh.block[1]"
  symgen::AssociationId association;
  std::string association_where;
  std::string region;
  std::string region_where;
  std::vector<std::vector<int>> elements;  ///< node numbers from 0, in the element's order
  std::string elements_where;
};

struct ExplicitMeshDescription {
  std::string where;
  std::vector<std::vector<double>> nodes;  ///< coordinates, Scene::dim of each
  std::vector<BlockDescription> blocks;
};

/// The law's parameters stay in the table: which keys it may have depends on the laws of the
/// regions that use the material.
struct MaterialDescription {
  std::string name;
  std::vector<std::string> regions;
  double density = 0;
  TomlTable table;
};

/// One of the three; pressure and traction act on the surface whose nodes are selected.
struct LoadDescription {
  NodeSelection nodes;
  std::optional<std::array<double, 3>> force;     ///< total [N], spread evenly over the nodes
  std::optional<double> pressure;                 ///< [Pa], positive against the body
  std::optional<std::array<double, 3>> traction;  ///< [Pa]
};

struct ProbeDescription {
  std::string name;
  NodeSelection nodes;
};

struct SolverSettings {
  /// None: chosen for the mesh, Problem::solver.
  std::optional<LinearSolverKind> method;
  std::optional<TangentProjection> projection;  ///< none: the default of statics or dynamics
  Precision precision = Precision::double_precision;
  TangentProduct tangent = TangentProduct::automatic;  ///< recompute where nothing iterates
  double tolerance = 1e-8;
  int max_iterations = 100;
  int load_steps = 1;
  int threads = 0;  ///< 0: all
};

/// What is left out of the work on the elements.
struct SkipSettings {
  bool at_rest = true;    ///< elements between held nodes
  bool congruent = true;  ///< constants of elements that are translations of each other
  SleepOptions sleep;     ///< of motions by explicit schemes
};

struct OutputSettings {
  bool vtu = true;
  bool curve = true;  ///< only of bars
  bool picture = true;
  bool series = false;  ///< of motions and load steps; so is the next
  bool history = false;
  std::optional<int> every;  ///< time or load steps between the files of the series
  bool momentum = false;     ///< of motions, in the history
  bool energy = true;        ///< elastic energy, in the history
  FieldSettings fields;
};

/// Constants of the material measured back from a bar that is pulled along x.
struct MeasureSettings {
  bool young = false;
  bool poisson = false;
};

/// What results are compared with.
struct ReferenceDescription {
  std::string where;
  std::filesystem::path file;  ///< .csv: a deflection curve; .vtu: displacements of a whole body
  std::string label;
};

struct Scene {
  std::filesystem::path file;
  std::string title;
  std::vector<std::filesystem::path> law_files;
  int dim = 3;  ///< 2: a plane scene, in plane strain; vectors have a last component of 0
  std::array<double, 3> gravity{};
  std::optional<BarDescription> bar;  ///< a scene has a bar, a sphere, a mesh or a mesh file
  std::optional<SphereDescription> sphere;
  std::optional<ExplicitMeshDescription> mesh;
  std::optional<MeshFileDescription> mesh_file;
  std::vector<MaterialDescription> materials;
  std::vector<ConstraintDescription> constraints;
  std::vector<LoadDescription> loads;
  std::vector<ProbeDescription> probes;
  std::optional<DynamicsDescription> dynamics;  ///< none: static equilibrium
  Start start = Start::rest;                    ///< of statics
  SolverSettings solver;
  SkipSettings skip;
  MeasureSettings measure;
  OutputSettings output;
  std::optional<ReferenceDescription> reference;

  /// Whether the run goes through steps: of time, or of the load.
  [[nodiscard]] bool has_steps() const { return dynamics || solver.load_steps > 1; }
};

/// Reads a scene file, and the mesh file that it names, and checks all that can be checked without
/// laws.
/// @throws InputError  with file, line, what was found and what is allowed
[[nodiscard]] Scene read_scene(const std::filesystem::path& file);

}  // namespace elastogen::selector
