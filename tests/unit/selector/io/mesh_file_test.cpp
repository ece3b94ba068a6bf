// Mesh files: node orders both ways, every format, and what is wrong with a file.
#include "selector/io/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "../scene/element_measures.h"
#include "../temporary_folder.h"
#include "mesh_file_errors.h"
#include "mesh_writer.h"
#include "runtime/error.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_faces.h"
#include "selector/mesh_readers/gmsh_elements.h"
#include "selector/support/files.h"

namespace elastogen::selector {

/// For messages of parametrised tests.
inline void PrintTo(const GmshElement& element, std::ostream* out) { *out << element.element; }

namespace {

class MeshFiles : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const {
    return folder_.path() / name;
  }
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& text) const {
    write_text_file(file(name), text);
    return file(name);
  }
  [[nodiscard]] std::filesystem::path write(const WrittenMesh& mesh) const {
    write_with_gmsh(mesh, MeshFormat::msh4, file("mesh.msh"));
    return file("mesh.msh");
  }
  void expect_error(const WrittenMesh& mesh, const std::vector<std::string>& words) const {
    expect_words(error_of_file(write(mesh)), words);
  }

 private:
  TemporaryFolder folder_;
};

/// A cube, a prism beside it, a pyramid on it and a tetrahedron on the pyramid.
WrittenMesh house() {
  return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0,  0,  1, 1,  0,  1,
           1, 1, 1, 0, 1, 1, 2, 0, 0, 2, 1, 0, .5, .5, 2, .5, -1, 1.5},
          {{5, {{0, 1, 2, 3, 4, 5, 6, 7}}, "house"},
           {6, {{1, 5, 8, 2, 6, 9}}, "house"},
           {7, {{4, 5, 6, 7, 10}}, "roof"},
           {4, {{4, 11, 5, 10}}, "roof"},
           {3, {{0, 3, 7, 4}}, "wall"},
           {2, {{4, 11, 10}, {5, 10, 11}}, "wind"},
           {1, {{1, 8}}, "edge"},
           {15, {{11}}, "tip"}}};
}

/// Without what a format cannot hold.
WrittenMesh house_for(MeshFormat format) {
  WrittenMesh mesh = house();
  std::erase_if(mesh.elements, [&](const WrittenElements& elements) {
    // gmsh crashes on its own .unv files when a group has points.
    if (format == MeshFormat::unv) return elements.type == 7 || elements.type == 15;
    return format == MeshFormat::mesh && (elements.type == 6 || elements.type == 7);
  });
  return mesh;
}

struct FormatCase {
  MeshFormat format;
  const char* file;
};

void PrintTo(const FormatCase& format, std::ostream* out) { *out << format.file; }

const std::array all_formats = {
    FormatCase{MeshFormat::msh2, "house2.msh"}, FormatCase{MeshFormat::msh2_binary, "house2b.msh"},
    FormatCase{MeshFormat::msh4, "house4.msh"}, FormatCase{MeshFormat::msh4_binary, "house4b.msh"},
    FormatCase{MeshFormat::vtk, "house.vtk"},   FormatCase{MeshFormat::mesh, "house.mesh"},
    FormatCase{MeshFormat::unv, "house.unv"}};

class EveryFormat : public testing::TestWithParam<FormatCase> {
 protected:
  /// The committed file. It is written anew where ELASTOGEN_UPDATE_MESHES is set.
  [[nodiscard]] static std::filesystem::path file() {
    const auto path = std::filesystem::path(ELASTOGEN_TEST_DATA) / "meshes" / GetParam().file;
    if (std::getenv("ELASTOGEN_UPDATE_MESHES") != nullptr) {
      std::filesystem::create_directories(path.parent_path());
      write_with_gmsh(house_for(GetParam().format), GetParam().format, path);
    }
    return path;
  }
};

/// Coordinates of an element's nodes, in our order.
std::vector<double> positions_of(const Mesh& mesh, const ElementBlock& block, std::size_t e) {
  std::vector<double> positions;
  for (const std::int32_t node : block.element_nodes(e)) {
    const auto first = mesh.positions.begin() + 3 * static_cast<std::ptrdiff_t>(node);
    positions.insert(positions.end(), first, first + 3);
  }
  return positions;
}

