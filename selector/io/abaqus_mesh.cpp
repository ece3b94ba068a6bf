#include "selector/io/abaqus_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "selector/io/abaqus_deck.h"
#include "selector/io/abaqus_elements.h"
#include "selector/io/abaqus_keywords.h"
#include "selector/io/abaqus_sets.h"

namespace elastogen::selector {
namespace {

struct ElementType {
  std::string name;
  AbaqusElement element;
};

struct DeckElement {
  std::size_t type = 0;
  std::vector<std::uint64_t> nodes;
  std::vector<std::int32_t> sets;  ///< indices into the groups of its dimension
  DeckPlace place;
};

using Elements = std::map<std::uint64_t, DeckElement>;
using Nodes = std::map<std::uint64_t, std::array<double, 3>>;
using NodesOfNames = std::map<std::string, std::set<std::uint64_t>>;  // by name in capitals

class DeckMeshReader {
 public:
  RawMesh read(const AbaqusDeck& deck) {
    for (const DeckCard& card : deck.cards) take(card);
    for (const auto& [number, at] : nodes_) {
      mesh_.node_numbers.push_back(number);
      mesh_.coordinates.insert(mesh_.coordinates.end(), at.begin(), at.end());
    }
    for (const auto& [number, element] : elements_) element_numbers_.push_back(number);
    add_element_sets();
    add_elements();
    collect_set_boundaries();
    add_surfaces();
    add_node_sets();
    add_notes();
    return std::move(mesh_);
  }

 private:
  void take(const DeckCard& card) {
    const std::string& keyword = card.keyword;
    if (keyword == "NODE") {
      take_nodes(card);
    } else if (keyword == "ELEMENT") {
      take_elements(card);
    } else if (keyword == "NSET") {
      node_sets_.take(card);
    } else if (keyword == "ELSET") {
      element_sets_.take(card);
    } else if (keyword == "SURFACE") {
      surfaces_.push_back(&card);
    } else if (keyword == "PART" || keyword == "INSTANCE" || keyword == "ASSEMBLY") {
      card.place.fail(fmt::format(
          "*{}: decks of parts and instances are not read: write a flat one (Abaqus/CAE: Model, "
          "Edit Attributes, 'Do not use parts and assemblies in input files')",
          keyword));
    } else if (keyword == "NGEN" || keyword == "NFILL" || keyword == "NCOPY" || keyword == "NMAP" ||
               keyword == "ELGEN" || keyword == "ELCOPY" || keyword == "SYSTEM") {
      card.place.fail(fmt::format(
          "*{} makes or moves nodes or elements by rule, which is not read: write all nodes and "
          "elements out",
          keyword));
    } else if (!is_left_out_silently(keyword) &&
               std::find(left_out_.begin(), left_out_.end(), keyword) == left_out_.end()) {
      left_out_.push_back(keyword);
    }
  }

  static void refuse_input(const DeckCard& card) {
    if (card.find("INPUT") == nullptr) return;
    card.place.fail(
        fmt::format("*{}: INPUT= is not read: take *INCLUDE after the card", card.keyword));
  }

  void take_nodes(const DeckCard& card) {
    refuse_input(card);
    if (const std::string* system = card.find("SYSTEM"); system && in_capitals(*system) != "R") {
      card.place.fail("*NODE: coordinates must be rectangular (SYSTEM=R)");
    }
    for (const DeckLine& line : card.lines) {
      const auto fields = line.fields();
      const std::uint64_t number = line.integer(fields.empty() ? "" : fields.front());
      std::array<double, 3> at{};
      for (std::size_t c = 0; c < 3 && c + 1 < fields.size(); ++c) at[c] = line.real(fields[c + 1]);
      const auto [entry, is_new] = nodes_.emplace(number, at);
      if (!is_new && entry->second != at) {
        line.place.fail(fmt::format("node {} has other coordinates already", number));
      }
      node_sets_.add(card, number, line.place);
    }
  }

