#include "selector/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "runtime/error.h"
#include "selector/scene/located_error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

std::filesystem::path beside_scene(const TomlTable& table, const std::string& file) {
  return std::filesystem::absolute(table.file()).parent_path() / file;
}

symgen::AssociationId read_association(const TomlTable& table) {
  const std::string text = table.string("association");
  return with_location(table.where("association"), table.path_of("association"),
                       [&] { return symgen::AssociationId::parse(text); });
}

/// Plane elements belong into plane scenes, the others into space.
void check_dimension(const TomlTable& table, const symgen::AssociationId& association, int dim) {
  const int found = symgen::find_element(association.element).dim;
  if (found == dim) return;
  std::vector<std::string> possible;
  for (const std::string& name : symgen::element_names()) {
    if (symgen::find_element(name).dim == dim) possible.push_back(name);
  }
  table.fail("association",
             fmt::format("element '{}' is {}, but the scene is {} (a bar with a width is in "
                         "space, one without is plane; a mesh is as its first block): take {}",
                         association.element, found == 2 ? "plane" : "three-dimensional",
                         dim == 2 ? "plane" : "in space", join(possible, ", ")));
}

SectionDescription read_section(const TomlTable& table, int dim) {
  table.allow_only({"until", "association", "region"});
  SectionDescription section;
  section.path = table.path();
  section.until = table.number("until", {0, 1, true, false});
  section.until_where = table.where("until");
  section.association = read_association(table);
  check_dimension(table, section.association, dim);
  section.association_where = table.where("association");
  section.region = table.string("region");
  section.region_where = table.where("region");
  return section;
}

std::vector<SectionDescription> read_sections(const TomlTable& bar, int dim) {
  std::vector<SectionDescription> sections;
  double before = 0;
  for (const TomlTable& table : bar.tables("section")) {
    sections.push_back(read_section(table, dim));
    if (sections.back().until <= before) {
      table.fail("until",
                 fmt::format("must be greater than {}, where the section before it ends", before));
    }
    before = sections.back().until;
  }
  if (sections.empty()) bar.fail("has no elements: add at least one [[bar.section]]");
  if (before != 1) {
    bar.tables("section").back().fail("until", "must be 1 in the last section: the bar's end");
  }
  return sections;
}

InclusionDescription read_inclusion(const TomlTable& table, int dim) {
  table.allow_only({"box", "region"});
  InclusionDescription inclusion;
  inclusion.path = table.path();
  inclusion.box = read_box(table.table("box"), dim);
  inclusion.region = table.string("region");
  inclusion.region_where = table.where("region");
  return inclusion;
}

BarDescription read_bar(const TomlTable& table, int dim) {
  table.allow_only({"length", "width", "height", "cells", "section", "inclusion"});
  BarDescription bar;
  const double length = table.number("length", positive_number);
  const double height = table.number("height", positive_number);
  if (dim == 2) {
    bar.size = {length, height, 0};
  } else {
    bar.size = {length, table.number("width", positive_number), height};
  }
  const std::vector<int> cells = table.integers("cells", static_cast<std::size_t>(dim), 1);
  std::copy(cells.begin(), cells.end(), bar.cells.begin());
  bar.cells_where = table.where("cells");
  bar.sections = read_sections(table, dim);
  for (const TomlTable& inclusion : table.tables("inclusion")) {
    bar.inclusions.push_back(read_inclusion(inclusion, dim));
  }
  return bar;
}

SphereDescription read_sphere(const TomlTable& table) {
  table.allow_only({"inner", "outer", "cells", "association", "region"});
  SphereDescription sphere;
  sphere.inner = table.number("inner", positive_number);
  sphere.outer = table.number("outer", positive_number);
  if (sphere.outer <= sphere.inner) {
    table.fail("outer", fmt::format("must be greater than inner, {}", sphere.inner));
  }
  const std::vector<int> cells = table.integers("cells", 2, 1);
  std::copy(cells.begin(), cells.end(), sphere.cells.begin());
  sphere.cells_where = table.where("cells");
  sphere.association = read_association(table);
  check_dimension(table, sphere.association, 3);
  sphere.association_where = table.where("association");
  sphere.region = table.string("region");
  sphere.region_where = table.where("region");
  return sphere;
}

BlockDescription read_block(const TomlTable& table, int dim) {
  table.allow_only({"association", "region", "elements"});
  BlockDescription block;
  block.path = table.path();
  block.association = read_association(table);
  check_dimension(table, block.association, dim);
  block.association_where = table.where("association");
  block.region = table.string("region");
  block.region_where = table.where("region");
  const int num_nodes = symgen::find_element(block.association.element).num_nodes();
  block.elements_where = table.where("elements");
  block.elements = table.integer_rows("elements", static_cast<std::size_t>(num_nodes));
  if (block.elements.empty()) table.fail("elements", "must have one element or more");
  return block;
}