TEST_P(EveryFormat, GivesTheSameMesh) {
  const WrittenMesh written = house_for(GetParam().format);
  const MeshFile read = read_mesh_file(file());
  // The .mesh file has no prism, so a node of the edge belongs to no solid.
  const std::size_t left_out = GetParam().format == MeshFormat::mesh ? 1 : 0;
  EXPECT_EQ(read.notes.size(), left_out) << ::testing::PrintToString(read.notes);
  std::size_t count = 0;
  for (const WrittenElements& elements : written.elements) {
    const GmshElement* type = find_gmsh_element(elements.type);
    if (type == nullptr || elements.type == 2 || elements.type == 3) continue;
    ++count;
    const auto block = std::find_if(read.mesh.blocks.begin(), read.mesh.blocks.end(),
                                    [&](const auto& b) { return b.element == type->element; });
    ASSERT_NE(block, read.mesh.blocks.end()) << type->element;
    std::vector<double> expected;
    for (const int node : elements.nodes.front()) {
      const auto first = written.coordinates.begin() + 3 * node;
      expected.insert(expected.end(), first, first + 3);
    }
    EXPECT_EQ(positions_of(read.mesh, *block, 0), expected) << type->element;
  }
  EXPECT_EQ(read.mesh.num_elements(), count);
}

TEST_P(EveryFormat, GivesGroupsWhereItHasThem) {
  const MeshFile read = read_mesh_file(file());
  std::map<std::string, std::pair<std::size_t, std::size_t>> boundaries;
  for (const MeshBoundary& boundary : read.boundaries) {
    boundaries[boundary.name] = {boundary.nodes.size(), boundary.faces.size()};
  }
  const std::set<std::string> regions(read.mesh.region_names.begin(), read.mesh.region_names.end());
  using Regions = std::set<std::string>;
  switch (GetParam().format) {
    case MeshFormat::vtk:
      // Gmsh writes its entities, each group having one here.
      EXPECT_EQ(regions, (Regions{"5", "6"}));
      EXPECT_EQ(boundaries.size(), 2U);
      EXPECT_EQ(boundaries["3"], (std::pair<std::size_t, std::size_t>(4, 1)));
      EXPECT_EQ(boundaries["4"], (std::pair<std::size_t, std::size_t>(4, 2)));
      break;
    case MeshFormat::mesh:
      EXPECT_EQ(regions.size(), 2U);
      EXPECT_EQ(boundaries.size(), 2U);
      EXPECT_EQ(boundaries["1"], (std::pair<std::size_t, std::size_t>(4, 1)));
      EXPECT_EQ(boundaries["2"], (std::pair<std::size_t, std::size_t>(4, 2)));
      break;
    case MeshFormat::msh2:
    case MeshFormat::msh2_binary:
    case MeshFormat::msh4:
    case MeshFormat::msh4_binary:
      EXPECT_EQ(boundaries["tip"], (std::pair<std::size_t, std::size_t>(1, 0)));
      [[fallthrough]];
    case MeshFormat::unv:
      EXPECT_EQ(regions, (Regions{"house", "roof"}));
      EXPECT_EQ(boundaries["wall"], (std::pair<std::size_t, std::size_t>(4, 1)));
      EXPECT_EQ(boundaries["wind"], (std::pair<std::size_t, std::size_t>(4, 2)));
      EXPECT_EQ(boundaries["edge"], (std::pair<std::size_t, std::size_t>(2, 0)));
      break;
  }
}

