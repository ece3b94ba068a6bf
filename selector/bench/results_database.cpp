#include "selector/bench/results_database.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/error.h"
#include "selector/bench/sqlite.h"
#include "selector/io/atomic_file.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

/// Marks the file as ours ("EGwp"), and the version of its tables. Both stand again in `schema`.
constexpr int application_id = 0x45477770;
constexpr int schema_version = 2;

// Columns after `scene_hash` are the members of WorkPrecisionPoint in the order of for_each_field.
constexpr const char* schema = R"(
BEGIN IMMEDIATE;
CREATE TABLE runs (
  id INTEGER PRIMARY KEY,
  started TEXT NOT NULL,
  processor TEXT NOT NULL,
  cores INTEGER NOT NULL,
  compiler TEXT NOT NULL,
  version TEXT NOT NULL);
CREATE TABLE points (
  run INTEGER NOT NULL REFERENCES runs (id),
  scene_hash TEXT NOT NULL,
  problem TEXT NOT NULL,
  program TEXT NOT NULL,
  association TEXT NOT NULL,
  law TEXT NOT NULL,
  element TEXT NOT NULL,
  quadrature TEXT NOT NULL,
  resolution TEXT NOT NULL,
  solver TEXT NOT NULL,
  precision TEXT NOT NULL,
  tolerance REAL NOT NULL,
  num_elements INTEGER NOT NULL,
  num_dofs INTEGER NOT NULL,
  error REAL,
  value REAL,
  process_seconds REAL,
  process_seconds_min REAL,
  cpu_seconds REAL,
  mesh REAL,
  kernels REAL,
  setup REAL,
  linearization REAL,
  linear_solve REAL,
  forces REAL,
  output REAL,
  solve_seconds REAL,
  runs INTEGER NOT NULL,
  scene TEXT NOT NULL,
  failure TEXT NOT NULL,
  UNIQUE (problem, program, association, resolution, solver, precision, tolerance));
PRAGMA application_id = 1162311536;
PRAGMA user_version = 2;
COMMIT;
)";

/// "problem, program, ...": the members of a point, in the order in which they are bound and read.
std::string point_columns() {
  std::string columns;
  const WorkPrecisionPoint names;
  for_each_field(names, [&](const char* name, const auto&) {
    columns += columns.empty() ? name : fmt::format(", {}", name);
  });
  return columns;
}

std::string insert_point() {
  std::string values = "?, ?";  // run and hash
  const WorkPrecisionPoint members;
  for_each_field(members, [&](const char*, const auto&) { values += ", ?"; });
  return fmt::format("INSERT OR REPLACE INTO points (run, scene_hash, {}) VALUES ({})",
                     point_columns(), values);
}

/// @param condition  SQL of our own, what follows FROM points
std::string select_points(const char* condition) {
  return fmt::format("SELECT {} FROM points {}", point_columns(), condition);
}

constexpr const char* with_key =
    "WHERE problem = ? AND program = ? AND association = ? AND resolution = ? AND solver = ? "
    "AND precision = ? AND tolerance = ? AND scene_hash = ?";

constexpr const char* like_a_run =
    "WHERE run IN (SELECT id FROM runs "
    "WHERE processor = ? AND cores = ? AND compiler = ? AND version = ?) "
    "ORDER BY problem, program, association, solver, precision, tolerance, num_dofs, resolution";

static_assert(application_id == 1162311536 && schema_version == 2, "as in the schema");

int single_number(const SqliteConnection& connection, const char* sql) {
  SqliteStatement statement(connection, sql);
  statement.step();
  int number = 0;
  statement.read(number);
  return number;
}

WorkPrecisionPoint read_point(SqliteStatement& row) {
  WorkPrecisionPoint point;
  for_each_field(point, [&](const char*, auto& member) { row.read(member); });
  return point;
}

