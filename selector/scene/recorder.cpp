#include "selector/scene/recorder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "runtime/error.h"
#include "selector/support/names.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

constexpr const char* series_folder = "series";
constexpr const char* series_index = "series.pvd";

/// As a field of a CSV file (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::vector<std::string> column_names(const Scene& scene) {
  std::vector<std::string> names = {"step"};
  if (scene.dynamics) {
    names.insert(names.end(), {"time", "kinetic_energy"});
  } else {
    names.emplace_back("load_factor");
  }
  if (scene.output.energy) names.emplace_back("elastic_energy");
  const auto add_turning = [&](const std::string& quantity) {
    for (const std::string axis : {"x", "y", "z"}) {
      // In the plane things turn about z.
      if (scene.dim == 3 || axis == "z") names.push_back(quantity + axis);
    }
  };
  if (scene.output.momentum) {
    for (const std::string& axis : axes_of(scene.dim)) names.push_back("momentum_" + axis);
    add_turning("angular_momentum_");
  }
  for (const ProbeDescription& probe : scene.probes) {
    for (const char* quantity : {"u", "r"}) {
      for (const std::string& axis : axes_of(scene.dim)) {
        names.push_back(fmt::format("{}_{}{}", probe.name, quantity, axis));
      }
    }
    add_turning(probe.name + "_m");
  }
  return names;
}

}  // namespace

Recorder::Recorder(const Scene& scene, const Problem& problem, Model& model, fs::path folder,
                   RecordIntervals intervals, std::string fingerprint)
    : scene_(scene),
      problem_(problem),
      model_(model),
      folder_(std::move(folder)),
      intervals_(intervals),
      fingerprint_(std::move(fingerprint)),
      columns_(column_names(scene)) {}

void Recorder::open_history(std::ios::openmode mode) {
  history_.open(history_file(), std::ios::binary | mode);
  if (!history_) {
    throw WorkError(
        fmt::format("{}: cannot be written: {}", history_file().string(), std::strerror(errno)));
  }
}

void Recorder::begin_history() {
  open_history(std::ios::trunc);
  std::vector<std::string> fields;
  for (const std::string& column : columns_) fields.push_back(csv_field(column));
  append(join(fields, ",") + "\n");
}

void Recorder::append(const std::string& line) {
  history_ << line << std::flush;
  if (!history_) {
    throw WorkError(
        fmt::format("{}: cannot be written: {}", history_file().string(), std::strerror(errno)));
  }
  history_bytes_ += line.size();
}

void Recorder::start() {
  std::error_code error;
  fs::remove(checkpoint_file(folder_), error);
  fs::remove(folder_ / series_index, error);
  fs::remove(history_file(), error);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / series_folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".vtu")) fs::remove(entry.path(), error);
  }
  if (intervals_.history > 0) begin_history();
}

void Recorder::resume(const Checkpoint& checkpoint) {
  series_ = checkpoint.series;
  for (const SeriesFile& entry : series_) {
    if (fs::exists(folder_ / entry.name)) continue;
    throw InputError(fmt::format("{}: the file {} of the series is missing: start without --resume",
                                 folder_.string(), entry.name));
  }
  if (intervals_.history == 0) return;
  if (checkpoint.history_bytes == 0) return begin_history();
  history_bytes_ = checkpoint.history_bytes;
  std::error_code error;
  if (const auto size = fs::file_size(history_file(), error); error || size < history_bytes_) {
    throw InputError(fmt::format("{}: is missing or too short: start without --resume",
                                 history_file().string()));
  }
  fs::resize_file(history_file(), history_bytes_, error);
  open_history(std::ios::app);
}

bool Recorder::wants(std::int64_t step) const {
  const auto due = [step](std::int64_t interval) { return interval > 0 && step % interval == 0; };
  return due(intervals_.series) || due(intervals_.history);
}

void Recorder::record(std::int64_t step, double time, const BodyState& state) {
  if (intervals_.history > 0 && step % intervals_.history == 0) {
    std::vector<std::string> fields = {fmt::format("{}", step), fmt::format("{}", time)};
    const auto add = [&](double value) { fields.push_back(fmt::format("{}", value)); };
    if (scene_.dynamics) add(state.kinetic_energy);
    if (scene_.output.energy) add(model_.energy(state.displacement));
    const auto dim = static_cast<std::size_t>(scene_.dim);
    const auto add_vector = [&](const std::array<double, 3>& vector) {
      for (std::size_t c = 0; c < dim; ++c) add(vector[c]);
    };
    const auto add_turning = [&](const std::array<double, 3>& vector) {
      for (std::size_t c = dim == 3 ? 0 : 2; c < 3; ++c) add(vector[c]);
    };
    if (scene_.output.momentum) {
      const Momentum momentum = momentum_of(problem_.mesh.mesh, model_.lumped_mass(), state);
      add_vector(momentum.linear);
      add_turning(momentum.angular);
    }
    for (const Probe& probe : problem_.probes) {
      const ProbeResult result = evaluate_probe(probe, problem_.mesh.mesh, state);
      add_vector(result.displacement);
      add_vector(result.reaction);
      add_turning(result.moment);
    }
    append(join(fields, ",") + "\n");
  }
  if (intervals_.series > 0 && step % intervals_.series == 0) {
    const std::string name = fmt::format("{}/step_{:06}.vtu", series_folder, step);
    std::vector<double> density;
    if (scene_.output.energy) density = energy_density(model_, state.displacement);
    write_state(folder_ / name, problem_.mesh, state, density);
    series_.push_back({time, name});
    write_pvd(folder_ / series_index, series_);
  }
}

void Recorder::keep(Checkpoint state, bool must) {
  const Clock::time_point begin = Clock::now();
  if (!must && keeps_ && begin - kept_at_ < 20 * keeping_took_) return;
  state.fingerprint = fingerprint_;
  state.threads = model_.num_threads();
  state.series = series_;
  state.history_bytes = history_bytes_;
  write_checkpoint(checkpoint_file(folder_), state);
  keeps_ = true;
  kept_at_ = Clock::now();
  keeping_took_ = kept_at_ - begin;
}

std::vector<std::string> Recorder::files() const {
  std::vector<std::string> files;
  if (intervals_.series > 0) files.emplace_back(series_index);
  if (intervals_.history > 0) files.emplace_back("history.csv");
  if (scene_.has_steps()) files.push_back(checkpoint_file("").string());
  return files;
}

}  // namespace elastogen::selector