ExplicitMeshDescription read_mesh(const TomlTable& table, int dim) {
  table.allow_only({"nodes", "block"});
  ExplicitMeshDescription mesh;
  mesh.where = table.where();
  mesh.nodes = table.rows("nodes", static_cast<std::size_t>(dim));
  for (const TomlTable& block : table.tables("block"))
    mesh.blocks.push_back(read_block(block, dim));
  if (mesh.blocks.empty()) table.fail("has no elements: add at least one [[mesh.block]]");
  return mesh;
}

std::vector<MaterialDescription> read_materials(const TomlTable& materials, bool dynamic) {
  std::vector<MaterialDescription> found;
  std::set<std::string> taken;
  for (const std::string& name : materials.keys()) {
    const TomlTable table = materials.table(name);
    MaterialDescription material{
        name, {name}, table.number("density", dynamic ? positive_number : not_negative), table};
    if (table.has("regions")) material.regions = table.strings("regions");
    for (const std::string& region : material.regions) {
      if (!taken.insert(region).second) {
        table.fail(fmt::format("region '{}' has a material already: a region has one", region));
      }
    }
    found.push_back(std::move(material));
  }
  return found;
}

LoadDescription read_load(const TomlTable& table, int dim) {
  table.allow_only({"plane", "box", "boundary", "force", "pressure", "traction"});
  if (table.has("force") + table.has("pressure") + table.has("traction") != 1) {
    table.fail("needs one of force = [0, 0, -10], pressure = 1e4 and traction = [0, 0, -1e4]");
  }
  LoadDescription load{read_selection(table, dim), {}, {}, {}};
  if (table.has("force")) load.force = table.vector("force", dim);
  if (table.has("pressure")) load.pressure = table.number("pressure", any_number);
  if (table.has("traction")) load.traction = table.vector("traction", dim);
  return load;
}

std::vector<ProbeDescription> read_probes(const TomlTable& scene, int dim) {
  std::vector<ProbeDescription> probes;
  for (const TomlTable& table : scene.tables("probe")) {
    table.allow_only({"name", "plane", "box", "boundary"});
    const std::string name = table.string("name");
    for (const ProbeDescription& probe : probes) {
      if (probe.name == name) table.fail("name", "another probe has this name");
    }
    probes.push_back({name, read_selection(table, dim)});
  }
  return probes;
}

/// The value that a key names.
template <class Value>
Value choose(const TomlTable& table, const std::string& key, std::string_view (*name_of)(Value),
             const std::vector<Value>& values) {
  std::vector<std::string> names;
  for (const Value value : values) names.emplace_back(name_of(value));
  const std::string chosen = table.choice(key, names);
  return values[static_cast<std::size_t>(std::find(names.begin(), names.end(), chosen) -
                                         names.begin())];
}

SolverSettings read_solver(const TomlTable& table,
                           const std::optional<DynamicsDescription>& dynamics) {
  const bool has_tangent = !dynamics || !is_explicit(dynamics->options.scheme);
  if (!dynamics) {
    table.allow_only({"method", "tangent", "project", "precision", "tolerance", "max_iterations",
                      "load_steps", "threads"});
  } else if (has_tangent) {
    table.allow_only({"method", "tangent", "project", "precision", "threads"});
  } else {
    table.allow_only({"precision", "threads"});
  }
  SolverSettings solver;
  if (table.has("method")) {
    const std::string method =
        table.choice("method", {"auto", "cg", "cholesky", "cholesky_cg", "incomplete_cg"});
    if (method != "auto") {
      solver.method = choose(table, "method", solver_name,
                             {LinearSolverKind::conjugate_gradient, LinearSolverKind::cholesky,
                              LinearSolverKind::cholesky_cg, LinearSolverKind::incomplete_cg});
    }
  }
  const bool has_products = has_tangent && solver.method != LinearSolverKind::cholesky;
  if (!has_products) solver.tangent = TangentProduct::recompute;
  if (table.has("tangent")) {
    if (!has_products) table.fail("tangent", "is for methods with conjugate gradient");
    solver.tangent = choose(table, "tangent", tangent_product_name,
                            {TangentProduct::automatic, TangentProduct::recompute,
                             TangentProduct::two_stage, TangentProduct::assembled});
  }
  if (table.has("project")) {
    solver.projection =
        choose(table, "project", projection_name,
               {TangentProjection::never, TangentProjection::on_demand, TangentProjection::always});
  }
  if (table.has("precision")) {
    std::vector<Precision> allowed = {Precision::double_precision, Precision::single_precision};
    // Without a tangent there is nothing to mix.
    if (has_tangent) allowed.push_back(Precision::mixed);
    solver.precision = choose(table, "precision", precision_name, allowed);
  }
  if (table.has("tolerance")) solver.tolerance = table.number("tolerance", {0, 1, true, true});
  if (table.has("max_iterations")) solver.max_iterations = table.integer("max_iterations", 1);
  if (table.has("load_steps")) solver.load_steps = table.integer("load_steps", 1);
  if (table.has("threads")) solver.threads = table.integer("threads", 0);
  return solver;
}