/// Makes the tables of an empty database, or checks that those of a used one are ours.
void check_or_create_schema(SqliteConnection& connection) {
  const int id = single_number(connection, "PRAGMA application_id");
  const int version = single_number(connection, "PRAGMA user_version");
  const bool empty = single_number(connection, "SELECT count(*) FROM sqlite_master") == 0;
  if (empty && id == 0 && version == 0) {
    connection.execute(schema);
    return;
  }
  if (id != application_id) {
    throw InputError(fmt::format(
        "{}: is a database, but not one of benchmark results: name another folder for results",
        connection.name()));
  }
  if (version != schema_version) {
    throw InputError(fmt::format(
        "{}: its tables are of version {}, this elastogen reads version {}: name another folder "
        "for results, or move the file away",
        connection.name(), version, schema_version));
  }
  SqliteStatement check(connection, "PRAGMA quick_check(1)");
  check.step();
  std::string verdict;
  check.read(verdict);
  if (verdict != "ok") {
    throw InputError(
        fmt::format("{}: is damaged ({}): move it away or delete it, and it is made anew",
                    connection.name(), verdict));
  }
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_field(const std::string& text) { return csv_text(text); }
std::string csv_field(double number) {
  return std::isfinite(number) ? fmt::format("{:.17g}", number) : std::string();
}
std::string csv_field(int number) { return fmt::format("{}", number); }
std::string csv_field(std::size_t number) { return fmt::format("{}", number); }

}  // namespace

struct ResultsDatabase::Connection {
  explicit Connection(const std::filesystem::path& file) : sqlite(file) {}
  SqliteConnection sqlite;
};

ResultsDatabase::ResultsDatabase(const std::filesystem::path& file) {
  if (file.has_parent_path()) create_folder(file.parent_path());
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(
        fmt::format("{}: benchmark results need a file, and this is a folder", file.string()));
  }
  connection_ = std::make_unique<Connection>(file);
  check_or_create_schema(connection_->sqlite);
}

ResultsDatabase::~ResultsDatabase() = default;

void ResultsDatabase::begin_run(const BenchRun& run) {
  run_ = insert_run(connection_->sqlite, run);
}

void ResultsDatabase::insert(const WorkPrecisionPoint& point, const std::string& scene_hash) {
  if (run_ == 0) throw InternalError("a benchmark's point was kept before its run was noted");
  SqliteStatement insert(connection_->sqlite, insert_point().c_str());
  insert.bind(run_);
  insert.bind(scene_hash);
  for_each_field(point, [&](const char*, const auto& member) { insert.bind(member); });
  insert.step();
}

std::optional<WorkPrecisionPoint> ResultsDatabase::find(const PointKey& key) const {
  SqliteStatement select(connection_->sqlite, select_points(with_key).c_str());
  select.bind(key.problem);
  select.bind(key.program);
  select.bind(key.association);
  select.bind(key.resolution);
  select.bind(key.solver);
  select.bind(key.precision);
  select.bind(key.tolerance);
  select.bind(key.scene_hash);
  if (!select.step()) return std::nullopt;
  return read_point(select);
}

std::vector<WorkPrecisionPoint> ResultsDatabase::points_like(const BenchRun& run) const {
  SqliteStatement select(connection_->sqlite, select_points(like_a_run).c_str());
  select.bind(run.processor);
  select.bind(run.cores);
  select.bind(run.compiler);
  select.bind(run.version);
  std::vector<WorkPrecisionPoint> points;
  while (select.step()) points.push_back(read_point(select));
  return points;
}

std::vector<BenchRun> ResultsDatabase::runs() const {
  SqliteStatement select(
      connection_->sqlite,
      "SELECT started, processor, cores, compiler, version FROM runs ORDER BY id");
  std::vector<BenchRun> runs;
  while (select.step()) {
    BenchRun& run = runs.emplace_back();
    select.read(run.started);
    select.read(run.processor);
    select.read(run.cores);
    select.read(run.compiler);
    select.read(run.version);
  }
  return runs;
}

void write_points_csv(const std::filesystem::path& file,
                      const std::vector<WorkPrecisionPoint>& points) {
  std::string text;
  const WorkPrecisionPoint names;
  for_each_field(names, [&](const char* name, const auto&) {
    text += text.empty() ? name : fmt::format(",{}", name);
  });
  text += '\n';
  for (const WorkPrecisionPoint& point : points) {
    std::string line;
    bool first = true;
    for_each_field(point, [&](const char*, const auto& member) {
      if (!first) line += ',';
      first = false;
      line += csv_field(member);
    });
    text += line + '\n';
  }
  write_text_file(file, text);
}

}  // namespace elastogen::selector
