#include "runtime/model_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/congruent_elements.h"
#include "runtime/error.h"
#include "runtime/rest_geometry.h"

namespace elastogen {
namespace {

void check_mesh(const Mesh& mesh) {
  if (mesh.dim != 2 && mesh.dim != 3) {
    throw InputError(fmt::format("mesh: {} dimensions; must be 2 or 3", mesh.dim));
  }
  if (mesh.num_elements() == 0) throw InputError("mesh: it has no elements");
  if (mesh.positions.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError(
        fmt::format("mesh: {} nodes are more than 32-bit indices can number", mesh.num_nodes()));
  }
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    if (!std::isfinite(mesh.positions[k])) {
      throw InputError(
          fmt::format("mesh: node {}: component {} of its position is {}; must be finite",
                      k / static_cast<std::size_t>(mesh.dim),
                      k % static_cast<std::size_t>(mesh.dim), mesh.positions[k]));
    }
  }
  std::vector<bool> used(mesh.num_nodes(), false);
  std::size_t first = 0;
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = static_cast<std::size_t>(block.nodes_per_element);
    if (block.nodes.size() != n * block.num_elements()) {
      throw InternalError(fmt::format("block of {}: {} node numbers for {} elements of {} nodes",
                                      block.element, block.nodes.size(), block.num_elements(), n));
    }
    for (std::size_t k = 0; k < block.nodes.size(); ++k) {
      const std::int32_t node = block.nodes[k];
      if (node < 0 || static_cast<std::size_t>(node) >= mesh.num_nodes()) {
        throw InputError(
            fmt::format("element {} ({}): node number {} is outside the mesh; must be in 0 ... {}",
                        first + k / n, block.element, node, mesh.num_nodes() - 1));
      }
      used[static_cast<std::size_t>(node)] = true;
    }
    first += block.num_elements();
  }
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (used[node]) continue;
    throw InputError(fmt::format(
        "mesh: node {} belongs to no element, so nothing holds it; remove it from the mesh", node));
  }
}

/// @param two_stage  whether products will be two-stage ones with these kernels
template <class Scalar>
void check_table(const KernelTable<Scalar>& table, bool two_stage) {
  const auto fail = [&](const std::string& what) {
    throw InternalError(fmt::format("kernels of {}: {}", table.association, what));
  };
  if (table.abi_version != kernel_abi_version) {
    fail(fmt::format("made for ABI version {}, this runtime has {}; generate them again",
                     table.abi_version, kernel_abi_version));
  }
  if (table.lanes < 1 || table.lanes > most_lanes<Scalar> ||
      !std::has_single_bit(static_cast<unsigned>(table.lanes))) {
    fail(fmt::format("{} lanes; must be a power of 2 up to {}", table.lanes, most_lanes<Scalar>));
  }
  if (find_variant(table, "general") == nullptr) fail("no variant 'general'");
  for (std::int32_t v = 0; v < table.num_variants; ++v) {
    const VariantTable<Scalar>& variant = table.variants[v];
    if (variant.constants == nullptr || variant.geometry_measures == nullptr) {
      fail(fmt::format("variant '{}' lacks constants or geometry_measures", variant.geometry));
    }
    if (two_stage && (variant.linearize == nullptr || variant.apply == nullptr)) {
      fail(fmt::format("variant '{}' lacks linearize or apply, which the two-stage product needs",
                       variant.geometry));
    }
  }
}

/// The kernels in single precision, of the same association as those in double.
void check_single_kernels(const ModelPart& part, std::size_t number, bool two_stage) {
  if (part.single_kernels == nullptr) {
    throw InternalError(fmt::format("part {}: no kernels in single precision", number));
  }
  check_table(*part.single_kernels, two_stage);
  if (std::string_view(part.single_kernels->hash) != part.kernels->hash) {
    throw InternalError(
        fmt::format("part {}: kernels in single precision are of {} with the hash {}, those in "
                    "double of {} with {}",
                    number, part.single_kernels->association, part.single_kernels->hash,
                    part.kernels->association, part.kernels->hash));
  }
}

