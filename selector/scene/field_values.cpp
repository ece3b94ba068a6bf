#include "selector/scene/field_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "selector/scene/body_state.h"

namespace elastogen::selector {
namespace {

bool writes_fields(const OutputSettings& output) { return output.vtu || output.series; }

/// Whether anything shows fields of points.
bool shows_points(const Scene& scene) {
  const FieldSettings& fields = scene.output.fields;
  return fields.has_points() &&
         (writes_fields(scene.output) || fields.picture || shows_probe_fields(scene));
}

bool only_element_energies(const FieldSettings& fields) {
  return !fields.at_nodes && !fields.at_points && !fields.picture &&
         std::all_of(fields.fields.begin(), fields.fields.end(), [](const OutputField* field) {
           return !field->of_points() || field->quantity == PointQuantity::energy_density;
         });
}

/// One number per material: parts of the same law and parameters are of one.
std::vector<int> material_zones(const Problem& problem, std::span<const ModelPart> parts) {
  std::vector<std::pair<std::string, std::vector<double>>> materials;
  std::vector<int> zones;
  for (const ModelPart& part : parts) {
    const std::pair material(problem.materials[part.block].law, part.parameters);
    const auto known = std::find(materials.begin(), materials.end(), material);
    zones.push_back(static_cast<int>(known - materials.begin()));
    if (known == materials.end()) materials.push_back(material);
  }
  return zones;
}

}  // namespace

bool shows_probe_fields(const Scene& scene) {
  return scene.output.fields.at_probes && !scene.probes.empty();
}

bool needs_stress(const Scene& scene) {
  return shows_points(scene) && !only_element_energies(scene.output.fields);
}

bool needs_element_energies(const Scene& scene) {
  return shows_points(scene) && only_element_energies(scene.output.fields);
}

FieldEvaluator::FieldEvaluator(const Scene& scene, const Problem& problem, Model& model,
                               std::span<const ModelPart> parts)
    : scene_(scene),
      settings_(scene.output.fields),
      problem_(problem),
      model_(model),
      parts_(parts) {
  for (const OutputField* field : settings_.fields) {
    if (!field->of_points()) continue;
    fields_.push_back(field);
    if (std::find(quantities_.begin(), quantities_.end(), field->quantity) != quantities_.end()) {
      continue;
    }
    quantities_.push_back(field->quantity);
    width_ += quantity_width(field->quantity);
  }
  for (const BlockMaterial& material : problem.materials) {
    kinematics_.push_back(problem.laws.at(material.law).small_strain ? Kinematics::infinitesimal
                                                                     : Kinematics::finite);
  }
}

void FieldEvaluator::evaluate(const Vector& displacement) {
  model_.stress(displacement, points_);
  trouble_ = model_.status().ok() ? "" : model_.describe(model_.status());
  values_.resize(points_.points.size() * static_cast<std::size_t>(width_));
  std::size_t first_element = 0;
  const std::vector<ElementBlock>& blocks = problem_.mesh.mesh.blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t end_element = first_element + blocks[b].num_elements();
    const auto begin = static_cast<std::ptrdiff_t>(points_.first[first_element]);
    const auto end = static_cast<std::ptrdiff_t>(points_.first[end_element]);
    const Kinematics kinematics = kinematics_[b];
#pragma omp parallel for schedule(static) num_threads(model_.num_threads())
    for (std::ptrdiff_t p = begin; p < end; ++p) {
      double* out = values_.data() + p * width_;
      for (const PointQuantity quantity : quantities_) {
        write_quantity(quantity, points_.points[static_cast<std::size_t>(p)], kinematics, out);
        out += quantity_width(quantity);
      }
    }
    first_element = end_element;
  }
}

const StressField& FieldEvaluator::points_at(const Vector& displacement) {
  evaluate(displacement);
  return points_;
}

NodalRecovery& FieldEvaluator::recovery() {
  if (!recovery_) {
    recovery_.emplace(problem_.mesh.mesh, parts_, material_zones(problem_, parts_));
  }
  return *recovery_;
}

std::vector<double> FieldEvaluator::element_means() const {
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t num_elements = points_.first.size() - 1;
  std::vector<double> means(num_elements * width, 0.0);
  for (std::size_t e = 0; e < num_elements; ++e) {
    double volume = 0;
    for (std::size_t p = points_.first[e]; p < points_.first[e + 1]; ++p) {
      const double share = points_.points[p].volume;
      volume += share;
      for (std::size_t k = 0; k < width; ++k) {
        means[e * width + k] += share * values_[p * width + k];
      }
    }
    for (std::size_t k = 0; k < width; ++k) means[e * width + k] /= volume;
  }
  return means;
}

std::optional<GreatestAtPoints> FieldEvaluator::greatest(std::string_view field) const {
  const auto at = std::find_if(fields_.begin(), fields_.end(),
                               [&](const OutputField* one) { return one->name == field; });
  if (at == fields_.end()) return std::nullopt;
  std::optional<GreatestAtPoints> found;
  std::array<double, 9> numbers{};
  for (std::size_t e = 0; e + 1 < points_.first.size(); ++e) {
    for (std::size_t p = points_.first[e]; p < points_.first[e + 1]; ++p) {
      write_field(**at, quantity_of(**at, &values_[p * static_cast<std::size_t>(width_)]),
                  numbers.data());
      if (!std::isfinite(numbers[0]) || (found && numbers[0] <= found->value)) continue;
      found = {numbers[0], e};
    }
  }
  return found;
}