TEST_P(EveryFormat, IsRefusedWhereItIsCutShort) {
  const std::string whole = read_text_file(file(), "mesh");
  const TemporaryFolder folder;
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 generator(seed);
  const MeshFile right = read_mesh_file(file());
  for (int i = 0; i < 6; ++i) {
    const std::size_t length = generator() % whole.size();
    const auto cut = folder.path() / (std::string("cut") + GetParam().file);
    write_text_file(cut, whole.substr(0, length));
    // What is left may still be a mesh: then it is a sound one, of no more elements.
    try {
      const MeshFile read = read_mesh_file(cut);
      EXPECT_LE(read.mesh.num_elements(), right.mesh.num_elements()) << length;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(cut.string()), std::string::npos) << error.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryFormat, testing::ValuesIn(all_formats));

class EveryElement : public testing::TestWithParam<GmshElement> {};

/// The nodes of our reference element.
std::vector<double> reference_nodes(const std::string& name) {
  std::vector<double> coordinates;
  for (const auto& node : symgen::find_element(name).nodes) {
    for (std::size_t c = 0; c < 3; ++c) {
      coordinates.push_back(c < node.size() ? GiNaC::ex_to<GiNaC::numeric>(node[c]).to_double()
                                            : 0.0);
    }
  }
  return coordinates;
}

/// Our nodes 0, 1, ... in gmsh's order.
std::vector<int> in_gmsh_order(const GmshElement& element) {
  std::vector<int> nodes(element.order.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    nodes[static_cast<std::size_t>(element.order[a])] = static_cast<int>(a);
  }
  return nodes;
}

TEST_P(EveryElement, GoesThroughGmshAndBack) {
  const GmshElement& element = GetParam();
  const std::string name(element.element);
  const WrittenMesh written = {reference_nodes(name),
                               {{element.type, {in_gmsh_order(element)}, ""}}};
  const TemporaryFolder folder;
  write_with_gmsh(written, MeshFormat::msh4, folder.path() / "element.msh");
  const MeshFile read = read_mesh_file(folder.path() / "element.msh");
  EXPECT_TRUE(read.notes.empty()) << read.notes.front();
  ASSERT_EQ(read.mesh.blocks.size(), 1U);
  EXPECT_EQ(read.mesh.blocks[0].element, name);
  EXPECT_EQ(positions_of(read.mesh, read.mesh.blocks[0], 0), written.coordinates);
  EXPECT_GT(volume_by_faces(read.mesh.positions, read.mesh.blocks[0].element_nodes(0), name), 0);
  EXPECT_GT(ShapeGradients(name).least_jacobian(read.mesh.positions,
                                                read.mesh.blocks[0].element_nodes(0)),
            0);
}

TEST_P(EveryElement, IsTurnedWhenAllOfItsKindAreInsideOut) {
  const GmshElement& element = GetParam();
  const std::string name(element.element);
  std::vector<int> nodes(element.order.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    nodes[static_cast<std::size_t>(element.order[a])] = element.mirror[a];
  }
  const WrittenMesh written = {reference_nodes(name), {{element.type, {nodes}, ""}}};
  const TemporaryFolder folder;
  write_with_gmsh(written, MeshFormat::msh4, folder.path() / "element.msh");
  const MeshFile read = read_mesh_file(folder.path() / "element.msh");
  ASSERT_EQ(read.notes.size(), 1U) << ::testing::PrintToString(read.notes);
  expect_words(read.notes[0], {"element.msh: all 1 ", "inside out"});
  EXPECT_EQ(positions_of(read.mesh, read.mesh.blocks[0], 0), written.coordinates);
}

std::vector<GmshElement> solids() {
  std::vector<GmshElement> result;
  for (const GmshElement& element : gmsh_elements()) {
    if (symgen::find_element(std::string(element.element)).nodes.front().size() == 3) {
      result.push_back(element);
    }
  }
  return result;
}

INSTANTIATE_TEST_SUITE_P(All, EveryElement, testing::ValuesIn(solids()));

TEST_F(MeshFiles, NumberElementsAndNodesAsTheFileDoes) {
  const MeshFile read = read_mesh_file(write(house()));
  EXPECT_EQ(read.mesh.numbers->elements, (std::vector<std::uint64_t>{1, 2, 3, 4}));
  EXPECT_EQ(read.mesh.num_nodes(), 12U);
  EXPECT_EQ(match_faces(read.mesh).boundary.size(), 6 + 5 + 5 + 4 - 2 * 3U);
}

TEST_F(MeshFiles, LeaveOutNodesOfNoElement) {
  WrittenMesh mesh = house();
  mesh.coordinates.insert(mesh.coordinates.begin() + 9, {7, 7, 7});
  for (WrittenElements& elements : mesh.elements) {
    for (auto& nodes : elements.nodes) {
      for (int& node : nodes) node += node >= 3;
    }
  }
  mesh.elements.push_back({15, {{3}}, "far"});
  const MeshFile read = read_mesh_file(write(mesh));
  EXPECT_EQ(read.mesh.num_nodes(), 12U);
  ASSERT_EQ(read.notes.size(), 2U) << ::testing::PrintToString(read.notes);
  expect_words(read.notes[0], {"1 nodes belong to no element"});
  expect_words(read.notes[1], {"'far'", "1 of its 1 nodes"});
  for (const MeshBoundary& boundary : read.boundaries) EXPECT_NE(boundary.name, "far");
}

TEST_F(MeshFiles, SayWhereNodesLieOnOthers) {
  WrittenMesh mesh = house();
  mesh.coordinates.insert(mesh.coordinates.end(), {1, 0, 0});
  mesh.elements[1].nodes[0][0] = 12;
  const MeshFile read = read_mesh_file(write(mesh));
  ASSERT_EQ(read.notes.size(), 1U);
  expect_words(read.notes[0],
               {"1 nodes lie on another node (node 13 on node 2 first)", "Coherence Mesh"});
}

TEST_F(MeshFiles, PutUngroupedSolidsIntoTheDefaultRegion) {
  WrittenMesh mesh = house();
  mesh.elements[2].group = "";
  const MeshFile read = read_mesh_file(write(mesh));
  EXPECT_EQ(std::set<std::string>(read.mesh.region_names.begin(), read.mesh.region_names.end()),
            (std::set<std::string>{"house", "roof", "default"}));
}

TEST_F(MeshFiles, RefuseAnInvertedElement) {
  WrittenMesh mesh = house();
  mesh.elements[3].nodes.push_back({5, 4, 11, 8});
  expect_error(mesh, {"mesh.msh: element 5 (tet4, nodes 6 5 12 9)", "inverted"});
}

TEST_F(MeshFiles, RefuseADegenerateElement) {
  WrittenMesh mesh = house();
  mesh.elements[3].nodes.push_back({0, 1, 2, 3});
  expect_error(mesh, {"mesh.msh: element 5 (tet4, nodes 1 2 3 4)", "degenerate"});
}

TEST_F(MeshFiles, RefuseAnElementWithANodeTwice) {
  WrittenMesh mesh = house();
  for (auto& elements : mesh.elements) {
    if (elements.nodes[0].size() == 8) elements.nodes[0][7] = elements.nodes[0][6];
  }
  expect_error(mesh, {"mesh.msh: element ", "(hexa8) has the node ", " twice", "degenerate"});
}

TEST_F(MeshFiles, RefuseTheSameElementTwice) {
  WrittenMesh mesh = house();
  mesh.elements.push_back({4, {{4, 11, 5, 10}}, "house"});
  expect_error(mesh, {"mesh.msh: elements 4 and 10 have the same nodes"});
}

TEST_F(MeshFiles, RefuseElementsThatOverlap) {
  WrittenMesh mesh = house();
  mesh.coordinates.insert(mesh.coordinates.end(), {.5, .5, 3});
  mesh.elements[2].nodes.push_back({4, 5, 6, 7, 12});
  expect_error(mesh, {"belongs to more than two elements", "overlap"});
}

TEST_F(MeshFiles, RefuseElementsWithNodesInsideOfFaces) {
  WrittenMesh mesh = house();
  std::vector<int> nodes(27);
  for (int a = 0; a < 27; ++a) nodes[static_cast<std::size_t>(a)] = a % 12;
  mesh.elements.push_back({12, {nodes}, "house"});
  expect_error(mesh, {"mesh.msh: ", "1 of type 'Hexahedron 27'", "tet4", "first order",
                      "SecondOrderIncomplete"});
}

/// Nodes of quadratic elements that are not in the middle between the ends of their edges.
std::size_t misplaced_nodes(const Mesh& mesh) {
  std::size_t misplaced = 0;
  for (const ElementBlock& block : mesh.blocks) {
    const ElementTopology& topology = element_topology(block.element);
    for (std::size_t e = 0; e < block.num_elements(); ++e) {
      const std::vector<double> x = positions_of(mesh, block, e);
      for (std::size_t k = 0; k < topology.edges.size(); ++k) {
        const auto node = static_cast<std::size_t>(topology.num_corners()) + k;
        const auto a = static_cast<std::size_t>(topology.edges[k][0]);
        const auto b = static_cast<std::size_t>(topology.edges[k][1]);
        for (std::size_t i = 0; i < 3; ++i) {
          const double middle = (x[3 * a + i] + x[3 * b + i]) / 2;
          // Gmsh divides lines to 1e-12 only.
          if (std::abs(x[3 * node + i] - middle) > 1e-9) ++misplaced;
        }
      }
    }
  }
  return misplaced;
}

// What gmsh itself takes for the middle of which edge.
TEST_F(MeshFiles, HaveTheNodesOfQuadraticElementsWhereGmshPutsThem) {
  for (const bool hexahedra : {false, true}) {
    const char* element = hexahedra ? "hexa20" : "tet10";
    SCOPED_TRACE(element);
    const char* name = hexahedra ? "quadratic_hexahedra.msh" : "quadratic_tetrahedra.msh";
    const MeshFile read =
        read_mesh_file(std::filesystem::path(ELASTOGEN_TEST_DATA) / "meshes" / name);
    EXPECT_TRUE(read.notes.empty()) << ::testing::PrintToString(read.notes);
    ASSERT_EQ(read.mesh.blocks.size(), 1U);
    EXPECT_EQ(read.mesh.blocks[0].element, element);
    EXPECT_EQ(misplaced_nodes(read.mesh), 0U);
    double volume = 0;
    for (std::size_t e = 0; e < read.mesh.num_elements(); ++e) {
      volume += volume_by_faces(read.mesh.positions, read.mesh.blocks[0].element_nodes(e), element);
    }
    EXPECT_NEAR(volume, 1, 1e-9);
    // The boundary is made of faces of the elements.
    ASSERT_EQ(read.boundaries.size(), 1U);
    std::set<std::set<std::int32_t>> faces;
    const FaceMatching matching = match_faces(read.mesh);
    for (const MeshFace& face : matching.boundary) {
      faces.emplace(face.nodes.begin(), face.nodes.end());
    }
    EXPECT_EQ(surface_faces(matching).size(), matching.boundary.size());
    EXPECT_GE(read.boundaries[0].faces.size(), 1U);
    for (const auto& face : read.boundaries[0].faces) {
      EXPECT_TRUE(faces.contains({face.begin(), face.end()}));
      EXPECT_EQ(face.size(), hexahedra ? 8U : 6U);
    }
  }
}

TEST_F(MeshFiles, HaveQuadraticElementsInEveryFormatThatHoldsThem) {
  for (const GmshElement& element : gmsh_elements()) {
    const std::string name(element.element);
    if (!element_topology(name).is_quadratic()) continue;
    const WrittenMesh written = {reference_nodes(name),
                                 {{element.type, {in_gmsh_order(element)}, "body"}}};
    for (const FormatCase& format : all_formats) {
      SCOPED_TRACE(name + " in " + format.file);
      if (format.format == MeshFormat::mesh) continue;  // gmsh writes it with elements' corners
      write_with_gmsh(written, format.format, file(format.file));
      const MeshFile read = read_mesh_file(file(format.file));
      EXPECT_TRUE(read.notes.empty()) << ::testing::PrintToString(read.notes);
      EXPECT_EQ(read.mesh.blocks[0].element, name);
      EXPECT_EQ(positions_of(read.mesh, read.mesh.blocks[0], 0), written.coordinates);
    }
  }
}

// A linear hexahedron beside a quadratic one: the file is right, but they do not fit together.
TEST_F(MeshFiles, MayMixLinearAndQuadraticElements) {
  WrittenMesh mesh = {reference_nodes("hexa20"), {}};
  mesh.coordinates.insert(mesh.coordinates.end(), {3, -1, -1, 3, 1, -1, 3, -1, 1, 3, 1, 1});
  const GmshElement& hexa20 = *find_gmsh_element(17);
  mesh.elements = {{17, {in_gmsh_order(hexa20)}, "body"},
                   {5, {{1, 20, 21, 2, 5, 22, 23, 6}}, "body"}};
  const MeshFile read = read_mesh_file(write(mesh));
  EXPECT_EQ(read.mesh.num_elements(), 2U);
  const FaceMatching matching = match_faces(read.mesh);
  EXPECT_EQ(matching.boundary.size(), 12U);
  EXPECT_EQ(matching.unequal.size(), 2U);
  EXPECT_EQ(surface_faces(matching).size(), 10U);
}

/// A tetrahedron in two groups.
const std::string two_levels = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
3 1 "all"
3 2 "part"
$EndPhysicalNames
$Entities
0 0 0 1
1 0 0 0 1 1 1 2 1 2 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
1 1 1 1
3 1 4 1
1 1 2 3 4
$EndElements
)";