void check_part(const Mesh& mesh, const ModelPart& part, std::size_t number,
                const ModelOptions& options) {
  if (part.kernels == nullptr || part.block >= mesh.blocks.size()) {
    throw InternalError(fmt::format("part {}: no kernels, or no such block", number));
  }
  const KernelTable<double>& table = *part.kernels;
  const bool two_stage = options.tangent_product == TangentProduct::two_stage;
  const bool in_double = options.precision == Precision::double_precision;
  check_table(table, two_stage && in_double);
  if (!in_double) check_single_kernels(part, number, two_stage);
  const ElementBlock& block = mesh.blocks[part.block];
  if (block.element != table.element || block.nodes_per_element != table.num_nodes ||
      mesh.dim != table.dim) {
    throw InputError(fmt::format(
        "part {}: its elements are {} with {} nodes in {} dimensions, but association {} is for {} "
        "with {} nodes in {} dimensions; choose an association of the elements' type",
        number, block.element, block.nodes_per_element, mesh.dim, table.association, table.element,
        table.num_nodes, table.dim));
  }
  if (part.parameters.size() != static_cast<std::size_t>(table.num_parameters)) {
    throw InputError(fmt::format("part {}: {} parameters given, association {} takes {}", number,
                                 part.parameters.size(), table.association, table.num_parameters));
  }
  for (std::size_t k = 0; k < part.parameters.size(); ++k) {
    if (!std::isfinite(part.parameters[k])) {
      throw InputError(fmt::format("part {}: parameter {} = {}; must be finite", number,
                                   table.parameter_names[k], part.parameters[k]));
    }
  }
  if (!std::isfinite(part.density) || part.density < 0) {
    throw InputError(fmt::format("part {}: density {} kg/m^3; must be finite and not negative",
                                 number, part.density));
  }
}

// Every element must be in exactly one part.
void check_cover(const Mesh& mesh, std::span<const ModelPart> parts) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t first = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    std::vector<std::size_t> owner(block.num_elements(), none);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (parts[p].block != b) continue;
      for (const std::int32_t e : parts[p].elements) {
        if (e < 0 || static_cast<std::size_t>(e) >= block.num_elements()) {
          throw InternalError(fmt::format("part {}: no element {} in block {}", p, e, b));
        }
        std::size_t& o = owner[static_cast<std::size_t>(e)];
        if (o != none) {
          throw InputError(fmt::format("element {} ({}) is in parts {} and {}; must be in one",
                                       first + static_cast<std::size_t>(e), block.element, o, p));
        }
        o = p;
      }
    }
    for (std::size_t e = 0; e < owner.size(); ++e) {
      if (owner[e] != none) continue;
      throw InputError(fmt::format("element {} ({}) has no material and association; give it one",
                                   first + e, block.element));
    }
    first += block.num_elements();
  }
}

/// Elements of a part that are computed by one geometry variant.
template <class Scalar>
struct VariantElements {
  const VariantTable<Scalar>* kernels = nullptr;
  std::vector<std::int32_t> elements;
  std::vector<int> node_order;  // as ElementGroupSource::node_order
};

template <class Scalar>
std::vector<VariantElements<Scalar>> special_variants(const KernelTable<Scalar>& table) {
  std::vector<VariantElements<Scalar>> variants;
  for (std::int32_t v = 0; v < table.num_variants; ++v) {
    const VariantTable<Scalar>& variant = table.variants[v];
    if (std::string_view(variant.geometry) != "general") variants.push_back({&variant, {}, {}});
  }
  return variants;
}

/// The elements at some places of the list.
template <class Scalar>
VariantElements<Scalar> pick(const VariantElements<Scalar>& from,
                             const std::vector<std::size_t>& places) {
  VariantElements<Scalar> result{from.kernels, {}, {}};
  const std::size_t n = from.node_order.size() / from.elements.size();
  for (const std::size_t place : places) {
    result.elements.push_back(from.elements[place]);
    const auto order = from.node_order.begin() + static_cast<std::ptrdiff_t>(place * n);
    result.node_order.insert(result.node_order.end(), order,
                             order + static_cast<std::ptrdiff_t>(n));
  }
  return result;
}

/// [element * n * dim + a * dim + i]: positions of nodes from node 0, in the variant's order.
template <class Scalar>
std::vector<double> relative_positions(const Mesh& mesh, const ElementBlock& block,
                                       const VariantElements<Scalar>& variant) {
  const std::size_t dim = static_cast<std::size_t>(mesh.dim);
  const std::size_t n = static_cast<std::size_t>(block.nodes_per_element);
  std::vector<double> positions;
  positions.reserve(variant.elements.size() * n * dim);
  for (std::size_t k = 0; k < variant.elements.size(); ++k) {
    const std::span<const std::int32_t> nodes =
        block.element_nodes(static_cast<std::size_t>(variant.elements[k]));
    const auto position = [&](std::size_t a) {
      const std::size_t own =
          variant.node_order.empty() ? a : static_cast<std::size_t>(variant.node_order[k * n + a]);
      return &mesh.positions[static_cast<std::size_t>(nodes[own]) * dim];
    };
    const double* const first = position(0);
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t i = 0; i < dim; ++i) positions.push_back(position(a)[i] - first[i]);
    }
  }
  return positions;
}

