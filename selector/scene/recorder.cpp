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

constexpr const char* points_index = "points.pvd";

std::string step_file(const std::string& stem, std::int64_t step) {
  return fmt::format("{}/{}_{:06}.vtu", series_folder, stem, step);
}

std::vector<HistoryColumn> history_columns(const Scene& scene) {
  std::vector<HistoryColumn> columns;
  const auto add = [&](const std::string& name) { columns.push_back({name, {}}); };
  add("step");
  if (scene.dynamics) {
    add("time");
    add("kinetic_energy");
  } else {
    add("load_factor");
  }
  if (scene.output.energy) add("elastic_energy");
  const auto add_turning = [&](const std::string& start, const std::string& quantity) {
    for (const std::string axis : {"x", "y", "z"}) {
      // In the plane things turn about z.
      if (scene.dim == 3 || axis == "z") columns.push_back({start + axis, quantity});
    }
  };
  if (scene.output.momentum) {
    for (const std::string& axis : axes_of(scene.dim)) add("momentum_" + axis);
    add_turning("angular_momentum_", "");
  }
  for (const ProbeDescription& probe : scene.probes) {
    for (const char* quantity : {"u", "r"}) {
      for (const std::string& axis : axes_of(scene.dim)) {
        columns.push_back({fmt::format("{}_{}{}", probe.name, quantity, axis), quantity});
      }
    }
    add_turning(probe.name + "_m", "m");
    if (!shows_probe_fields(scene)) continue;
    for (const OutputField* field : scene.output.fields.fields) {
      if (!field->of_points()) continue;
      for (const FieldShape& shape : field_shapes(*field)) {
        const std::string name = fmt::format("{}_{}", probe.name, shape.name);
        if (shape.components.empty()) columns.push_back({name, shape.name});
        for (const std::string& component : shape.components) {
          columns.push_back({name + "_" + component, shape.name + "." + component});
        }
      }
    }
  }
  return columns;
}

}  // namespace

Recorder::Recorder(const Scene& scene, const Problem& problem, Model& model, FieldEvaluator& fields,
                   fs::path folder, RecordIntervals intervals, std::string fingerprint)
    : scene_(scene),
      problem_(problem),
      model_(model),
      fields_(fields),
      folder_(std::move(folder)),
      intervals_(intervals),
      fingerprint_(std::move(fingerprint)),
      columns_(history_columns(scene)) {}

void Recorder::open_history(std::ios::openmode mode) {
  history_.open(history_file(), std::ios::binary | mode);
  if (!history_) {
    throw WorkError(
        fmt::format("{}: cannot be written: {}", history_file().string(), std::strerror(errno)));
  }
}

std::string Recorder::header() const {
  std::vector<std::string> fields;
  for (const HistoryColumn& column : columns_) fields.push_back(csv_field(column.name));
  return join(fields, ",");
}

void Recorder::begin_history() {
  open_history(std::ios::trunc);
  append(header() + "\n");
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
  fs::remove(folder_ / points_index, error);
  fs::remove(folder_ / points_file, error);
  fs::remove(folder_ / stress_picture, error);
  fs::remove(history_file(), error);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / series_folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name.starts_with("step_") || name.starts_with("points_");
    if (ours && name.ends_with(".vtu")) fs::remove(entry.path(), error);
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
  std::string kept;
  std::getline(std::ifstream(history_file()), kept);
  if (kept != header()) {
    throw InputError(
        fmt::format("{}: its columns are '{}', and the scene now asks for '{}': give [output] and "
                    "probes as they were, or start without --resume",
                    history_file().string(), kept, header()));
  }
  fs::resize_file(history_file(), history_bytes_, error);
  open_history(std::ios::app);
}

bool Recorder::wants(std::int64_t step) const {
  const auto due = [step](std::int64_t interval) { return interval > 0 && step % interval == 0; };
  return due(intervals_.series) || due(intervals_.history);
}

void Recorder::record(std::int64_t step, double time, const BodyState& state) {
  if (intervals_.history > 0 && step % intervals_.history == 0) record_history(step, time, state);
  if (intervals_.series > 0 && step % intervals_.series == 0) record_series(step, time, state);
}

void Recorder::record_history(std::int64_t step, double time, const BodyState& state) {
  std::vector<std::string> row = {fmt::format("{}", step), fmt::format("{}", time)};
  const auto add = [&](double value) { row.push_back(fmt::format("{}", value)); };
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
  for (const ProbeResult& probe : evaluate_probes(scene_, problem_, state, fields_)) {
    add_vector(probe.displacement);
    add_vector(probe.reaction);
    add_turning(probe.moment);
    for (const FieldArray& field : probe.fields) {
      for (const double value : field.values) add(value);
    }
  }
  append(join(row, ",") + "\n");
}

void Recorder::record_series(std::int64_t step, double time, const BodyState& state) {
  const FieldValues fields = fields_.at(state.displacement);
  const std::string name = step_file("step", step);
  write_state(folder_ / name, problem_.mesh, state, scene_.output.fields, fields);
  series_.push_back({time, name});
  if (scene_.output.fields.at_points) {
    write_points(folder_ / step_file("points", step), state, fields_, fields);
    // A file of points beside every file of the body, but for those before a resumption that
    // asked for points first.
    std::vector<SeriesFile> points = series_;
    for (SeriesFile& file : points) {
      file.name.replace(file.name.find("/step_"), 6, "/points_");
    }
    std::erase_if(points, [&](const SeriesFile& file) { return !fs::exists(folder_ / file.name); });
    write_pvd(folder_ / points_index, points);
  }
  write_pvd(folder_ / series_index, series_);
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
  if (intervals_.series > 0 && scene_.output.fields.at_points) files.emplace_back(points_index);
  if (intervals_.history > 0) files.emplace_back("history.csv");
  if (scene_.has_steps()) files.push_back(checkpoint_file("").string());
  return files;
}

}  // namespace elastogen::selector
