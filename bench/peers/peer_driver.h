// What every driver of a peer does alike: reads the problem, times an operation, hands back times
// and results. The protocol is in README.md.
#pragma once

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "selector/bench/speed/timing.h"

namespace elastogen::peers {

/// A law on a mesh of one kind of element, and the vectors that it is evaluated at. Vectors have
/// 3 numbers per node.
struct Problem {
  std::string peer;  // folder of the driver: its results are named after it
  std::filesystem::path folder;
  std::string law, element;
  double lambda = 0, mu = 0;  // Lamé's coefficients [Pa]
  double seconds = 0;         // to measure each operation for
  std::size_t num_nodes = 0;
  std::vector<double> positions, displacement, direction;
  std::vector<std::int32_t> connectivity;  // nodes of each element, in VTK's order
};

/// The numbers in a file, as they lie in memory.
template <class Number>
[[nodiscard]] std::vector<Number> read_array(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<Number> numbers(file ? std::filesystem::file_size(path) / sizeof(Number) : 0);
  const auto bytes = static_cast<std::streamsize>(numbers.size() * sizeof(Number));
  if (!file.read(reinterpret_cast<char*>(numbers.data()), bytes)) {
    throw std::runtime_error("cannot read " + path.string());
  }
  return numbers;
}

/// @param arguments  PEER PROBLEM_FOLDER LAW ELEMENT LAMBDA MU SECONDS
[[nodiscard]] inline Problem read_problem(const std::vector<std::string>& arguments) {
  if (arguments.size() != 7) {
    throw std::runtime_error("needs PEER PROBLEM_FOLDER LAW ELEMENT LAMBDA MU SECONDS");
  }
  Problem problem;
  problem.peer = arguments[0];
  problem.folder = arguments[1];
  problem.law = arguments[2];
  problem.element = arguments[3];
  problem.lambda = std::stod(arguments[4]);
  problem.mu = std::stod(arguments[5]);
  problem.seconds = std::stod(arguments[6]);
  problem.positions = read_array<double>(problem.folder / "positions.f64");
  problem.displacement = read_array<double>(problem.folder / "displacement.f64");
  problem.direction = read_array<double>(problem.folder / "direction.f64");
  problem.connectivity = read_array<std::int32_t>(problem.folder / "connectivity.i32");
  problem.num_nodes = problem.positions.size() / 3;
  return problem;
}

/// Writes the result of an operation, for elastogen to compare with its own.
/// @param result  may have more numbers than the nodes of the problem do, behind theirs
inline void write_result(const Problem& problem, const std::string& variant,
                         const std::string& operation, const std::vector<double>& result) {
  const auto path = problem.folder / (problem.peer + "." + variant + "." + operation + ".f64");
  std::ofstream file(path, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(3 * problem.num_nodes * sizeof(double));
  if (!file.write(reinterpret_cast<const char*>(result.data()), bytes)) {
    throw std::runtime_error("cannot write " + path.string());
  }
}

/// Prints the times of an operation and writes its result.
inline void report(const Problem& problem, const std::string& variant, const std::string& operation,
                   const selector::Timing& time, const std::vector<double>& result) {
  std::printf("%s %s %.6e %.6e\n", variant.c_str(), operation.c_str(), time.minimum, time.median);
  write_result(problem, variant, operation, result);
}

/// Measures and reports `operate`, which leaves its result in `result`.
template <class Function>
void measure(const Problem& problem, const std::string& variant, const std::string& operation,
             const std::vector<double>& result, Function&& operate) {
  const selector::Timing time = selector::time_calls(1, problem.seconds, operate);
  report(problem, variant, operation, time, result);
}

/// The body of a driver's main: exit status 0, or 1 with the reason on the standard error.
inline int run_driver(int argc, char** argv, void (*measure_all)(Problem)) {
  try {
    measure_all(read_problem({argv + 1, argv + argc}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

}  // namespace elastogen::peers
