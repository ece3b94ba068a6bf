#include "selector/scene/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "runtime/error.h"
#include "selector/scene/located_error.h"
#include "selector/support/names.h"
#include "symgen/law/moduli.h"

namespace elastogen::selector {
namespace {

/// A name as a key of TOML.
std::string toml_key(const std::string& name) {
  const bool is_bare = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return is_bare ? name : "\"" + name + "\"";
}

std::string parameter_list(const symgen::Law& law) {
  std::vector<std::string> names;
  for (const symgen::Parameter& parameter : law.parameters) names.push_back(parameter.name);
  return join(names, ", ");
}

}  // namespace

std::vector<std::size_t> materials_of_blocks(const std::vector<MaterialDescription>& materials,
                                             const std::vector<SceneMesh::Block>& blocks) {
  std::vector<std::string> with_material, regions;
  for (const MaterialDescription& material : materials) {
    with_material.insert(with_material.end(), material.regions.begin(), material.regions.end());
  }
  std::vector<std::size_t> found;
  for (const SceneMesh::Block& block : blocks) {
    regions.push_back(block.region);
    const auto material =
        std::find_if(materials.begin(), materials.end(), [&](const MaterialDescription& m) {
          return std::find(m.regions.begin(), m.regions.end(), block.region) != m.regions.end();
        });
    if (material == materials.end()) {
      throw InputError(fmt::format(
          "{}: {}.region = '{}': this region has no material{}; add [material.{}], or name it in "
          "the 'regions' of a material",
          block.region_where, block.path, block.region, did_you_mean(block.region, with_material),
          toml_key(block.region)));
    }
    found.push_back(static_cast<std::size_t>(material - materials.begin()));
  }
  for (const MaterialDescription& material : materials) {
    for (const std::string& region : material.regions) {
      if (std::find(regions.begin(), regions.end(), region) != regions.end()) continue;
      const std::set<std::string> distinct(regions.begin(), regions.end());
      material.table.fail(fmt::format("there is no region '{}'{}; the scene has: {}", region,
                                      did_you_mean(region, regions), fmt::join(distinct, ", ")));
    }
  }
  return found;
}

void check_material_keys(const MaterialDescription& material,
                         const std::vector<const symgen::Law*>& laws) {
  std::vector<std::string> keys = {"density", "regions"};
  for (const symgen::Law* law : laws) {
    if (symgen::follows_from_young_poisson(*law)) keys.insert(keys.end(), {"young", "poisson"});
    for (const symgen::Parameter& parameter : law->parameters) keys.push_back(parameter.name);
  }
  std::vector<std::string> distinct;
  for (const std::string& key : keys) {
    if (std::find(distinct.begin(), distinct.end(), key) == distinct.end()) distinct.push_back(key);
  }
  material.table.allow_only(distinct);
}

std::vector<double> law_parameters(const MaterialDescription& material, const symgen::Law& law) {
  const TomlTable& table = material.table;
  if (table.has("young") || table.has("poisson")) {
    if (!symgen::follows_from_young_poisson(law)) {
      table.fail(fmt::format("law '{}' does not follow from young and poisson: give {}", law.name,
                             parameter_list(law)));
    }
    for (const symgen::Parameter& parameter : law.parameters) {
      if (table.has(parameter.name)) {
        table.fail(parameter.name, "give either young and poisson, or the law's own parameters");
      }
    }
    const double young = table.number("young", positive_number);
    const double poisson = table.number("poisson", any_number);
    constexpr NumberRange allowed{-1, 0.5, true, true};
    if (!allowed.contains(poisson)) {
      const std::string remedy =
          poisson < 0 ? "(the shear modulus is unbounded at -1); give a ratio from -0.9999"
                      : "(the bulk modulus is unbounded at 0.5); give a ratio up to 0.4999";
      table.fail("poisson", fmt::format("must be in (-1, 0.5) for law '{}' {}", law.name, remedy));
    }
    return with_location(table.where(), table.path(), [&] {
      return symgen::parameters_from_young_poisson(law, young, poisson);
    });
  }
  std::vector<double> values;
  for (const symgen::Parameter& parameter : law.parameters) {
    if (!table.has(parameter.name)) {
      table.fail(
          fmt::format("the parameter '{}' of law '{}' is missing: give {}{}", parameter.name,
                      law.name, parameter_list(law),
                      symgen::follows_from_young_poisson(law) ? ", or young and poisson" : ""));
    }
    values.push_back(table.number(parameter.name, any_number));
  }
  with_location(table.where(), table.path(), [&] { symgen::check_parameters(law, values); });
  return values;
}

}  // namespace elastogen::selector
