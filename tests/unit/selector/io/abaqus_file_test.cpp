// Meshes from decks of Abaqus and CalculiX.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../scene/temporary_scene.h"
#include "mesh_file_errors.h"
#include "selector/bench/calculix.h"
#include "selector/io/abaqus_elements.h"
#include "selector/io/element_topology.h"
#include "selector/io/mesh_file.h"
#include "selector/scene/scene_mesh.h"

namespace elastogen::selector {
namespace {

/// Two cubes along x, with everything that users write in sets.
const std::string two_cubes = R"(*HEADING
two cubes
** a comment
*Node, nset=ALL
11, 0.,0.,0.
12, 1.D0, 0, 0
13, 1, 1., 0
14, ,1.
21, +0,0,1e0
22, 1,0,1
23, 1,1,1
24, 0,1,1
31, 2,0,0
32, 2,1,0
33, 2,0,1
34, 2,1,1
99, 5,5,5
*ELEMENT, type=c3d8r,
  ELSET=Soft
101, 11,12,13,14,21,
22,23,24
*element, TYPE=C3D8I, elset = Hard
201, 12,31,32,13,22
33,34,23
*ELSET, ELSET=both, GENERATE
1, 1000, 100
101, 201, 100
*Elset, elset=nested
BOTH
*NSET, NSET=x0, GENERATE
11, 24, 10
*NSET, NSET=left
X0, 14
24,
*SURFACE, NAME=Top, TYPE=ELEMENT
both, S2
*SURFACE, NAME=End
201, s4
*SURFACE, NAME=corner, TYPE=NODE
34
*MATERIAL, NAME=steel
*ELASTIC
210e9, 0.3
*STEP
*BOUNDARY
left, 1, 3
*END STEP
)";

class Deck : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const {
    return write_file(folder_, "deck.inp", text);
  }
  /// That the text with one piece replaced is refused.
  void expect_error(const std::string& piece, const std::string& by,
                    const std::vector<std::string>& words) const {
    SCOPED_TRACE(by);
    expect_words(error_of_file(write(replaced(two_cubes, piece, by)), named_), words);
  }

  TemporaryFolder folder_;
  const MeshFileOptions named_{{"Soft", "Hard"}, ""};
};

TEST_F(Deck, GivesNodesElementsAndSets) {
  const MeshFile read = read_mesh_file(write(two_cubes), named_);
  EXPECT_EQ(read.mesh.num_nodes(), 12U);
  EXPECT_EQ(read.mesh.region_names, (std::vector<std::string>{"Soft", "Hard"}));
  EXPECT_EQ(read.mesh.numbers->elements, (std::vector<std::uint64_t>{101, 201}));
  EXPECT_EQ(read.mesh.node_number(4), 21U);
  EXPECT_EQ(read.mesh.positions[3], 1);
  std::map<std::string, std::pair<std::size_t, std::size_t>> boundaries;
  for (const MeshBoundary& boundary : read.boundaries) {
    boundaries[boundary.name] = {boundary.nodes.size(), boundary.faces.size()};
  }
  using Boundaries = std::map<std::string, std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(boundaries, (Boundaries{{"ALL", {12, 0}},
                                    {"x0", {2, 0}},
                                    {"left", {4, 0}},
                                    {"Top", {6, 2}},
                                    {"End", {4, 1}},
                                    {"corner", {1, 0}}}));
  for (const MeshBoundary& boundary : read.boundaries) {
    if (boundary.name != "Top") continue;
    for (const std::int32_t node : boundary.nodes) {
      EXPECT_EQ(read.mesh.positions[3 * static_cast<std::size_t>(node) + 2], 1);
    }
  }
  // The node 99 is of no element, and the set ALL loses it; materials and steps are left out.
  ASSERT_EQ(read.notes.size(), 3U) << ::testing::PrintToString(read.notes);
  expect_words(read.notes[0], {"deck.inp: only the mesh is read", "*MATERIAL, *STEP, *BOUNDARY"});
}

TEST_F(Deck, GivesTheRegionsThatTheSceneNames) {
  for (const char* name : {"both", "nested"}) {
    EXPECT_EQ(read_mesh_file(write(two_cubes), {{name}, ""}).mesh.region_names,
              std::vector<std::string>{name});
  }
  expect_words(error_of_file(write(two_cubes)),
               {"deck.inp: element 101 is in the groups 'Soft' and 'both' and 'nested'"});
  expect_words(error_of_file(write(two_cubes), {{"Hard", "both"}, ""}),
               {"element 201 is in the groups 'Hard' and 'both'", "more than one"});
}

TEST_F(Deck, IncludesOthers) {
  const std::size_t from = two_cubes.find("11, 0."), to = two_cubes.find("*ELEMENT");
  (void)write_file(folder_, "nodes.txt", two_cubes.substr(from, to - from));
  const std::string main =
      replaced(two_cubes, two_cubes.substr(from, to - from), "*INCLUDE, INPUT=nodes.txt\n");
  EXPECT_EQ(read_mesh_file(write(main), named_).mesh.num_nodes(), 12U);
  expect_words(error_of_file(write(replaced(main, "nodes.txt", "none.txt"))),
               {"deck.inp:5: *INCLUDE: there is no file", "none.txt"});
  expect_words(error_of_file(write(replaced(main, "nodes.txt", "deck.inp"))), {"includes itself"});
}

