#include "symgen/element/element.h"

#include <fmt/format.h>

#include "runtime/error.h"
#include "symgen/element/shapes.h"
#include "symgen/law/names.h"

namespace elastogen::symgen {
namespace {

const std::vector<Element>& elements() {
  static const std::vector<Element> all = {make_tri3(),  make_quad4(),  make_tet4(),
                                           make_hexa8(), make_prism6(), make_pyramid5(),
                                           make_tet10(), make_hexa20()};
  return all;
}

}  // namespace

void add_mid_edge_nodes(Element& element) {
  for (const auto& [a, b] : element.edges) {
    std::vector<GiNaC::ex> middle;
    for (std::size_t i = 0; i < element.coordinates.size(); ++i) {
      middle.push_back((element.nodes[a][i] + element.nodes[b][i]) / 2);
    }
    element.nodes.push_back(std::move(middle));
  }
}

std::vector<GiNaC::symbol> reference_coordinates(int dim) {
  static const std::vector<GiNaC::symbol> coordinates = {GiNaC::symbol("xi"), GiNaC::symbol("eta"),
                                                         GiNaC::symbol("mu")};
  return {coordinates.begin(), coordinates.begin() + dim};
}

const std::vector<std::string>& element_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Element& element : elements()) result.push_back(element.name);
    return result;
  }();
  return names;
}

const Element& find_element(const std::string& name) {
  for (const Element& element : elements()) {
    if (element.name == name) return element;
  }
  throw InputError(fmt::format("unknown element '{}'{}; elements are {}", name,
                               suggestion(name, element_names()), join_names(element_names())));
}

std::vector<std::vector<GiNaC::ex>> shape_gradients(const Element& element) {
  std::vector<std::vector<GiNaC::ex>> gradients;
  for (const GiNaC::ex& function : element.shape_functions) {
    std::vector<GiNaC::ex> gradient;
    for (const GiNaC::symbol& coordinate : element.coordinates) {
      gradient.push_back(function.diff(coordinate).normal());
    }
    gradients.push_back(gradient);
  }
  return gradients;
}

}  // namespace elastogen::symgen
