#include "selector/bench/results_database.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "../temporary_folder.h"
#include "runtime/error.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

/// A point whose members all differ.
WorkPrecisionPoint sample_point() {
  WorkPrecisionPoint point;
  double number = 1;
  for_each_field(point, [&]<class Member>(const char* name, Member& member) {
    number += 1;
    if constexpr (std::is_same_v<Member, std::string>) {
      member = std::string(name) + "; DROP TABLE points --'\"";
    } else {
      member = static_cast<Member>(number + 0.1);
    }
  });
  return point;
}

PointKey key_of(const WorkPrecisionPoint& point, const std::string& hash) {
  return {point.problem, point.program,   point.association, point.resolution,
          point.solver,  point.precision, point.tolerance,   hash};
}

void expect_equal(const WorkPrecisionPoint& found, const WorkPrecisionPoint& expected) {
  std::vector<std::string> texts;
  std::vector<double> numbers;
  for_each_field(expected, [&]<class Member>(const char*, const Member& member) {
    if constexpr (std::is_same_v<Member, std::string>) {
      texts.push_back(member);
    } else {
      numbers.push_back(static_cast<double>(member));
    }
  });
  std::size_t text = 0, number = 0;
  for_each_field(found, [&]<class Member>(const char* name, const Member& member) {
    if constexpr (std::is_same_v<Member, std::string>) {
      EXPECT_EQ(member, texts[text++]) << name;
    } else {
      EXPECT_EQ(static_cast<double>(member), numbers[number++]) << name;
    }
  });
}

const BenchRun run = {"2024-05-17T09:30:00Z", "a processor", 2, "g++ 12.2 -O3", "0.1.0"};

class Database : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "results" / "work_precision.sqlite";
};

TEST_F(Database, KeepsEveryMember) {
  const WorkPrecisionPoint point = sample_point();
  {
    ResultsDatabase database(file);
    database.begin_run(run);
    database.insert(point, "hash");
  }
  const ResultsDatabase database(file);
  ASSERT_EQ(database.points_like(run).size(), 1u);
  expect_equal(database.points_like(run).front(), point);
  ASSERT_EQ(database.runs().size(), 1u);
  EXPECT_EQ(database.runs().front().started, run.started);
  EXPECT_EQ(database.runs().front().processor, run.processor);
  EXPECT_EQ(database.runs().front().cores, run.cores);
  EXPECT_EQ(database.runs().front().compiler, run.compiler);
  EXPECT_EQ(database.runs().front().version, run.version);
}

TEST_F(Database, FindsByTheWholeKey) {
  const WorkPrecisionPoint point = sample_point();
  ResultsDatabase database(file);
  database.begin_run(run);
  database.insert(point, "hash");
  const PointKey key = key_of(point, "hash");
  ASSERT_TRUE(database.find(key).has_value());
  expect_equal(*database.find(key), point);
  for (std::string PointKey::*part :
       {&PointKey::problem, &PointKey::program, &PointKey::association, &PointKey::resolution,
        &PointKey::solver, &PointKey::precision, &PointKey::scene_hash}) {
    PointKey other = key;
    other.*part += "x";
    EXPECT_FALSE(database.find(other).has_value());
  }
  PointKey other = key;
  other.tolerance = std::nextafter(key.tolerance, 0);
  EXPECT_FALSE(database.find(other).has_value());
}

TEST_F(Database, ReplacesAPointWhoseSceneChanged) {
  WorkPrecisionPoint point = sample_point();
  ResultsDatabase database(file);
  database.begin_run(run);
  database.insert(point, "old");
  point.error = 0.25;
  database.insert(point, "new");
  EXPECT_FALSE(database.find(key_of(point, "old")).has_value());
  ASSERT_EQ(database.points_like(run).size(), 1u);
  EXPECT_EQ(database.points_like(run).front().error, 0.25);
}

