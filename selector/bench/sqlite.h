// SQLite's connection and prepared statements as objects that close themselves.
#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "selector/bench/bench_run.h"

namespace elastogen::selector {

/// An open database.
class SqliteConnection {
 public:
  /// Opens, and creates where there is none; waits up to ten seconds for other processes.
  /// @throws WorkError  when it cannot be opened
  explicit SqliteConnection(const std::filesystem::path& file);

  /// Runs statements without results, given as a constant.
  void execute(const char* sql);

  [[nodiscard]] sqlite3* get() const { return handle_.get(); }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// @throws InputError  when the last error says that the file is no database or is damaged
  /// @throws WorkError   for any other
  [[noreturn]] void fail() const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::string name_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters are bound, and columns read, in their order.
class SqliteStatement {
 public:
  /// @param sql  a constant with '?' for each parameter
  SqliteStatement(const SqliteConnection& connection, const char* sql);

  void bind(const std::string& text);
  void bind(double number);  ///< what is not a number becomes NULL
  void bind(std::int64_t number);
  void bind(int number) { bind(static_cast<std::int64_t>(number)); }
  void bind(std::size_t number) { bind(static_cast<std::int64_t>(number)); }

  /// Goes to the next row; false when there is none. Later reads start at its first column.
  bool step();

  void read(std::string& text);
  void read(double& number);  ///< NULL becomes not a number
  void read(std::int64_t& number);
  void read(int& number);
  void read(std::size_t& number);

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  void check(int code) const;

  const SqliteConnection& connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int next_parameter_ = 1;
  int next_column_ = 0;
};

/// Notes a run in the table `runs`, whose columns are `id` and the members of BenchRun; returns its
/// id.
[[nodiscard]] std::int64_t insert_run(const SqliteConnection& connection, const BenchRun& run);

}  // namespace elastogen::selector
