#include "selector/scene/file_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "runtime/error.h"
#include "selector/io/mesh_faces.h"
#include "selector/io/mesh_formats.h"
#include "selector/scene/located_error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace {

const MeshPartDescription* part_of(const MeshFileDescription& description,
                                   const std::string& region) {
  const auto found = std::find_if(description.parts.begin(), description.parts.end(),
                                  [&](const auto& part) { return part.region == region; });
  return found == description.parts.end() ? nullptr : &*found;
}

void check_regions(const MeshFileDescription& description, const Mesh& mesh) {
  const std::vector<std::string>& regions = mesh.region_names;
  for (const MeshPartDescription& part : description.parts) {
    if (std::find(regions.begin(), regions.end(), part.region) != regions.end()) continue;
    throw InputError(fmt::format(
        "{}: {}.region = '{}': the mesh file has no such region{}; it has: {}", part.region_where,
        part.choice.path, part.region, did_you_mean(part.region, regions), join(regions, ", ")));
  }
}

/// The association that a choice gives to an element; `used` notes which were taken.
symgen::AssociationId association_for(const ElementChoice& choice, const ElementBlock& block,
                                      const std::string& region, std::set<std::string>& used) {
  if (!choice.law.empty()) {
    return with_location(choice.where, choice.path, [&] {
      return symgen::AssociationId::parse(
          fmt::format("{}-{}-{}-{}", choice.law, block.element,
                      symgen::quadrature_names(block.element).front(), choice.split));
    });
  }
  for (const symgen::AssociationId& id : choice.associations) {
    if (id.element != block.element) continue;
    used.insert(id.text());
    return id;
  }
  throw InputError(fmt::format(
      "{}: {}.associations: there is none for the {} elements {} of region '{}': add one",
      choice.where, choice.path, block.num_elements(), block.element, region));
}

/// Every association must be taken by elements.
void check_all_used(const ElementChoice& choice, const std::set<std::string>& used) {
  for (const symgen::AssociationId& id : choice.associations) {
    if (used.contains(id.text())) continue;
    throw InputError(fmt::format("{}: {}.associations: '{}' is of no elements: remove it",
                                 choice.where, choice.path, id.text()));
  }
}

}  // namespace

SceneMesh make_file_mesh(const MeshFileDescription& description) {
  MeshFile file = *description.mesh;
  for (double& x : file.mesh.positions) x *= description.scale;
  check_regions(description, file.mesh);

  SceneMesh result;
  std::map<const ElementChoice*, std::set<std::string>> used;
  for (std::size_t b = 0; b < file.mesh.blocks.size(); ++b) {
    const ElementBlock& block = file.mesh.blocks[b];
    const std::string& region =
        file.mesh.region_names[static_cast<std::size_t>(block.region.front())];
    const MeshPartDescription* part = part_of(description, region);
    const ElementChoice* choice = part != nullptr      ? &part->choice
                                  : description.choice ? &*description.choice
                                                       : nullptr;
    const std::string where = part != nullptr ? part->region_where : description.where;
    if (choice != nullptr) {
      result.blocks.push_back({choice->path, association_for(*choice, block, region, used[choice]),
                               choice->where, region, where});
    } else if (!file.associations[b].empty()) {
      result.blocks.push_back({description.path, symgen::AssociationId::parse(file.associations[b]),
                               where, region, where});
    } else {
      throw InputError(fmt::format(
          "{}: {}: region '{}' has no law: add law = \"stvk\" to [mesh], or a [[mesh.part]] with "
          "region = \"{}\"; the file's regions are: {}",
          description.where, description.path, region, region, join(file.mesh.region_names, ", ")));
    }
  }
  if (description.choice) check_all_used(*description.choice, used[&*description.choice]);
  for (const MeshPartDescription& part : description.parts) {
    check_all_used(part.choice, used[&part.choice]);
  }
  const FaceMatching matching = match_faces(file.mesh);
  result.split_quadrilaterals = matching.split_quadrilaterals.size();
  result.unequal_faces = matching.unequal.size();
  result.mesh = std::move(file.mesh);
  result.boundaries = std::move(file.boundaries);
  result.notes = std::move(file.notes);
  result.boundary_advice = mesh_format(description.file).boundaries;
  result.merge_advice = mesh_format(description.file).merge;
  return result;
}

}  // namespace elastogen::selector