  void take_elements(const DeckCard& card) {
    refuse_input(card);
    const std::string name = in_capitals(card.get("TYPE"));
    const std::optional<AbaqusElement> type = find_abaqus_element(name);
    if (!type) {
      card.place.fail(fmt::format(
          "elements of type {} are not known: C3D4, C3D5, C3D6, C3D8, C3D10, C3D20, CPE3, CPE4, "
          "CPS3, CPS4 can be computed, others of lower dimension are taken as boundaries; remove "
          "these from the deck",
          name));
    }
    types_.push_back({name, *type});
    const auto wanted = static_cast<std::size_t>(type->num_nodes);
    std::vector<std::uint64_t> numbers;  // of one element, which may take several lines
    DeckPlace place;
    const auto fail = [&] {
      place.fail(fmt::format("element {} ({}) has {} nodes, must have {}", numbers.front(), name,
                             numbers.size() - 1, wanted));
    };
    for (const DeckLine& line : card.lines) {
      if (numbers.empty()) place = line.place;
      for (const std::string_view field : line.fields()) numbers.push_back(line.integer(field));
      if (numbers.size() <= wanted) continue;
      if (numbers.size() > wanted + 1) fail();
      add_element(numbers, place);
      element_sets_.add(card, numbers[0], place);
      numbers.clear();
    }
    if (!numbers.empty()) fail();
  }

  void add_element(const std::vector<std::uint64_t>& numbers, const DeckPlace& place) {
    const auto [entry, is_new] = elements_.emplace(
        numbers[0],
        DeckElement{types_.size() - 1, {numbers.begin() + 1, numbers.end()}, {}, place});
    if (!is_new) {
      place.fail(fmt::format("element {} is there already: line {} of {}", numbers[0],
                             entry->second.place.line,
                             entry->second.place.file->filename().string()));
    }
  }

  [[nodiscard]] std::set<std::uint64_t> elements_of(const DeckSet& set) const {
    return element_sets_.numbers_of(set, element_numbers_);
  }
  [[nodiscard]] std::set<std::uint64_t> nodes_of(const DeckSet& set) const {
    return node_sets_.numbers_of(set, mesh_.node_numbers, [this](const SetMember& member) {
      std::set<std::uint64_t> numbers;
      for (const std::uint64_t element :
           elements_of(element_sets_.find(member.set, member.place))) {
        const std::vector<std::uint64_t>& nodes = elements_.at(element).nodes;
        numbers.insert(nodes.begin(), nodes.end());
      }
      return numbers;
    });
  }

  std::int32_t add_group(int dim, const std::string& name) {
    mesh_.groups.push_back({dim, static_cast<std::int32_t>(mesh_.groups.size()), name});
    return mesh_.groups.back().number;
  }

  void add_element_sets() {
    for (const DeckSet& set : element_sets_.all()) {
      std::map<int, std::int32_t> group_of_dim;
      for (const std::uint64_t number : elements_of(set)) {
        if (set.internal) continue;
        DeckElement& element = elements_.at(number);
        const int dim = types_[element.type].element.dim;
        if (!group_of_dim.contains(dim)) group_of_dim[dim] = add_group(dim, set.name);
        element.sets.push_back(group_of_dim.at(dim));
      }
    }
  }

  void add_elements() {
    std::map<std::pair<std::string, std::vector<std::int32_t>>, std::size_t> list_of;
    for (const auto& [number, element] : elements_) {
      for (const std::uint64_t node : element.nodes) {
        if (!nodes_.contains(node)) {
          element.place.fail(fmt::format(
              "element {} has the node {}, which the deck does not define", number, node));
        }
      }
      const ElementType& type = types_[element.type];
      body_dim_ = std::max(body_dim_, type.element.dim);
      const auto [entry, is_new] =
          list_of.emplace(std::pair(type.name, element.sets), mesh_.elements.size());
      if (is_new) {
        mesh_.elements.push_back({type.element.dim,
                                  std::string(type.element.element),
                                  type.name,
                                  type.element.num_nodes,
                                  {},
                                  {},
                                  element.sets});
      }
      RawElements& list = mesh_.elements[entry->second];
      list.numbers.push_back(number);
      list.nodes.insert(list.nodes.end(), element.nodes.begin(), element.nodes.end());
    }
  }