TEST_F(Deck, IsRefusedWithTheLineAndWhatIsWrong) {
  expect_error("12, 1.D0, 0, 0", "12, 1.X, 0, 0", {"deck.inp:6: '1.X' must be a number"});
  expect_error("13, 1, 1., 0", "12, 1, 1., 0", {"deck.inp:7: node 12 has other coordinates"});
  expect_error("22,23,24\n", "22,23\n",
               {"deck.inp:20: element 101 (C3D8R) has 7 nodes, must have 8"});
  expect_error("201, 12,31", "101, 12,31", {"deck.inp:23: element 101 is there already: line 20"});
  expect_error("201, 12,31", "201, 12,77",
               {"deck.inp:23: element 201 has the node 77, which the deck does not define"});
  expect_error("c3d8r", "SPRINGA",
               {"deck.inp:18: elements of type SPRINGA are not known", "C3D20"});
  expect_error("BOTH\n", "BOTHH\n", {"deck.inp:29: there is no *ELSET 'BOTHH'"});
  expect_error("BOTH\n", "NESTED\n", {"*ELSET 'nested' has itself among its members"});
  expect_error("X0, 14", "X0, 15", {"deck.inp:33: *NSET 'left' has the node 15"});
  expect_error("201, s4", "201, s7",
               {"deck.inp:38: 'S7' is no face of element 201 (C3D8I)", "S1 to S6"});
  expect_error("201, s4", "201", {"deck.inp:38: *SURFACE 'End': needs lines of an element"});
  expect_error("NAME=Top", "NAME=left", {"*NSET and the *SURFACE 'left' have different nodes"});
  expect_error("*STEP", "*INSTANCE, NAME=a", {"deck.inp:44: *INSTANCE: ", "Edit Attributes"});
  expect_error("*STEP", "*NGEN", {"deck.inp:44: *NGEN makes or moves nodes", "write all"});
  expect_error("*Node, nset", "*Node, SYSTEM=C, nset", {"coordinates must be rectangular"});
  expect_error("*HEADING\n", "", {"deck.inp:1: data before the first keyword"});
}

TEST_F(Deck, NamesOnceWhatItLeavesOut) {
  const MeshFile read = read_mesh_file(
      write(replaced(two_cubes, "*STEP\n",
                     "*Kinematic Coupling, REF NODE=34\nleft, 1\n*EMBEDDED ELEMENT\nSoft\n"
                     "*CONTACT\n*PRE-TENSION SECTION\n*KINEMATIC COUPLING\n*EXPANSION\n1e-5\n"
                     "*STEP\n*STATIC\n*NODE FILE\nU\n*EL PRINT\nS\n*OUTPUT, FIELD\n")),
      named_);
  ASSERT_EQ(read.notes.size(), 3U) << ::testing::PrintToString(read.notes);
  EXPECT_EQ(read.notes[0],
            "deck.inp: only the mesh is read; left out were *MATERIAL, *KINEMATIC COUPLING, "
            "*EMBEDDED ELEMENT, *CONTACT, *PRE-TENSION SECTION, *STEP, *BOUNDARY");
}

TEST_F(Deck, MayHaveQuotedLabels) {
  std::string text = replaced(two_cubes, "elset=nested\nBOTH\n",
                              "elset=\"one, two\"\n\"Both\"\n*ELSET, ELSET=\"7\"\n201\n");
  text = replaced(text, "both, S2", "\"one, two\", S2");
  text = replaced(text, "201, s4", "\"7\", s4");
  const MeshFile read = read_mesh_file(write(text), named_);
  std::map<std::string, std::size_t> faces;
  for (const MeshBoundary& boundary : read.boundaries) {
    faces[boundary.name] = boundary.faces.size();
  }
  EXPECT_EQ(faces["Top"], 2U);
  EXPECT_EQ(faces["End"], 1U);
  EXPECT_EQ(read_mesh_file(write(text), {{"one, two"}, ""}).mesh.region_names,
            std::vector<std::string>{"one, two"});
  // A quote alone is a character.
  expect_words(error_of_file(write(replaced(text, "\"one, two\", S2", "\"one, two, S2"))),
               {"needs lines of an element"});
}

TEST_F(Deck, RefusesAnEmptyNodeSetWithTheNameOfASurface) {
  expect_error("*MATERIAL", "*NSET, NSET=TOP\n*MATERIAL",
               {"deck.inp:41: the *NSET and the *SURFACE 'TOP' have different nodes"});
}

/// The cubes with a shell on the first.
std::string with_shell(const std::string& more) {
  return replaced(two_cubes, "*MATERIAL",
                  "*ELEMENT, TYPE=S4, ELSET=lid\n302, 21,22,23,24\n" + more + "*MATERIAL");
}

