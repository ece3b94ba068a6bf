#include "symgen/mechanics/ginac_derivatives.h"

#include <fmt/format.h>

#include <unordered_map>
#include <utility>

#include "symgen/dag/lower.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;
using GiNaC::symbol;

std::vector<symbol> symbols_named(const std::string& name, std::size_t count) {
  std::vector<symbol> symbols;
  for (std::size_t k = 0; k < count; ++k) symbols.emplace_back(fmt::format("{}_{:03}", name, k));
  return symbols;
}

/// The element's inputs as GiNaC symbols, and the displacement gradient written in them.
struct PointSymbols {
  PointSymbols(int dim, int num_nodes, const std::vector<std::vector<Difference>>& differences)
      : displacement(symbols_named("U", static_cast<std::size_t>(num_nodes * dim))),
        direction(symbols_named("V", displacement.size())),
        measure("measure") {
    for (int k = 0; k < dim; ++k) {
      coefficients.push_back(symbols_named(fmt::format("c{}", k), differences[k].size()));
      inverse_jacobian.push_back(
          symbols_named(fmt::format("B{}", k), static_cast<std::size_t>(dim)));
    }
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        ex entry = 0;
        for (int k = 0; k < dim; ++k) {
          ex along = 0;
          for (std::size_t p = 0; p < differences[k].size(); ++p) {
            const auto& [node, other] = differences[k][p];
            along +=
                coefficients[k][p] * (displacement[node * dim + i] - displacement[other * dim + i]);
          }
          entry += along * inverse_jacobian[k][j];
        }
        gradient.push_back(entry);
      }
    }
  }

  std::vector<symbol> displacement, direction;
  symbol measure;
  std::vector<std::vector<symbol>> coefficients, inverse_jacobian;
  std::vector<ex> gradient;  // H[i * dim + j]
};

/// measure * W with the measure in each summand, where it joins the parameters: they make one
/// grouped constant.
ex weighted(const ex& density, const symbol& measure) {
  if (!GiNaC::is_a<GiNaC::add>(density)) return measure * density;
  ex sum = 0;
  for (const ex& summand : density) sum += measure * summand;
  return sum;
}

/// The values of a point in the order of the template's inputs.
std::vector<NodeId> flat(const PointValues& values) {
  std::vector<NodeId> nodes;
  const auto add = [&](const std::vector<NodeId>& more) {
    nodes.insert(nodes.end(), more.begin(), more.end());
  };
  add(values.parameters);
  add(values.displacement);
  add(values.direction);
  for (const std::vector<NodeId>& row : values.coefficients) add(row);
  for (const std::vector<NodeId>& row : values.inverse_jacobian) add(row);
  add({values.measure});
  return nodes;
}

}  // namespace

GinacDerivatives::GinacDerivatives(const Law& law, const EnergyDensity& energy, int num_nodes,
                                   const std::vector<std::vector<Difference>>& differences,
                                   std::shared_ptr<NumberPool> numbers)
    : dag_(std::move(numbers)) {
  const PointSymbols at(energy.dim, num_nodes, differences);
  SymbolNodes nodes;
  const auto add_input = [&](const symbol& input, Stage stage) {
    inputs_.push_back(dag_.symbol(input.get_name(), stage));
    nodes[input] = inputs_.back();
  };
  for (const Parameter& parameter : law.parameters) add_input(parameter.symbol, Stage::material);
  for (const symbol& input : at.displacement) add_input(input, Stage::state);
  for (const symbol& input : at.direction) add_input(input, Stage::direction);
  for (const auto& row : at.coefficients) {
    for (const symbol& input : row) add_input(input, Stage::literal);
  }
  for (const auto& row : at.inverse_jacobian) {
    for (const symbol& input : row) add_input(input, Stage::rest);
  }
  add_input(at.measure, Stage::rest);

  GiNaC::exmap gradient, moved, at_rest;
  for (std::size_t k = 0; k < at.gradient.size(); ++k)
    gradient[energy.gradient[k]] = at.gradient[k];
  const symbol epsilon("epsilon");
  for (std::size_t k = 0; k < at.displacement.size(); ++k) {
    moved[at.displacement[k]] = at.displacement[k] + epsilon * at.direction[k];
  }
  at_rest[epsilon] = 0;
  for (std::size_t l = 0; l < energy.terms.size(); ++l) {
    const ex density = flatten_term(energy, l).subs(gradient, GiNaC::subs_options::no_pattern);
    const ex term = weighted(density, at.measure);
    std::vector<ex> forces, product;
    for (const symbol& component : at.displacement) forces.push_back(-term.diff(component));
    for (const ex& force : forces) {
      product.push_back(force.subs(moved, GiNaC::subs_options::no_pattern)
                            .diff(epsilon)
                            .subs(at_rest, GiNaC::subs_options::no_pattern));
    }
    terms_.push_back({lower(dag_, forces, nodes), lower(dag_, product, nodes)});
  }
}

NodalDerivatives GinacDerivatives::at_point(Dag& target, std::size_t l,
                                            const PointValues& values) const {
  const std::vector<NodeId> given = flat(values);
  std::unordered_map<NodeId, NodeId> images;
  for (std::size_t k = 0; k < inputs_.size(); ++k) images[inputs_[k]] = given[k];
  return {substitute_into(target, dag_, terms_[l].forces, images),
          substitute_into(target, dag_, terms_[l].product, images)};
}

}  // namespace elastogen::symgen
