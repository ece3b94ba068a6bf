#include "selector/bench/sqlite.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "runtime/error.h"

namespace elastogen::selector {

SqliteConnection::SqliteConnection(const std::filesystem::path& file) : name_(file.string()) {
  sqlite3* handle = nullptr;
  const int code =
      sqlite3_open_v2(name_.c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  handle_.reset(handle);  // also after a failure: it holds the message
  if (code != SQLITE_OK) fail();
  sqlite3_busy_timeout(handle, 10'000);
}

void SqliteConnection::execute(const char* sql) {
  if (sqlite3_exec(get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void SqliteConnection::fail() const {
  const int code = sqlite3_errcode(get());
  const char* const reason = sqlite3_errmsg(get());
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) {
    throw InputError(
        fmt::format("{}: is {} ({}): move it away or delete it, and it is made anew", name_,
                    code == SQLITE_NOTADB ? "not an SQLite database" : "damaged", reason));
  }
  throw WorkError(fmt::format("{}: {}", name_, reason));
}

SqliteStatement::SqliteStatement(const SqliteConnection& connection, const char* sql)
    : connection_(connection) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(connection.get(), sql, -1, &statement, nullptr));
  statement_.reset(statement);
}

void SqliteStatement::check(int code) const {
  if (code != SQLITE_OK) connection_.fail();
}

void SqliteStatement::bind(const std::string& text) {
  check(sqlite3_bind_text(statement_.get(), next_parameter_++, text.data(),
                          static_cast<int>(text.size()), SQLITE_TRANSIENT));
}

void SqliteStatement::bind(double number) {
  const int position = next_parameter_++;
  check(std::isnan(number) ? sqlite3_bind_null(statement_.get(), position)
                           : sqlite3_bind_double(statement_.get(), position, number));
}

void SqliteStatement::bind(std::int64_t number) {
  check(sqlite3_bind_int64(statement_.get(), next_parameter_++, number));
}

bool SqliteStatement::step() {
  next_column_ = 0;
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) connection_.fail();
  return code == SQLITE_ROW;
}

void SqliteStatement::read(std::string& text) {
  const int column = next_column_++;
  const auto* const bytes =
      reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  text.assign(bytes == nullptr ? "" : bytes, static_cast<std::size_t>(size));
}

void SqliteStatement::read(double& number) {
  const int column = next_column_++;
  number = sqlite3_column_type(statement_.get(), column) == SQLITE_NULL
               ? std::numeric_limits<double>::quiet_NaN()
               : sqlite3_column_double(statement_.get(), column);
}

void SqliteStatement::read(std::int64_t& number) {
  number = sqlite3_column_int64(statement_.get(), next_column_++);
}

void SqliteStatement::read(int& number) {
  std::int64_t wide = 0;
  read(wide);
  number = static_cast<int>(wide);
}

void SqliteStatement::read(std::size_t& number) {
  std::int64_t wide = 0;
  read(wide);
  number = static_cast<std::size_t>(wide);
}

std::int64_t insert_run(const SqliteConnection& connection, const BenchRun& run) {
  SqliteStatement insert(
      connection,
      "INSERT INTO runs (started, processor, cores, compiler, version) VALUES (?, ?, ?, ?, ?)");
  insert.bind(run.started);
  insert.bind(run.processor);
  insert.bind(run.cores);
  insert.bind(run.compiler);
  insert.bind(run.version);
  insert.step();
  return sqlite3_last_insert_rowid(connection.get());
}

}  // namespace elastogen::selector