SkipSettings read_skip(const TomlTable& table, const std::optional<DynamicsDescription>& dynamics) {
  table.allow_only({"at_rest", "congruent", "sleep"});
  SkipSettings skip;
  if (table.has("at_rest")) skip.at_rest = table.boolean("at_rest");
  if (table.has("congruent")) skip.congruent = table.boolean("congruent");
  if (!table.has("sleep")) return skip;
  const TomlTable sleep = table.table("sleep");
  if (!dynamics || !is_explicit(dynamics->options.scheme)) {
    sleep.fail(
        "is for motions by symplectic_euler or central_differences: systems of equations "
        "need every element");
  }
  sleep.allow_only({"motion", "steps"});
  skip.sleep.motion = sleep.number("motion", positive_number);
  if (sleep.has("steps")) skip.sleep.calls = sleep.integer("steps", 1);
  return skip;
}

FieldContext field_context(const OutputSettings& output, const Scene& scene) {
  return {output.vtu || output.series || output.picture, output.picture,
          scene.dynamics.has_value()};
}

/// What is written unless the scene says something else.
OutputSettings default_output(const Scene& scene) {
  OutputSettings output;
  output.curve = scene.bar.has_value();
  output.series = output.history = scene.has_steps();
  output.energy = !scene.dynamics;
  output.fields = default_fields(field_context(output, scene));
  return output;
}

OutputSettings read_output(const TomlTable& table, const Scene& scene) {
  table.allow_only(
      {"write", "every", "energy", "momentum", "fields", "stress_at", "nodal", "picture"});
  OutputSettings output = default_output(scene);
  if (table.has("write")) {
    const bool energy = output.energy;
    output = {false, false, false, false, false, {}, false, energy, {}};
    const std::vector<std::pair<std::string, bool*>> choices = {{"vtu", &output.vtu},
                                                                {"curve", &output.curve},
                                                                {"picture", &output.picture},
                                                                {"series", &output.series},
                                                                {"history", &output.history}};
    std::vector<std::string> names;
    for (const auto& [name, wanted] : choices) names.push_back(name);
    for (const std::string& name : table.strings("write")) {
      const auto chosen = std::find(names.begin(), names.end(), name);
      if (chosen == names.end()) {
        table.fail("write", fmt::format("'{}' is no output: {} are", name, join(names, ", ")));
      }
      *choices[static_cast<std::size_t>(chosen - names.begin())].second = true;
    }
    if (output.curve && !scene.bar) table.fail("write", "a deflection curve needs a [bar]");
    if ((output.series || output.history) && !scene.has_steps()) {
      table.fail("write", "series and history need [dynamics], or load_steps of 2 or more");
    }
  }
  if (table.has("every")) {
    if (!output.series) table.fail("every", "is of the series, which is not written");
    output.every = table.integer("every", 1);
  }
  if (table.has("energy")) {
    if (!scene.dynamics) table.fail("energy", "is for [dynamics]: statics always computes it");
    output.energy = table.boolean("energy");
  }
  if (table.has("momentum")) {
    if (!scene.dynamics || !output.history) {
      table.fail("momentum", "is of the history of a motion, which is not written");
    }
    output.momentum = table.boolean("momentum");
  }
  output.fields = read_fields(table, field_context(output, scene));
  return output;
}

MeasureSettings read_measure(const TomlTable& scene, bool has_solid_bar) {
  MeasureSettings measure;
  for (const std::string& name : scene.strings("measure")) {
    if (name == "young") {
      measure.young = true;
    } else if (name == "poisson") {
      measure.poisson = true;
    } else {
      scene.fail("measure", fmt::format("'{}' cannot be measured: young, poisson can", name));
    }
  }
  if (!has_solid_bar) scene.fail("measure", "needs a [bar] in space, which is pulled along x");
  return measure;
}