TEST_F(Deck, RefusesAnElementSetWithTheNameOfAnotherBoundary) {
  const std::string elements = "the elements of lower dimension in the *ELSET 'LID' have different";
  expect_words(error_of_file(write(with_shell("*NSET, NSET=LID\n21, 22\n")), named_),
               {"deck.inp:43: the *NSET and " + elements, "rename one"});
  expect_words(error_of_file(write(with_shell("*SURFACE, NAME=LID\n201, S2\n")), named_),
               {"deck.inp:43: the *SURFACE and " + elements, "rename one"});
  // Of the same nodes they are one.
  for (const char* same : {"*NSET, NSET=lid, ELSET=lid\n", "*SURFACE, NAME=lid\n101, S2\n", ""}) {
    SCOPED_TRACE(same);
    const MeshFile read = read_mesh_file(write(with_shell(same)), named_);
    const auto is_lid = [](const MeshBoundary& boundary) { return boundary.name == "lid"; };
    ASSERT_EQ(std::count_if(read.boundaries.begin(), read.boundaries.end(), is_lid), 1);
    const auto lid = std::find_if(read.boundaries.begin(), read.boundaries.end(), is_lid);
    EXPECT_EQ(lid->nodes.size(), 4U);
  }
  // A set of solids is a region, and may have the name of a boundary.
  EXPECT_EQ(error_of_file(write(with_shell("*NSET, NSET=Soft\n21, 22\n")), named_), "");
}

TEST_F(Deck, MayBePlane) {
  const MeshFile read = read_mesh_file(
      write("*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPS4,ELSET=plate\n7,1,2,3,4\n"
            "*SURFACE,NAME=right\nplate,S2\n"));
  EXPECT_EQ(read.mesh.dim, 2);
  ASSERT_EQ(read.boundaries.size(), 1U);
  EXPECT_EQ(read.boundaries[0].faces, (std::vector<std::vector<std::int32_t>>{{1, 2}}));
  ASSERT_EQ(read.notes.size(), 1U);
  expect_words(read.notes[0], {"plane stress", "plane strain"});
}

TEST_F(Deck, RefusesQuadraticPrismsByName) {
  std::string text = "*NODE\n";
  for (int i = 1; i <= 15; ++i) text += fmt::format("{},{},{},{}\n", i, i % 2, i % 3, i % 5);
  text += "*ELEMENT,TYPE=C3D15\n1,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n";
  const std::string message = error_of_file(write(text));
  expect_words(message, {"1 of type 'C3D15'", "prism6", "first order, or C3D10 or C3D20"});
  EXPECT_EQ(message.find("gmsh"), std::string::npos) << message;
}

TEST_F(Deck, SaysOfWhichFamiliesNothingIsComputed) {
  for (const char* type : {"CAX4", "S4R", "M3D4"}) {
    SCOPED_TRACE(type);
    const std::string message = error_of_file(write(
        fmt::format("*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE={}\n7,1,2,3,4\n", type)));
    expect_words(message, {fmt::format("1 of type '{}'", type),
                           "shells, membranes, beams and axisymmetric elements are not computed; "
                           "use solid (C3D) or plane (CPE, CPS) elements"});
    EXPECT_EQ(message.find("order"), std::string::npos) << message;
  }
}

/// What `bench` writes for CalculiX, whose results agree with ours.
TEST_F(Deck, IsReadAsItIsWrittenForCalculix) {
  for (const auto& [association, type] :
       {std::pair("tet4-q1", "C3D4"), std::pair("prism6-q6", "C3D6"),
        std::pair("hexa8-q8", "C3D8I"), std::pair("tet10-q4", "C3D10"),
        std::pair("hexa20-q8", "C3D20R")}) {
    SCOPED_TRACE(type);
    const Mesh mesh = make_mesh(read_text(replaced(good_scene, "hexa8-q8", association))).mesh;
    CalculixProblem problem;
    problem.mesh = &mesh;
    problem.element_type = type;
    problem.prescribed = {{}};
    const MeshFile read = read_mesh_file(write(calculix_deck(problem)));
    EXPECT_EQ(read.mesh.region_names, std::vector<std::string>{"EALL"});
    EXPECT_EQ(read.mesh.positions, mesh.positions);
    ASSERT_EQ(read.mesh.blocks.size(), 1U);
    EXPECT_EQ(read.mesh.blocks[0].element, mesh.blocks[0].element);
    EXPECT_EQ(read.mesh.blocks[0].nodes, mesh.blocks[0].nodes);
  }
}

TEST(AbaqusElements, HaveEveryFaceOnce) {
  for (const ElementTopology& topology : element_topologies()) {
    SCOPED_TRACE(topology.element);
    auto faces = abaqus_faces(topology.element), expected = topology.faces;
    std::sort(faces.begin(), faces.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(faces, expected);
  }
}

}  // namespace
}  // namespace elastogen::selector
