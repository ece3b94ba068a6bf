// What [output] says of fields: which, where, and how they come to the nodes.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "selector/scene/output_fields.h"
#include "selector/scene/toml_table.h"

namespace elastogen::selector {

/// How what is known at quadrature points comes to the nodes (runtime/nodal_recovery.h).
enum class NodalMethod { average, projection };
/// "average", "projection": also the end of the arrays' names
[[nodiscard]] std::string_view nodal_method_name(NodalMethod method);

/// A number that a picture is coloured by.
struct PictureField {
  const OutputField* field = nullptr;
  int component = 0;  ///< of FieldShape::components
};

struct FieldSettings {
  std::vector<const OutputField*> fields;                       ///< in the order of output_fields()
  bool at_elements = true, at_nodes = true, at_points = false;  ///< those of points
  std::vector<NodalMethod> nodal = {NodalMethod::average};      ///< the first is that of probes
  std::optional<PictureField> picture;                          ///< none: no picture of a field
  /// Probes show fields in the summary and the history.
  bool at_probes = false;

  [[nodiscard]] bool has(std::string_view name) const;
  [[nodiscard]] bool has_points() const;  ///< any field that is known at points
};

/// What else decides on fields.
struct FieldContext {
  bool writes_files = false;  ///< result.vtu, series or pictures
  bool writes_pictures = false;
  bool dynamic = false;
};

[[nodiscard]] FieldSettings default_fields(const FieldContext& context);

/// The keys `fields`, `stress_at`, `nodal` and `picture` of [output].
/// @throws InputError  an unknown name, with the nearest known; a key without what it is about
[[nodiscard]] FieldSettings read_fields(const TomlTable& output, const FieldContext& context);

}  // namespace elastogen::selector
