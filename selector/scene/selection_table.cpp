#include "selector/scene/selection_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

NodeSelection read_plane(const TomlTable& plane, int dim) {
  plane.allow_only(axes_of(dim));
  const std::vector<std::string> keys = plane.keys();
  if (keys.size() != 1)
    plane.fail(fmt::format("must give one of {}: {{ x = 0 }}", join(axes_of(dim), ", ")));
  constexpr double inf = no_limit;
  NodeSelection nodes{plane.where(), "", {-inf, -inf, -inf}, {inf, inf, inf}};
  const std::size_t axis = axis_number(keys.front(), dim);
  nodes.minimum[axis] = nodes.maximum[axis] = plane.number(keys.front(), any_number);
  nodes.description = fmt::format("plane {} = {}", keys.front(), nodes.minimum[axis]);
  return nodes;
}

}  // namespace

std::vector<std::string> axes_of(int dim) {
  std::vector<std::string> axes = {"x", "y", "z"};
  axes.resize(static_cast<std::size_t>(dim));
  return axes;
}

std::size_t axis_number(const std::string& axis, int dim) {
  const std::vector<std::string> axes = axes_of(dim);
  return static_cast<std::size_t>(std::find(axes.begin(), axes.end(), axis) - axes.begin());
}

NodeSelection read_box(const TomlTable& box, int dim) {
  box.allow_only({"min", "max"});
  NodeSelection nodes{box.where(), "", box.vector("min", dim), box.vector("max", dim)};
  const auto used = static_cast<std::size_t>(dim);
  for (std::size_t i = 0; i < used; ++i) {
    if (nodes.minimum[i] > nodes.maximum[i]) {
      box.fail("min", fmt::format("must not exceed max; along {} it does: {} > {}", axes_of(dim)[i],
                                  nodes.minimum[i], nodes.maximum[i]));
    }
  }
  nodes.description =
      fmt::format("box [{}] to [{}]", fmt::join(std::span(nodes.minimum).first(used), ", "),
                  fmt::join(std::span(nodes.maximum).first(used), ", "));
  if (dim == 2) {
    nodes.minimum[2] = -no_limit;
    nodes.maximum[2] = no_limit;
  }
  return nodes;
}

NodeSelection read_selection(const TomlTable& table, int dim) {
  if (table.has("plane") + table.has("box") + table.has("boundary") != 1) {
    table.fail(fmt::format(
        "needs one of plane = {{ x = 0 }}, box = {} and boundary = \"NAME\" to select nodes",
        dim == 2 ? "{ min = [0, 0], max = [1, 1] }" : "{ min = [0, 0, 0], max = [1, 1, 1] }"));
  }
  if (table.has("boundary")) {
    const std::string name = table.string("boundary");
    return {table.where("boundary"), fmt::format("boundary '{}'", name), {}, {}, name};
  }
  return table.has("plane") ? read_plane(table.table("plane"), dim)
                            : read_box(table.table("box"), dim);
}

}  // namespace elastogen::selector
