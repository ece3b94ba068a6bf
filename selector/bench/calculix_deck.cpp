// CalculiX's input decks. Source of the keywords: G. Dhondt, CalculiX CrunchiX user's manual, 2.20.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

#include "runtime/error.h"
#include "selector/bench/calculix.h"

namespace elastogen::selector {
namespace {

/// Element types and the blocks that can be given to each. Local nodes need no renumbering: corners
/// of C3D6 are counter-clockwise seen from the other triangle's side, as ours; nodes of edges
/// follow as 01 12 20 03 13 23 (tetrahedra), 01 12 23 30 45 56 67 74 04 15 26 37 (hexahedra).
constexpr std::pair<const char*, const char*> element_types[] = {
    {"C3D4", "tet4"},     {"C3D6", "prism6"},  {"C3D8", "hexa8"},
    {"C3D8I", "hexa8"},   {"C3D8R", "hexa8"},  {"C3D10", "tet10"},
    {"C3D15", "prism15"}, {"C3D20", "hexa20"}, {"C3D20R", "hexa20"}};

constexpr std::size_t numbers_per_line = 10;  // CalculiX takes at most 16

const ElementBlock& block_of(const CalculixProblem& problem) {
  if (problem.mesh == nullptr || problem.mesh->dim != 3 || problem.mesh->blocks.size() != 1) {
    throw InternalError("a problem for CalculiX needs a mesh in space of one block of elements");
  }
  const ElementBlock& block = problem.mesh->blocks.front();
  for (const auto& [type, element] : element_types) {
    if (type == problem.element_type && element == block.element) return block;
  }
  throw InternalError(
      fmt::format("a block of {} cannot be CalculiX's {}", block.element, problem.element_type));
}

void check_values(const CalculixProblem& problem, const std::vector<NodalValue>& values) {
  for (const NodalValue& value : values) {
    if (value.node >= problem.mesh->num_nodes() || value.component < 0 || value.component > 2) {
      throw InternalError(fmt::format("a problem for CalculiX has no component {} of node {}",
                                      value.component, value.node));
    }
  }
}

class Deck {
 public:
  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
  }
  void nodes(const Mesh& mesh);
  void elements(const ElementBlock& block, const std::string& type);
  void step(const CalculixProblem& problem, std::size_t index);
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void Deck::nodes(const Mesh& mesh) {
  add("*NODE, NSET=NALL\n");
  for (std::size_t n = 0; n < mesh.num_nodes(); ++n) {
    add("{},{:.12g},{:.12g},{:.12g}\n", n + 1, mesh.positions[3 * n], mesh.positions[3 * n + 1],
        mesh.positions[3 * n + 2]);
  }
}

void Deck::elements(const ElementBlock& block, const std::string& type) {
  add("*ELEMENT, TYPE={}, ELSET=EALL\n", type);
  for (std::size_t e = 0; e < block.num_elements(); ++e) {
    add("{}", e + 1);
    std::size_t written = 1;
    for (const std::int32_t node : block.element_nodes(e)) {
      // A comma at the end of a line says that the element goes on.
      add("{}{}", written % numbers_per_line == 0 ? ",\n" : ",", node + 1);
      ++written;
    }
    add("\n");
  }
}

/// @param index  of the step; its end is at (index + 1) / number of steps of the loads
void Deck::step(const CalculixProblem& problem, std::size_t index) {
  const std::size_t num_steps = problem.prescribed.size();
  const double load = static_cast<double>(index + 1) / static_cast<double>(num_steps);
  const double increment = 1. / std::max(1, problem.increments);
  add("*STEP{}, INC=100000\n", problem.large_deformation ? ", NLGEOM" : "");
  add("*STATIC{}\n{:.12g}, 1., , {:.12g}\n",
      problem.equation_solver.empty() ? "" : ", SOLVER=" + problem.equation_solver, increment,
      increment);
  if (problem.tolerance > 0) {
    // The second figure is the largest correction over the largest increment of displacement.
    add("*CONTROLS, PARAMETERS=FIELD\n{:.12g}, {:.12g}\n", problem.tolerance, problem.tolerance);
  }
  check_values(problem, problem.prescribed[index]);
  if (!problem.prescribed[index].empty()) add("*BOUNDARY\n");
  for (const NodalValue& dof : problem.prescribed[index]) {
    add("{},{},{},{:.12g}\n", dof.node + 1, dof.component + 1, dof.component + 1, dof.value);
  }
  const auto& g = problem.gravity;
  const double magnitude = std::hypot(g[0], g[1], g[2]);
  if (magnitude > 0) {
    add("*DLOAD\nEALL, GRAV, {:.12g}, {:.12g}, {:.12g}, {:.12g}\n", load * magnitude,
        g[0] / magnitude, g[1] / magnitude, g[2] / magnitude);
  }
  if (!problem.forces.empty()) add("*CLOAD\n");
  for (const NodalValue& force : problem.forces) {
    add("{},{},{:.12g}\n", force.node + 1, force.component + 1, load * force.value);
  }
  if (index + 1 == num_steps) add("*NODE PRINT, NSET=NALL, FREQUENCY=100000\nU\n");
  add("*END STEP\n");
}

}  // namespace

std::string calculix_deck(const CalculixProblem& problem) {
  const ElementBlock& block = block_of(problem);
  if (problem.prescribed.empty()) throw InternalError("a problem for CalculiX needs a step");
  check_values(problem, problem.forces);
  Deck deck;
  deck.nodes(*problem.mesh);
  deck.elements(block, problem.element_type);
  deck.add("*MATERIAL, NAME=M\n*ELASTIC\n{:.12g}, {:.12g}\n", problem.young, problem.poisson);
  deck.add("*DENSITY\n{:.12g}\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n", problem.density);
  for (std::size_t index = 0; index < problem.prescribed.size(); ++index) deck.step(problem, index);
  return deck.take();
}

}  // namespace elastogen::selector