/// Adds the group of a variant's elements, or those of the congruent ones and of the others.
template <class Scalar>
void add_groups(const Mesh& mesh, const VariantElements<Scalar>& variant,
                ElementGroupSource<Scalar> source, bool share_constants,
                std::vector<ElementGroup<Scalar>>& groups) {
  const auto add = [&](const VariantElements<Scalar>& elements,
                       std::span<const std::int32_t> shape) {
    source.elements = elements.elements;
    source.node_order = elements.node_order;
    source.shape = shape;
    groups.push_back(make_element_group(mesh, source));
  };
  CongruentElements congruent;
  if (share_constants) {
    const ElementBlock& block = mesh.blocks[source.block];
    congruent =
        find_congruent_elements(relative_positions(mesh, block, variant),
                                static_cast<std::size_t>(block.nodes_per_element * mesh.dim),
                                static_cast<std::size_t>(source.table->lanes));
  }
  if (congruent.order.empty()) {
    add(variant, {});
    return;
  }
  add(pick(variant, congruent.order), congruent.shape);
  if (!congruent.others.empty()) add(pick(variant, congruent.others), {});
}

template <class Scalar>
const KernelTable<Scalar>& kernels_of(const ModelPart& part) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return *part.kernels;
  } else {
    return *part.single_kernels;
  }
}

}  // namespace

std::vector<std::int32_t> elements_of_region(const ElementBlock& block, std::int32_t region) {
  std::vector<std::int32_t> elements;
  for (std::size_t e = 0; e < block.num_elements(); ++e) {
    if (block.region[e] == region) elements.push_back(static_cast<std::int32_t>(e));
  }
  return elements;
}

void check_parts(const Mesh& mesh, std::span<const ModelPart> parts, const ModelOptions& options) {
  check_mesh(mesh);
  for (const std::int32_t node : options.held_nodes) {
    if (node >= 0 && static_cast<std::size_t>(node) < mesh.num_nodes()) continue;
    throw InternalError(fmt::format("held node {}: the mesh has {}", node, mesh.num_nodes()));
  }
  if (!(options.sleep.motion >= 0) || options.sleep.calls < 1) {
    throw InputError(fmt::format("sleep: motion = {} m in {} calls; must be at least 0, and 1",
                                 options.sleep.motion, options.sleep.calls));
  }
  for (std::size_t p = 0; p < parts.size(); ++p) check_part(mesh, parts[p], p, options);
  check_cover(mesh, parts);
}

template <class Scalar>
std::vector<ElementGroup<Scalar>> make_element_groups(const Mesh& mesh,
                                                      std::span<const ModelPart> parts,
                                                      const ModelOptions& options) {
  std::vector<bool> is_held(mesh.num_nodes(), false);
  for (const std::int32_t node : options.held_nodes) is_held[static_cast<std::size_t>(node)] = true;
  std::vector<std::size_t> first_element(mesh.blocks.size(), 0);
  for (std::size_t b = 1; b < mesh.blocks.size(); ++b) {
    first_element[b] = first_element[b - 1] + mesh.blocks[b - 1].num_elements();
  }
  std::vector<ElementGroup<Scalar>> groups;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ModelPart& part = parts[p];
    const ElementBlock& block = mesh.blocks[part.block];
    // Each element goes to the first variant that its shape allows; "general", which all do, last.
    const KernelTable<Scalar>& table = kernels_of<Scalar>(part);
    std::vector<VariantElements<Scalar>> variants = special_variants(table);
    variants.push_back({find_variant(table, "general"), {}, {}});
    VariantElements<Scalar> at_rest = variants.back();
    for (const std::int32_t e : part.elements) {
      const auto nodes = block.element_nodes(static_cast<std::size_t>(e));
      if (std::all_of(nodes.begin(), nodes.end(),
                      [&](std::int32_t node) { return is_held[static_cast<std::size_t>(node)]; })) {
        at_rest.elements.push_back(e);
        continue;
      }
      for (VariantElements<Scalar>& variant : variants) {
        const std::optional<std::vector<int>> order =
            node_order_for(variant.kernels->geometry, mesh, block, static_cast<std::size_t>(e));
        if (!order) continue;
        variant.elements.push_back(e);
        variant.node_order.insert(variant.node_order.end(), order->begin(), order->end());
        break;
      }
    }
    ElementGroupSource<Scalar> source;
    source.part = p;
    source.block = part.block;
    source.first_element = first_element[part.block];
    source.table = &table;
    source.parameters = part.parameters;
    source.density = part.density;
    for (const VariantElements<Scalar>& variant : variants) {
      if (variant.elements.empty()) continue;
      source.kernels = variant.kernels;
      add_groups(mesh, variant, source, options.share_constants, groups);
    }
    if (at_rest.elements.empty()) continue;
    source.kernels = at_rest.kernels;
    source.at_rest = true;
    add_groups(mesh, at_rest, source, false, groups);
  }
  return groups;
}

template std::vector<ElementGroup<double>> make_element_groups(const Mesh&,
                                                               std::span<const ModelPart>,
                                                               const ModelOptions&);
template std::vector<ElementGroup<float>> make_element_groups(const Mesh&,
                                                              std::span<const ModelPart>,
                                                              const ModelOptions&);

}  // namespace elastogen
