#include "selector/scene/checkpoint.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "runtime/error.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

constexpr int format_version = 4;

nlohmann::json bytes_of(const Vector& vector) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(vector.size()) * sizeof(double));
  std::memcpy(bytes.data(), vector.data(), bytes.size());
  return nlohmann::json::binary(std::move(bytes));
}

Vector vector_of(const nlohmann::json& json) {
  const auto& bytes = json.get_binary();
  Vector vector(static_cast<Eigen::Index>(bytes.size() / sizeof(double)));
  std::memcpy(vector.data(), bytes.data(),
              static_cast<std::size_t>(vector.size()) * sizeof(double));
  return vector;
}

nlohmann::json to_json(const MotionState& state) {
  return {{"step", state.step},
          {"u", bytes_of(state.u)},
          {"v", bytes_of(state.v)},
          {"a", bytes_of(state.a)},
          {"a_before", bytes_of(state.a_before)},
          {"fell_back", state.fell_back}};
}

MotionState motion_of(const nlohmann::json& json) {
  return {json.at("step"),         vector_of(json.at("u")),        vector_of(json.at("v")),
          vector_of(json.at("a")), vector_of(json.at("a_before")), json.at("fell_back")};
}

nlohmann::json to_json(const LoadState& state) {
  return {{"u", bytes_of(state.u)},         {"load_factor", state.load_factor},
          {"increment", state.increment},   {"load_steps", state.load_steps},
          {"iterations", state.iterations}, {"fell_back", state.fell_back}};
}

LoadState load_of(const nlohmann::json& json) {
  return {vector_of(json.at("u")), json.at("load_factor"), json.at("increment"),
          json.at("load_steps"),   json.at("iterations"),  json.at("fell_back")};
}

Checkpoint from_json(const nlohmann::json& json) {
  Checkpoint checkpoint;
  checkpoint.fingerprint = json.at("fingerprint");
  checkpoint.threads = json.at("threads");
  checkpoint.quiet_steps = json.at("quiet_steps");
  checkpoint.history_bytes = json.at("history_bytes");
  if (json.contains("motion")) {
    checkpoint.motion = motion_of(json.at("motion"));
  } else {
    checkpoint.load = load_of(json.at("load"));
  }
  for (const nlohmann::json& entry : json.at("series")) {
    checkpoint.series.push_back({entry.at(0), entry.at(1)});
  }
  return checkpoint;
}

}  // namespace

RunPosition Checkpoint::position(double time_step) const {
  if (motion) return {motion->step, static_cast<double>(motion->step) * time_step};
  return {load->load_steps, load->load_factor};
}

std::filesystem::path checkpoint_file(const std::filesystem::path& folder) {
  return folder / "state.cbor";
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  nlohmann::json json = {{"version", format_version},
                         {"fingerprint", checkpoint.fingerprint},
                         {"threads", checkpoint.threads},
                         {"quiet_steps", checkpoint.quiet_steps},
                         {"history_bytes", checkpoint.history_bytes},
                         {"series", nlohmann::json::array()}};
  if (checkpoint.motion) json["motion"] = to_json(*checkpoint.motion);
  if (checkpoint.load) json["load"] = to_json(*checkpoint.load);
  for (const SeriesFile& entry : checkpoint.series) {
    json["series"].push_back(nlohmann::json::array({entry.time, entry.name}));
  }
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  write_text_file(file, bytes);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const std::string bytes = read_text_file(file, "checkpoint");
  try {
    const nlohmann::json json = nlohmann::json::from_cbor(bytes);
    if (const int version = json.at("version"); version != format_version) {
      throw InputError(fmt::format(
          "{}: a checkpoint of version {}, this program reads {}: start without --resume",
          file.string(), version, format_version));
    }
    return from_json(json);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: this is no checkpoint, or it is damaged ({}): start without "
                    "--resume",
                    file.string(), error.what()));
  }
}

}  // namespace elastogen::selector
