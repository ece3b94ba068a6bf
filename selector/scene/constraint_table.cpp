#include "selector/scene/constraint_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "selector/scene/located_error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

using Displacement = std::array<std::optional<double>, 3>;

void read_fixed(const TomlTable& table, int dim, Displacement& displacement) {
  for (const std::string& axis : table.strings("fixed")) {
    if (axis_number(axis, dim) == axes_of(dim).size()) {
      table.fail("fixed",
                 fmt::format("'{}' is no component: {} are{}", axis, join(axes_of(dim), ", "),
                             dim == 2 ? " in a plane scene" : ""));
    }
    displacement[axis_number(axis, dim)] = 0;
  }
}

void read_displacement(const TomlTable& table, int dim, Displacement& displacement) {
  table.allow_only(axes_of(dim));
  for (const std::string& axis : table.keys()) {
    std::optional<double>& component = displacement[axis_number(axis, dim)];
    if (component) table.fail(axis, "this component stands in 'fixed', too");
    component = table.number(axis, any_number);
  }
}

Rotation read_rotation(const TomlTable& table, int dim) {
  table.allow_only(dim == 2 ? std::vector<std::string>{"point", "turns"}
                            : std::vector<std::string>{"point", "axis", "turns"});
  Rotation rotation;
  rotation.point = table.vector("point", dim);
  rotation.axis = dim == 2 ? std::array<double, 3>{0, 0, 1} : table.vector("axis", dim);
  if (rotation.axis == std::array<double, 3>{}) table.fail("axis", "must not be 0");
  rotation.angle = 2 * std::numbers::pi * table.number("turns", any_number);
  return rotation;
}

std::optional<History> read_history(const TomlTable& table, bool dynamic) {
  if (table.has("history") && table.has("sine")) table.fail("sine", "give either this or history");
  if (table.has("sine")) {
    if (!dynamic) table.fail("sine", "is for scenes with [dynamics]: a load factor ends at 1");
    return History::sine(table.number("sine", positive_number));
  }
  if (!table.has("history")) return std::nullopt;
  std::vector<std::pair<double, double>> points;
  for (const std::vector<double>& row : table.rows("history", 2)) {
    points.emplace_back(row[0], row[1]);
  }
  return with_location(table.where("history"), table.path_of("history"),
                       [&] { return History::table(std::move(points)); });
}

}  // namespace

bool ConstraintDescription::moves() const {
  return rotation || std::any_of(displacement.begin(), displacement.end(),
                                 [](const auto& component) { return component.value_or(0) != 0; });
}

ConstraintDescription read_constraint(const TomlTable& table, int dim, bool dynamic) {
  table.allow_only(
      {"plane", "box", "boundary", "fixed", "displacement", "rotation", "history", "sine"});
  ConstraintDescription constraint;
  constraint.nodes = read_selection(table, dim);
  constraint.text = table.text();
  if (table.has("fixed")) read_fixed(table, dim, constraint.displacement);
  if (table.has("displacement")) {
    read_displacement(table.table("displacement"), dim, constraint.displacement);
  }
  const bool has_components =
      std::any_of(constraint.displacement.begin(), constraint.displacement.end(),
                  [](const auto& component) { return component.has_value(); });
  if (table.has("rotation")) {
    if (has_components) {
      table.fail("rotation", "moves all components: it stands without 'fixed' and 'displacement'");
    }
    constraint.rotation = read_rotation(table.table("rotation"), dim);
    std::fill_n(constraint.displacement.begin(), dim, 0.0);
  } else if (!has_components) {
    table.fail(fmt::format(
        "constrains nothing: give fixed = [\"{}\"], displacement = {{ y = 1 }} or rotation = {{ "
        "point = {}turns = 0.5 }}",
        join(axes_of(dim), "\", \""), dim == 2 ? "[0, 0], " : "[0, 0, 0], axis = [1, 0, 0], "));
  }
  constraint.history = read_history(table, dynamic);
  if (constraint.history && !constraint.moves()) {
    table.fail("has a history, but nothing that moves: give displacement or rotation");
  }
  if (dynamic && constraint.moves() && !constraint.history) {
    table.fail(
        "moves, but does not say when: give history = [[0, 0], [1, 1]], rows of time in seconds "
        "and fraction of the motion, or sine = 0.5, a frequency in Hz");
  }
  return constraint;
}

}  // namespace elastogen::selector