  /// Elements of lower dimension are boundaries under the names of their sets.
  void collect_set_boundaries() {
    for (const auto& [number, element] : elements_) {
      if (types_[element.type].element.dim == body_dim_) continue;
      for (const std::int32_t group : element.sets) {
        const std::string& name = mesh_.groups[static_cast<std::size_t>(group)].name;
        set_nodes_[in_capitals(name)].insert(element.nodes.begin(), element.nodes.end());
      }
    }
  }

  /// Whether others have a boundary of this name, which then must have the same nodes: the two are
  /// one for the scene.
  static bool is_among(const NodesOfNames& others, std::string_view other, std::string_view keyword,
                       const std::string& name, const std::set<std::uint64_t>& nodes,
                       const DeckPlace& place) {
    const auto found = others.find(in_capitals(name));
    if (found == others.end()) return false;
    if (found->second != nodes) {
      place.fail(fmt::format(
          "the *{} and the {} '{}' have different nodes, and both are the boundary of this name: "
          "rename one",
          keyword, other, name));
    }
    return true;
  }

  /// Nodes of the face of an element that a label names.
  std::vector<std::uint64_t> face_of(std::uint64_t number, std::string_view label,
                                     const DeckPlace& place) const {
    const DeckElement& element = elements_.at(number);
    const ElementType& type = types_[element.type];
    if (type.element.element.empty() || type.element.dim != body_dim_) {
      place.fail(
          fmt::format("element {} ({}): only faces of solids, or of plane elements without "
                      "solids, can be in a surface",
                      number, type.name));
    }
    const auto faces = abaqus_faces(type.element.element);
    const bool is_known = label.size() == 2 && label[0] == 'S' && label[1] > '0' &&
                          static_cast<std::size_t>(label[1] - '0') <= faces.size();
    if (!is_known) {
      place.fail(fmt::format("'{}' is no face of element {} ({}): it has S1 to S{}", label, number,
                             type.name, faces.size()));
    }
    std::vector<std::uint64_t> nodes;
    for (const int local : faces[static_cast<std::size_t>(label[1] - '1')]) {
      nodes.push_back(element.nodes[static_cast<std::size_t>(local)]);
    }
    return nodes;
  }

  void add_surfaces() {
    for (const DeckCard* card : surfaces_) {
      const std::string& name = card->get("NAME");
      const std::string* given = card->find("TYPE");
      const std::string type = given ? in_capitals(*given) : "ELEMENT";
      if (card->find("COMBINE") || (type != "ELEMENT" && type != "NODE")) {
        card->place.fail(fmt::format(
            "*SURFACE '{}': it must list faces of elements (TYPE=ELEMENT) or nodes (TYPE=NODE)",
            name));
      }
      for (const DeckLine& line : card->lines) {
        const auto fields = line.fields();
        if (type == "NODE") {
          add_surface_nodes(name, line, fields.empty() ? "" : fields.front());
        } else if (fields.size() == 2) {
          add_surface_faces(name, line, fields[0], in_capitals(fields[1]));
        } else {
          line.place.fail(
              fmt::format("*SURFACE '{}': needs lines of an element or *ELSET and a "
                          "face, as  TOP, S2",
                          name));
        }
      }
    }
    for (const DeckCard* card : surfaces_) {
      const std::string& name = card->get("NAME");
      const auto nodes = surface_nodes_.find(in_capitals(name));
      if (nodes == surface_nodes_.end()) continue;
      (void)is_among(set_nodes_, set_boundary, "SURFACE", name, nodes->second, card->place);
    }
  }

