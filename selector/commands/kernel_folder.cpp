#include "selector/commands/kernel_folder.h"

#include <fmt/format.h>

#include "runtime/error.h"
#include "selector/support/files.h"
#include "symgen/emit/content_hash.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

constexpr const char* manifest_name = "manifest.json";
constexpr int manifest_version = 2;

nlohmann::json empty_manifest() {
  return {{"manifest_version", manifest_version},
          {"generator", "elastogen " ELASTOGEN_VERSION},
          {"associations", nlohmann::json::object()}};
}

nlohmann::json variant_summary(const symgen::VariantReport& variant) {
  nlohmann::json flops = nlohmann::json::object();
  for (const symgen::OperationReport& operation : variant.operations) {
    flops[operation.name] = operation.flops;
  }
  return {{"geometry", variant.geometry},
          {"constants", variant.num_constants},
          {"state", variant.num_state},
          {"flops", flops}};
}

symgen::Instantiation all_operations(bool single_precision) {
  symgen::Instantiation what;
  what.single_precision = single_precision;
  what.operations = {"energy", "forces", "product", "linearize", "apply", "stiffness", "stress"};
  return what;
}

std::string table_declarations(const symgen::AssociationId& id) {
  return fmt::format(
      "// Kernel tables of {0}; link {1}_f64.cpp and {1}_f32.cpp.\n"
      "#pragma once\n\n"
      "#include \"runtime/kernel_abi.h\"\n\n"
      "extern \"C\" {{\n"
      "const elastogen::KernelTable<double>* {2}();\n"
      "const elastogen::KernelTable<float>* {3}();\n"
      "}}\n",
      id.text(), id.identifier(), symgen::registration_symbol(id, all_operations(false)),
      symgen::registration_symbol(id, all_operations(true)));
}

}  // namespace

SourceFiles cpu_files(const symgen::GeneratedAssociation& generated, const symgen::Law& law) {
  const symgen::AssociationId& id = generated.id;
  const std::string name = id.identifier();
  return {{name + ".h", generated.header},
          {name + "_tables.h", table_declarations(id)},
          {name + "_f64.cpp", symgen::registration_source(id, law, all_operations(false))},
          {name + "_f32.cpp", symgen::registration_source(id, law, all_operations(true))}};
}

SourceFiles opencl_files(const symgen::GeneratedAssociation& generated) {
  return {{generated.id.identifier() + ".cl", generated.opencl}};
}

KernelFolder::KernelFolder(fs::path folder)
    : folder_(std::move(folder)), manifest_(empty_manifest()) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_, error)) {
    throw InputError(fmt::format("--out '{}' is a file; name a folder", folder_.string()));
  }
  const fs::path file = folder_ / manifest_name;
  if (!fs::exists(file, error)) return;
  nlohmann::json found =
      nlohmann::json::parse(read_text_file(file, "manifest"), nullptr, /*allow_exceptions=*/false);
  const int version = found.is_object() ? found.value("manifest_version", 0) : 0;
  if (version == 1) return;  // an older generator's: everything is made again
  const bool ours = version == manifest_version && found.contains("associations") &&
                    found["associations"].is_object();
  if (!ours) {
    throw InputError(
        fmt::format("'{}' is no manifest of generated kernels (version {}); remove "
                    "it, or choose another folder with --out",
                    file.string(), manifest_version));
  }
  manifest_["associations"] = std::move(found["associations"]);
}

bool KernelFolder::write_if_changed(const std::string& file, const std::string& text) const {
  std::error_code error;
  const fs::path path = folder_ / file;
  if (fs::is_regular_file(path, error) && read_text_file(path, "generated") == text) return false;
  write_text_file(path, text);
  return true;
}

bool KernelFolder::write(const symgen::GeneratedAssociation& generated, const KernelTarget& target,
                         const SourceFiles& files) {
  nlohmann::json entry = {{"hash", generated.hash},
                          {"profile", target.profile},
                          {"split", generated.chosen_split},
                          {"files", nlohmann::json::object()},
                          {"variants", nlohmann::json::array()}};
  for (const symgen::VariantReport& variant : generated.variants) {
    entry["variants"].push_back(variant_summary(variant));
  }
  bool is_new = false;
  for (const auto& [name, text] : files) {
    entry["files"][name] = symgen::content_hash({text});
    is_new = write_if_changed(name, text) || is_new;
  }
  nlohmann::json& targets = manifest_["associations"][generated.id.text()];
  if (!targets.is_object()) targets = nlohmann::json::object();
  targets[target.name] = std::move(entry);
  return write_if_changed(manifest_name, manifest_.dump(2) + "\n") || is_new;
}

}  // namespace elastogen::selector