TEST_F(MeshFiles, TakeOfSeveralGroupsTheOneThatTheSceneNames) {
  const auto file = write("two.msh", two_levels);
  for (const char* name : {"all", "part"}) {
    EXPECT_EQ(read_mesh_file(file, {{name, "other"}, ""}).mesh.region_names,
              std::vector<std::string>{name});
  }
  expect_words(error_of_file(file), {"two.msh: element 1 is in the groups 'all' and 'part'",
                                     "of which the scene names none"});
  expect_words(error_of_file(file, {{"part", "all"}, ""}),
               {"two.msh: element 1 is in the groups 'all' and 'part'",
                "of which the scene names more than one"});
}

// Where elements are in several groups, msh 2 lists them once for each.
TEST_F(MeshFiles, TakeAnElementOnceThatMsh2Repeats) {
  const std::string text = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
3 1 "all"
3 2 "part"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 2 1 1 2 3 4
$EndElements
)";
  const MeshFile read = read_mesh_file(write("two.msh", text), {{"part"}, ""});
  EXPECT_EQ(read.mesh.num_elements(), 1U);
  EXPECT_EQ(read.mesh.region_names, std::vector<std::string>{"part"});
}

TEST_F(MeshFiles, SayWhatToDoWithFilesThatHoldNoMesh) {
  expect_words(error_of_file(write("part.stl", "solid\n")),
               {"part.stl", "only the surface", "Surface Loop(1) = Surface{:}; Volume(1) = {1};",
                "gmsh -3 part.geo -o part.msh"});
  expect_words(error_of_file(write("part.STEP", "")), {"gmsh -3 part.STEP -o part.msh"});
  expect_words(error_of_file(write("part.med", "")), {"meshio convert part.med part.vtu"});
}