  void add_surface_faces(const std::string& name, const DeckLine& line, std::string_view which,
                         const std::string& label) {
    std::set<std::uint64_t> numbers;
    if (is_number(which)) {
      numbers = {line.integer(which)};
      if (!elements_.contains(*numbers.begin())) {
        line.place.fail(
            fmt::format("*SURFACE '{}' has the element {}, which the deck does not "
                        "define",
                        name, which));
      }
    } else {
      numbers = elements_of(element_sets_.find(std::string(which), line.place));
    }
    for (const std::uint64_t number : numbers) {
      const std::vector<std::uint64_t> nodes = face_of(number, label, line.place);
      surface_nodes_[in_capitals(name)].insert(nodes.begin(), nodes.end());
      add_to_list(body_dim_ - 1, name, number, nodes);
    }
  }

  void add_surface_nodes(const std::string& name, const DeckLine& line, std::string_view which) {
    std::set<std::uint64_t> numbers;
    if (is_number(which)) {
      numbers = {line.integer(which)};
      if (!nodes_.contains(*numbers.begin())) {
        line.place.fail(fmt::format("*SURFACE '{}' has the node {}, which the deck does not define",
                                    name, which));
      }
    } else {
      numbers = nodes_of(node_sets_.find(std::string(which), line.place));
    }
    surface_nodes_[in_capitals(name)].insert(numbers.begin(), numbers.end());
    for (const std::uint64_t node : numbers) add_to_list(0, name, node, {node});
  }

  /// Adds a face or a point to the boundary of a name.
  void add_to_list(int dim, const std::string& name, std::uint64_t number,
                   const std::vector<std::uint64_t>& nodes) {
    const auto [entry, is_new] =
        boundary_lists_.emplace(std::pair(in_capitals(name), nodes.size()), mesh_.elements.size());
    if (is_new) {
      mesh_.elements.push_back({dim,
                                "",
                                dim == 0 ? "node" : "face",
                                static_cast<std::int32_t>(nodes.size()),
                                {},
                                {},
                                {add_group(dim, name)}});
    }
    RawElements& list = mesh_.elements[entry->second];
    list.numbers.push_back(number);
    list.nodes.insert(list.nodes.end(), nodes.begin(), nodes.end());
  }

  void add_node_sets() {
    for (const DeckSet& set : node_sets_.all()) {
      const std::set<std::uint64_t> numbers = nodes_of(set);
      if (set.internal) continue;
      const bool has_surface =
          is_among(surface_nodes_, "*SURFACE", "NSET", set.name, numbers, set.place);
      const bool has_elements =
          is_among(set_nodes_, set_boundary, "NSET", set.name, numbers, set.place);
      if (has_surface || has_elements) continue;
      for (const std::uint64_t node : numbers) add_to_list(0, set.name, node, {node});
    }
  }

  void add_notes() {
    if (!left_out_.empty()) {
      mesh_.notes.push_back(
          fmt::format("only the mesh is read; left out were *{}", fmt::join(left_out_, ", *")));
    }
    const bool is_plane_stress =
        body_dim_ == 2 && std::any_of(types_.begin(), types_.end(), [](const ElementType& type) {
          return type.name.starts_with("CPS");
        });
    if (is_plane_stress) {
      mesh_.notes.emplace_back(
          "elements CPS* are of plane stress; they are computed in plane strain");
    }
  }

  static constexpr std::string_view set_boundary = "elements of lower dimension in the *ELSET";

  RawMesh mesh_;
  Nodes nodes_;
  Elements elements_;
  std::vector<ElementType> types_;
  AbaqusSets node_sets_{"NSET"}, element_sets_{"ELSET"};
  std::vector<std::uint64_t> element_numbers_;
  std::vector<const DeckCard*> surfaces_;
  NodesOfNames set_nodes_, surface_nodes_;
  std::map<std::pair<std::string, std::size_t>, std::size_t> boundary_lists_;
  std::vector<std::string> left_out_;
  int body_dim_ = 0;
};

}  // namespace

RawMesh read_abaqus_mesh(const std::filesystem::path& file) {
  const AbaqusDeck deck = read_abaqus_deck(file);
  return DeckMeshReader().read(deck);
}

}  // namespace elastogen::selector
