#include "selector/bench/speed/peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>

#include "runtime/error.h"
#include "selector/io/atomic_file.h"
#include "selector/support/files.h"
#include "selector/support/process.h"

namespace elastogen::selector {
namespace fs = std::filesystem;
namespace {

constexpr int does_not_have_it = 3;
constexpr int package_missing = 4;

/// Numbers as they lie in memory.
template <class Range>
void write_array(const fs::path& file, const Range& numbers) {
  const char* first = reinterpret_cast<const char*>(numbers.data());
  write_text_file(file, std::string_view(first, numbers.size() * sizeof(*numbers.data())));
}

/// The last lines of what a program said.
std::string end_of(const std::string& output) {
  constexpr std::size_t most = 2000;
  return output.size() > most ? "..." + output.substr(output.size() - most) : output;
}

std::string first_line(const std::string& output) { return output.substr(0, output.find('\n')); }

/// Lines `VARIANT OPERATION MINIMUM MEDIAN` are figures, those with '#' notes; a peer's tools may
/// say what else they like.
PeerAnswer parse_answer(const std::string& output) {
  PeerAnswer answer;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# ")) {
      answer.notes.push_back(line.substr(2));
      continue;
    }
    std::istringstream words(line);
    PeerFigure figure;
    std::string more;
    if (words >> figure.variant >> figure.operation >> figure.timing.minimum >>
            figure.timing.median &&
        !(words >> more)) {
      answer.figures.push_back(figure);
    }
  }
  return answer;
}

}  // namespace

std::vector<Peer> find_peers(const std::vector<fs::path>& folders) {
  std::vector<Peer> peers;
  for (const fs::path& folder : folders) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      const bool known = std::any_of(peers.begin(), peers.end(),
                                     [&](const Peer& peer) { return peer.name == name; });
      if (!known && fs::exists(entry.path() / "run")) {
        peers.push_back({name, fs::canonical(entry.path())});
      }
    }
  }
  std::sort(peers.begin(), peers.end(),
            [](const Peer& a, const Peer& b) { return a.name < b.name; });
  return peers;
}

void write_peer_problem(const fs::path& folder, const Mesh& mesh, const Vector& displacement,
                        const Vector& direction) {
  create_folder(folder);
  for (const char* file : {"row_begin.i64", "column.i32", "value.f64"}) fs::remove(folder / file);
  write_array(folder / "positions.f64", mesh.positions);
  write_array(folder / "connectivity.i32", mesh.blocks.at(0).nodes);
  write_array(folder / "displacement.f64", std::span(displacement.data(), mesh.positions.size()));
  write_array(folder / "direction.f64", std::span(direction.data(), mesh.positions.size()));
}

void write_peer_matrix(const fs::path& folder, const Eigen::SparseMatrix<double>& matrix) {
  // Compressed columns of a symmetric matrix are its compressed rows.
  const std::vector<std::int64_t> begin(matrix.outerIndexPtr(),
                                        matrix.outerIndexPtr() + matrix.outerSize() + 1);
  const auto entries = static_cast<std::size_t>(matrix.nonZeros());
  write_array(folder / "row_begin.i64", begin);
  write_array(folder / "column.i32", std::span(matrix.innerIndexPtr(), entries));
  write_array(folder / "value.f64", std::span(matrix.valuePtr(), entries));
}

PeerAnswer run_peer(const Peer& peer, const fs::path& builds, const PeerProblem& problem) {
  const fs::path build = fs::absolute(builds / peer.name);
  create_folder(build);
  const ProcessResult result = run_process(
      {(peer.folder / "run").string(), build.string(), fs::absolute(problem.folder).string(),
       problem.law, problem.element, fmt::format("{}", problem.lambda),
       fmt::format("{}", problem.mu), fmt::format("{}", problem.seconds)});
  if (result.signal == 0 &&
      (result.exit_status == does_not_have_it || result.exit_status == package_missing)) {
    PeerAnswer answer;
    answer.refusal = first_line(result.output);
    return answer;
  }
  if (result.signal != 0 || result.exit_status != 0) {
    throw WorkError(fmt::format("the peer {} failed on {} {}: {}", peer.name, problem.law,
                                problem.element, end_of(result.output)));
  }
  return parse_answer(result.output);
}

Vector read_peer_result(const Peer& peer, const PeerFigure& figure, const PeerProblem& problem,
                        const Vector& like) {
  const fs::path file =
      problem.folder / fmt::format("{}.{}.{}.f64", peer.name, figure.variant, figure.operation);
  const std::string bytes = read_text_file(file, "result of a peer");
  Vector values(like.size());
  const std::size_t size = sizeof(double) * static_cast<std::size_t>(values.size());
  if (bytes.size() != size) {
    throw WorkError(fmt::format("{} has {} bytes, where {} numbers take {}", file.string(),
                                bytes.size(), values.size(), size));
  }
  std::memcpy(values.data(), bytes.data(), size);
  return values;
}

}  // namespace elastogen::selector