TEST_F(MeshFiles, MayHaveTheirExtensionInCapitals) {
  const MeshFile upper =
      read_mesh_file(write("HOUSE.MESH", read_text_file(std::filesystem::path(ELASTOGEN_TEST_DATA) /
                                                            "meshes" / "house.mesh",
                                                        "mesh")));
  EXPECT_EQ(upper.mesh.region_names.size(), 2U);
  EXPECT_EQ(upper.boundaries.size(), 2U);
}

TEST_F(MeshFiles, RefuseABodyOfLines) {
  expect_error({{0, 0, 0, 1, 0, 0}, {{1, {{0, 1}}, ""}}}, {"it has only lines"});
}

TEST_F(MeshFiles, RefuseASurfaceInSpace) {
  expect_error({{0, 0, 0, 1, 0, 0, 0, 1, 1}, {{2, {{0, 1, 2}}, ""}}},
               {"no solid elements", "z goes from 0 to 1", "Physical Volume"});
}

TEST_F(MeshFiles, RefuseAFileWithoutElements) {
  expect_words(error_of_file(write("empty.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")),
               {"empty.msh", "no elements"});
}

TEST_F(MeshFiles, RefuseWhatIsNoMesh) {
  expect_words(error_of_file(write("text.msh", "not a mesh\n")), {"text.msh: gmsh cannot read it"});
  expect_words(error_of_file(file("none.msh")), {"none.msh: there is no such file"});
  expect_words(error_of_file(write("mesh.mhs", "")), {"'.mhs'", "did you mean '.msh'"});
}

TEST_F(MeshFiles, ReportACrashOfGmsh) {
  // A group with an element that is not there: gmsh 4.8 crashes on it.
  WrittenMesh mesh = house_for(MeshFormat::unv);
  mesh.elements.push_back({15, {{11}}, "tip"});
  write_with_gmsh(mesh, MeshFormat::unv, file("crash.unv"));
  expect_words(error_of_file(file("crash.unv")), {"crash.unv: gmsh crashed while reading it"});
}

TEST_F(MeshFiles, SurviveRandomDamage) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 generator(seed);
  const std::string whole = read_text_file(write(house()), "mesh");
  for (int i = 0; i < 20; ++i) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k) {
      text[generator() % text.size()] = static_cast<char>(generator() % 128);
    }
    try {
      EXPECT_LE(read_mesh_file(write("damaged.msh", text)).mesh.num_elements(), 4U);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("damaged.msh"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace elastogen::selector