TEST_F(Database, TellsMachinesAndVersionsApart) {
  ResultsDatabase database(file);
  database.begin_run(run);
  database.insert(sample_point(), "hash");
  BenchRun later = run;
  later.started += "later";
  EXPECT_EQ(database.points_like(later).size(), 1u);
  for (std::string BenchRun::*part :
       {&BenchRun::processor, &BenchRun::compiler, &BenchRun::version}) {
    BenchRun other = run;
    other.*part += "x";
    EXPECT_TRUE(database.points_like(other).empty());
  }
  BenchRun other = run;
  ++other.cores;
  EXPECT_TRUE(database.points_like(other).empty());
}

TEST_F(Database, KeepsAFailureWithoutAFigure) {
  WorkPrecisionPoint point = sample_point();
  point.error = std::numeric_limits<double>::quiet_NaN();
  ResultsDatabase database(file);
  database.begin_run(run);
  database.insert(point, "hash");
  EXPECT_TRUE(std::isnan(database.points_like(run).front().error));
}

TEST_F(Database, LosesNothingWhenKilled) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ResultsDatabase database(file);
    database.begin_run(run);
    database.insert(sample_point(), "hash");
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(ResultsDatabase(file).points_like(run).size(), 1u);
}

TEST_F(Database, RefusesWhatIsNoDatabase) {
  write_text_file(file, "these are notes, and no database at all, however long they may be");
  const std::string message = message_of<InputError>([&] { ResultsDatabase database(file); });
  EXPECT_NE(message.find("not an SQLite database"), std::string::npos) << message;
  EXPECT_EQ(read_text_file(file, "note").substr(0, 5), "these");
}

TEST_F(Database, RefusesADamagedFile) {
  {
    ResultsDatabase database(file);
    database.begin_run(run);
    WorkPrecisionPoint point = sample_point();
    for (point.runs = 0; point.runs < 100; ++point.runs) {
      point.resolution = std::to_string(point.runs);
      database.insert(point, "hash");
    }
  }
  std::string bytes = read_text_file(file, "database");
  for (std::size_t i = 4096; i < 3 * 4096; ++i) bytes[i] = static_cast<char>(0xa5);
  write_text_file(file, bytes);
  const std::string message = message_of<InputError>([&] { ResultsDatabase database(file); });
  EXPECT_NE(message.find("damaged"), std::string::npos) << message;
}

TEST_F(Database, RefusesAnotherProgramsDatabaseAndAnotherVersion) {
  std::filesystem::create_directories(file.parent_path());
  const auto execute = [&](const char* sql) {
    sqlite3* handle = nullptr;
    sqlite3_open(file.c_str(), &handle);
    EXPECT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
  };
  execute("CREATE TABLE notes (text TEXT)");
  std::string message = message_of<InputError>([&] { ResultsDatabase database(file); });
  EXPECT_NE(message.find("not one of benchmark results"), std::string::npos) << message;
  std::filesystem::remove(file);
  { ResultsDatabase database(file); }
  execute("PRAGMA user_version = 7");
  message = message_of<InputError>([&] { ResultsDatabase database(file); });
  EXPECT_NE(message.find("version 7"), std::string::npos) << message;
}

TEST_F(Database, RefusesAFolder) {
  EXPECT_THROW(ResultsDatabase database(folder.path()), InputError);
}

TEST_F(Database, NeedsARunForAPoint) {
  ResultsDatabase database(file);
  EXPECT_THROW(database.insert(sample_point(), "hash"), InternalError);
}

TEST_F(Database, WritesATable) {
  WorkPrecisionPoint point;
  point.problem = "bending";
  point.failure = "said \"no\", and stopped";
  point.error = std::numeric_limits<double>::quiet_NaN();
  point.value = 0.1;
  const std::filesystem::path table = folder.path() / "points.csv";
  write_points_csv(table, {point});
  EXPECT_EQ(
      read_text_file(table, "table"),
      "problem,program,association,law,element,quadrature,resolution,solver,precision,tolerance,"
      "num_elements,num_dofs,error,value,process_seconds,process_seconds_min,cpu_seconds,"
      "mesh,kernels,setup,linearization,linear_solve,forces,output,solve_seconds,runs,scene,"
      "failure\n"
      "bending,,,,,,,,,0,0,0,,0.10000000000000001,0,0,0,0,0,0,0,0,0,0,0,0,,"
      "\"said \"\"no\"\", and stopped\"\n");
}

}  // namespace
}  // namespace elastogen::selector