std::vector<double> FieldEvaluator::slot_values(NodalMethod method) {
  return method == NodalMethod::average ? recovery().average(values_, width_)
                                        : recovery().project(values_, width_);
}

const double* FieldEvaluator::quantity_of(const OutputField& field,
                                          const double* quantities) const {
  for (const PointQuantity quantity : quantities_) {
    if (quantity == field.quantity) break;
    quantities += quantity_width(quantity);
  }
  return quantities;
}

void FieldEvaluator::add_arrays(std::span<const double> quantities, const std::string& suffix,
                                std::vector<FieldArray>& arrays) const {
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t count = quantities.size() / width;
  std::array<double, 9> numbers{};  // the most that a field has
  for (const OutputField* field : fields_) {
    const std::size_t first = arrays.size();
    for (FieldShape& shape : field_shapes(*field)) {
      shape.name += suffix;
      FieldArray array{std::move(shape), {}};
      array.values.resize(count * static_cast<std::size_t>(array.shape.width()));
      arrays.push_back(std::move(array));
    }
    for (std::size_t k = 0; k < count; ++k) {
      write_field(*field, quantity_of(*field, quantities.data() + k * width), numbers.data());
      const double* from = numbers.data();
      for (std::size_t a = first; a < arrays.size(); ++a) {
        const auto each = static_cast<std::size_t>(arrays[a].shape.width());
        std::copy_n(from, each, &arrays[a].values[k * each]);
        from += each;
      }
    }
  }
}

FieldValues FieldEvaluator::at(const Vector& displacement) {
  FieldValues fields;
  if (needs_element_energies(scene_)) {
    FieldArray& density = fields.elements.emplace_back();
    density.shape.name = "energy_density";
    density.values = energy_density(model_, displacement);
    return fields;
  }
  if (!needs_stress(scene_)) return fields;
  evaluate(displacement);
  if (settings_.at_elements) add_arrays(element_means(), "", fields.elements);
  if (settings_.at_points) add_arrays(values_, "", fields.points);
  if (settings_.at_nodes) {
    for (const NodalMethod method : settings_.nodal) {
      add_arrays(recovery().joined(slot_values(method), width_),
                 fmt::format("_{}", nodal_method_name(method)), fields.nodes);
    }
  }
  return fields;
}

std::vector<double> FieldEvaluator::nodal_quantities(const Vector& displacement) {
  evaluate(displacement);
  return recovery().joined(slot_values(settings_.nodal.front()), width_);
}

std::vector<FieldArray> FieldEvaluator::at_probe(const std::vector<double>& nodal_quantities,
                                                 std::span<const std::int32_t> nodes) const {
  const auto width = static_cast<std::size_t>(width_);
  std::vector<double> mean(width, 0.0);
  for (const std::int32_t node : nodes) {
    for (std::size_t k = 0; k < width; ++k) {
      mean[k] += nodal_quantities[static_cast<std::size_t>(node) * width + k] /
                 static_cast<double>(nodes.size());
    }
  }
  std::vector<FieldArray> arrays;
  add_arrays(mean, "", arrays);
  return arrays;
}

ElementNodeValues FieldEvaluator::picture(const Vector& displacement) {
  const PictureField& chosen = *settings_.picture;
  const std::vector<std::string> components = field_shapes(*chosen.field).front().components;
  ElementNodeValues picture{std::string(chosen.field->title), std::string(chosen.field->unit), {}};
  if (!components.empty()) {
    picture.title += " " + components[static_cast<std::size_t>(chosen.component)];
  }
  evaluate(displacement);
  const std::vector<double> values =
      settings_.at_nodes ? slot_values(settings_.nodal.front()) : element_means();
  std::array<double, 9> numbers{};
  const auto add = [&](std::size_t k) {
    write_field(*chosen.field,
                quantity_of(*chosen.field, values.data() + k * static_cast<std::size_t>(width_)),
                numbers.data());
    picture.values.push_back(numbers[static_cast<std::size_t>(chosen.component)]);
  };
  std::size_t e = 0;
  for (const ElementBlock& block : problem_.mesh.mesh.blocks) {
    for (std::size_t k = 0; k < block.num_elements(); ++k, ++e) {
      if (settings_.at_nodes) {
        for (const std::int32_t slot : recovery().element_slots(e)) {
          add(static_cast<std::size_t>(slot));
        }
      } else {
        for (int a = 0; a < block.nodes_per_element; ++a) add(e);
      }
    }
  }
  return picture;
}

std::vector<double> FieldEvaluator::point_positions() { return recovery().point_positions(); }

std::vector<double> FieldEvaluator::point_displacements(const Vector& displacement) {
  const auto dim = static_cast<std::size_t>(model_.dim());
  const std::vector<double> values = recovery().at_points(values_of(displacement), model_.dim());
  std::vector<double> in_space(values.size() / dim * 3, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) in_space[k / dim * 3 + k % dim] = values[k];
  return in_space;
}

std::vector<double> FieldEvaluator::point_elements() {
  std::vector<double> elements;
  for (std::size_t e = 0; e + 1 < points_.first.size(); ++e) {
    elements.insert(elements.end(), points_.first[e + 1] - points_.first[e],
                    static_cast<double>(e));
  }
  return elements;
}

}  // namespace elastogen::selector
