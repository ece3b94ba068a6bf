#include "selector/bench/speed/speed_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <type_traits>

#include "runtime/error.h"
#include "selector/bench/sqlite.h"
#include "selector/io/atomic_file.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "elastogen speed 2";

/// Statements that make the tables where there are none.
std::string schema() {
  std::string columns;
  const SpeedRecord names;
  for_each_speed_field(names, [&](const char* name, const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    const char* type = std::is_same_v<Member, std::string> ? "TEXT"
                       : std::is_integral_v<Member>        ? "INTEGER"
                                                           : "REAL";
    columns += fmt::format(",\n  \"{}\" {} NOT NULL", name, type);
  });
  return fmt::format(
      "CREATE TABLE IF NOT EXISTS runs (\n"
      "  id INTEGER PRIMARY KEY, started TEXT NOT NULL, processor TEXT NOT NULL,\n"
      "  cores INTEGER NOT NULL, compiler TEXT NOT NULL, version TEXT NOT NULL);\n"
      "CREATE TABLE IF NOT EXISTS records (\n  run INTEGER NOT NULL REFERENCES runs (id){});\n",
      columns);
}

std::string insert_record() {
  std::string values = "?";
  const SpeedRecord members;
  for_each_speed_field(members, [&](const char*, const auto&) { values += ", ?"; });
  return fmt::format("INSERT INTO records VALUES ({})", values);
}

}  // namespace

std::string SpeedRecord::key() const {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {}", benchmark, peer, association, geometry,
                     precision, operation, strategy, mesh, order, elements, threads);
}

struct SpeedDatabase::Connection {
  SqliteConnection sqlite;
  std::int64_t run = 0;
};

SpeedDatabase::SpeedDatabase(const std::filesystem::path& file, const BenchRun& run) {
  create_folder(file.parent_path());
  connection_.reset(new Connection{SqliteConnection(file)});
  SqliteConnection& sqlite = connection_->sqlite;
  sqlite.execute(schema().c_str());
  // A table of another version shall show before anything is measured.
  const SqliteStatement insert(sqlite, insert_record().c_str());
  connection_->run = insert_run(sqlite, run);
}

SpeedDatabase::~SpeedDatabase() = default;

void SpeedDatabase::add(const SpeedRecord& record) {
  SqliteStatement insert(connection_->sqlite, insert_record().c_str());
  insert.bind(connection_->run);
  for_each_speed_field(record, [&](const char*, const auto& member) { insert.bind(member); });
  insert.step();
}

std::string speed_json(const SpeedResults& results) {
  Json peaks = Json::array(), triads = Json::array(), records = Json::array();
  for (const PeakFlops& peak : results.limits.peaks) {
    peaks.push_back({{"precision", peak.single_precision ? "single" : "double"},
                     {"threads", peak.threads},
                     {"gigaflops", peak.gigaflops}});
  }
  for (const TriadBandwidth& triad : results.limits.triads) {
    triads.push_back({{"bytes", triad.bytes},
                      {"threads", triad.threads},
                      {"gigabytes_per_second", triad.gigabytes_per_second}});
  }
  for (const SpeedRecord& record : results.records) {
    Json entry;
    for_each_speed_field(record,
                         [&](const char* name, const auto& member) { entry[name] = member; });
    records.push_back(std::move(entry));
  }
  const BenchRun& run = results.run;
  const Json all = {{"format", format_name},
                    {"run",
                     {{"started", run.started},
                      {"processor", run.processor},
                      {"cores", run.cores},
                      {"compiler", run.compiler},
                      {"version", run.version}}},
                    {"limits", {{"multiply_add", peaks}, {"triad", triads}}},
                    {"records", records}};
  return all.dump(1) + "\n";
}

SpeedResults read_speed_json(const std::filesystem::path& file) {
  SpeedResults results;
  try {
    const Json all = Json::parse(read_text_file(file, "results"));
    if (all.at("format") != format_name) {
      throw InputError(fmt::format("{}: its format is not '{}'", file.string(), format_name));
    }
    const Json& run = all.at("run");
    results.run = {run.at("started"), run.at("processor"), run.at("cores"), run.at("compiler"),
                   run.at("version")};
    for (const Json& peak : all.at("limits").at("multiply_add")) {
      results.limits.peaks.push_back(
          {peak.at("precision") == "single", peak.at("threads"), peak.at("gigaflops")});
    }
    for (const Json& triad : all.at("limits").at("triad")) {
      results.limits.triads.push_back(
          {triad.at("bytes"), triad.at("threads"), triad.at("gigabytes_per_second")});
    }
    for (const Json& entry : all.at("records")) {
      SpeedRecord record;
      for_each_speed_field(record,
                           [&](const char* name, auto& member) { entry.at(name).get_to(member); });
      results.records.push_back(record);
    }
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: is no file that 'elastogen bench' wrote as speed.json ({})",
                                 file.string(), error.what()));
  }
  return results;
}

}  // namespace elastogen::selector