/// Regions that materials name.
std::vector<std::string> regions_of_materials(const TomlTable& scene) {
  std::vector<std::string> regions;
  const TomlTable materials = scene.table("material");
  for (const std::string& name : materials.keys()) {
    const TomlTable material = materials.table(name);
    if (!material.has("regions")) regions.push_back(name);
    if (!material.has("regions")) continue;
    for (const std::string& region : material.strings("regions")) regions.push_back(region);
  }
  return regions;
}

/// A bar without width is plane, a mesh is what its file or first block is.
int dimension_of(const Scene& description, const TomlTable& scene) {
  if (description.mesh_file) return description.mesh_file->mesh->mesh.dim;
  if (scene.has("sphere")) return 3;
  if (scene.has("bar")) return scene.table("bar").has("width") ? 3 : 2;
  const std::vector<TomlTable> blocks = scene.table("mesh").tables("block");
  return blocks.empty() ? 3 : symgen::find_element(read_association(blocks[0]).element).dim;
}

ReferenceDescription read_reference(const TomlTable& table) {
  table.allow_only({"file", "label"});
  const std::filesystem::path extension = std::filesystem::path(table.string("file")).extension();
  if (extension != ".csv" && extension != ".vtu") {
    table.fail("file", "must be a deflection curve (.csv) or a result file (.vtu)");
  }
  return {table.where("file"), beside_scene(table, table.string("file")),
          table.has("label") ? table.string("label") : "reference"};
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
  const TomlTable table = TomlTable::open(file);
  table.allow_only({"title", "laws", "gravity", "bar", "sphere", "mesh", "material", "constraint",
                    "load", "probe", "dynamics", "start", "solver", "skip", "measure", "output",
                    "reference"});
  Scene scene;
  scene.file = file;
  scene.title = table.has("title") ? table.string("title") : file.stem().string();
  if (table.has("laws")) {
    for (const std::string& law : table.strings("laws")) {
      scene.law_files.push_back(beside_scene(table, law));
      if (!std::filesystem::is_regular_file(scene.law_files.back())) {
        table.fail("laws", fmt::format("there is no file '{}': paths start at the scene's folder",
                                       scene.law_files.back().string()));
      }
    }
  }
  if (table.has("bar") + table.has("sphere") + table.has("mesh") != 1) {
    table.fail("a scene needs a [bar], a [sphere] or a [mesh], and only one of them");
  }
  if (!table.has("material")) {
    table.fail("there is no material: add [material.NAME] with density, young and poisson");
  }
  if (table.has("mesh") && table.table("mesh").has("file")) {
    scene.mesh_file = read_mesh_file_table(table.table("mesh"), regions_of_materials(table));
  }
  scene.dim = dimension_of(scene, table);
  if (table.has("gravity")) scene.gravity = table.vector("gravity", scene.dim);
  if (table.has("bar")) scene.bar = read_bar(table.table("bar"), scene.dim);
  if (table.has("sphere")) scene.sphere = read_sphere(table.table("sphere"));
  if (table.has("mesh") && !scene.mesh_file) scene.mesh = read_mesh(table.table("mesh"), scene.dim);
  if (table.has("dynamics")) scene.dynamics = read_dynamics(table.table("dynamics"), scene.dim);
  scene.materials = read_materials(table.table("material"), scene.dynamics.has_value());

  for (const TomlTable& constraint : table.tables("constraint")) {
    scene.constraints.push_back(read_constraint(constraint, scene.dim, scene.dynamics.has_value()));
  }
  for (const TomlTable& load : table.tables("load"))
    scene.loads.push_back(read_load(load, scene.dim));
  scene.probes = read_probes(table, scene.dim);
  if (table.has("start")) {
    if (scene.dynamics) table.fail("start", "is for statics: motions start at rest");
    const std::string name = table.choice("start", start_names());
    while (start_names()[static_cast<std::size_t>(scene.start)] != name) {
      scene.start = static_cast<Start>(static_cast<int>(scene.start) + 1);
    }
  }
  if (table.has("solver")) scene.solver = read_solver(table.table("solver"), scene.dynamics);
  if (table.has("skip")) scene.skip = read_skip(table.table("skip"), scene.dynamics);
  if (table.has("measure")) {
    scene.measure = read_measure(table, scene.bar && scene.dim == 3);
  }
  scene.output =
      table.has("output") ? read_output(table.table("output"), scene) : default_output(scene);
  if (table.has("reference")) {
    scene.reference = read_reference(table.table("reference"));
    if (scene.reference->file.extension() == ".csv" && !scene.output.curve) {
      table.table("reference").fail("needs a deflection curve: a [bar], and \"curve\" in output");
    }
  }
  return scene;
}

}  // namespace elastogen::selector
