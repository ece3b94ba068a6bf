#include "selector/scene/field_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

std::vector<std::string> field_names() {
  std::vector<std::string> names;
  for (const OutputField& field : output_fields()) names.emplace_back(field.name);
  return names;
}

const OutputField& field_named(const TomlTable& table, std::string_view key,
                               const std::string& name) {
  if (const OutputField* field = find_output_field(name)) return *field;
  const std::vector<std::string> names = field_names();
  table.fail(key, fmt::format("'{}' is no field{}; there are {}", name, did_you_mean(name, names),
                              join(names, ", ")));
}

/// Every name of a list must be one of the choices.
std::vector<std::string> chosen_names(const TomlTable& table, std::string_view key,
                                      const std::vector<std::string>& choices) {
  const std::vector<std::string> names = table.strings(key);
  for (const std::string& name : names) {
    if (std::find(choices.begin(), choices.end(), name) != choices.end()) continue;
    table.fail(key, fmt::format("'{}' is none of {}{}", name, join(choices, ", "),
                                did_you_mean(name, choices)));
  }
  return names;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void keep_fields(FieldSettings& settings, const std::vector<std::string>& names) {
  settings.fields.clear();
  for (const OutputField& field : output_fields()) {
    if (contains(names, field.name)) settings.fields.push_back(&field);
  }
}

/// "von_mises", "cauchy_stress.XX"
PictureField read_picture(const TomlTable& table, const FieldSettings& settings) {
  const std::string text = table.string("picture");
  const std::size_t dot = text.find('.');
  const OutputField& field = field_named(table, "picture", text.substr(0, dot));
  if (!field.of_points()) {
    table.fail("picture",
               "must be a field of stress, strain or energy: deformed.png shows "
               "displacements");
  }
  if (!settings.has(field.name)) table.fail("picture", "must be one of the fields");
  const std::vector<FieldShape> shapes = field_shapes(field);
  if (shapes.size() > 1) table.fail("picture", "directions have no colour");
  const std::vector<std::string>& components = shapes.front().components;
  if (components.empty()) {
    if (dot == std::string::npos) return {&field, 0};
    table.fail("picture", fmt::format("'{}' has no components", field.name));
  }
  const std::string component = dot == std::string::npos ? "" : text.substr(dot + 1);
  const auto found = std::find(components.begin(), components.end(), component);
  if (found == components.end()) {
    table.fail("picture", fmt::format("needs one of its components: '{}.{}'", field.name,
                                      join(components, fmt::format("', '{}.", field.name))));
  }
  return {&field, static_cast<int>(found - components.begin())};
}

void choose_default_picture(FieldSettings& settings, const FieldContext& context) {
  if (context.writes_pictures && settings.has("von_mises")) {
    settings.picture = PictureField{find_output_field("von_mises"), 0};
  }
}

}  // namespace

std::string_view nodal_method_name(NodalMethod method) {
  return method == NodalMethod::average ? "average" : "projection";
}

bool FieldSettings::has(std::string_view name) const {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const OutputField* field) { return field->name == name; });
}

bool FieldSettings::has_points() const {
  return std::any_of(fields.begin(), fields.end(),
                     [](const OutputField* field) { return field->of_points(); });
}

FieldSettings default_fields(const FieldContext& context) {
  FieldSettings settings;
  std::vector<std::string> names = {"displacement", "velocity", "internal_forces", "reactions"};
  if (context.writes_files) {
    names.insert(names.end(), {"energy_density", "cauchy_stress", "von_mises"});
  }
  keep_fields(settings, names);
  // A row of a motion's history costs a pass over the body: only where fields are asked for.
  settings.at_probes = context.writes_files && !context.dynamic;
  choose_default_picture(settings, context);
  return settings;
}

FieldSettings read_fields(const TomlTable& output, const FieldContext& context) {
  FieldSettings settings = default_fields(context);
  if (output.has("fields")) {
    const std::vector<std::string> names = output.strings("fields");
    for (const std::string& name : names) (void)field_named(output, "fields", name);
    keep_fields(settings, names);
    settings.at_probes = settings.has_points();
    settings.picture.reset();
    choose_default_picture(settings, context);
  }
  for (const char* key : {"stress_at", "nodal", "picture"}) {
    if (output.has(key) && !settings.has_points()) {
      output.fail(key,
                  "is of stress, strain and energy, of which no field is written: name them "
                  "in fields");
    }
  }
  if (output.has("stress_at")) {
    const std::vector<std::string> places =
        chosen_names(output, "stress_at", {"elements", "nodes", "points"});
    if (places.empty()) {
      output.fail("stress_at", "needs one place or more; for no stress name fields without it");
    }
    settings.at_elements = contains(places, "elements");
    settings.at_nodes = contains(places, "nodes");
    settings.at_points = contains(places, "points");
  }
  if (output.has("nodal")) {
    if (!settings.at_nodes) output.fail("nodal", "is of nodes, which stress_at does not name");
    settings.nodal.clear();
    const std::vector<std::string> names = chosen_names(output, "nodal", {"average", "projection"});
    for (const NodalMethod method : {NodalMethod::average, NodalMethod::projection}) {
      if (contains(names, nodal_method_name(method))) settings.nodal.push_back(method);
    }
    if (settings.nodal.empty()) output.fail("nodal", "needs average, projection or both");
  }
  settings.at_probes = settings.at_probes && settings.at_nodes;
  if (output.has("picture")) {
    if (!context.writes_pictures) output.fail("picture", "is not among what is to be written");
    settings.picture = read_picture(output, settings);
  }
  return settings;
}

}  // namespace elastogen::selector
