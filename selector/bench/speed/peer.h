// Programs beside which elastogen's operators are timed: folders with an executable `run`, which
// gets a problem as a folder of arrays. bench/peers/README.md says how they talk.
#pragma once

#include <Eigen/SparseCore>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/mesh.h"
#include "runtime/vector.h"
#include "selector/bench/speed/timing.h"

namespace elastogen::selector {

struct Peer {
  std::string name;              ///< of the folder
  std::filesystem::path folder;  ///< has `run`
};

/// Forces and tangent products of one law on one mesh of one element.
struct PeerProblem {
  std::filesystem::path folder;  ///< of the arrays, and of the peers' results
  std::string law;               ///< "stvk"
  std::string element;           ///< "tet4"
  double lambda = 0, mu = 0;     ///< Lame's parameters [Pa]
  double seconds = 0;            ///< to measure each operation for
};

/// One figure of a peer, over the whole mesh.
struct PeerFigure {
  std::string variant;    ///< "scalar", "vectors" ...
  std::string operation;  ///< "forces", "product" ...
  Timing timing;          ///< [s]
};

struct PeerAnswer {
  std::vector<PeerFigure> figures;
  std::vector<std::string> notes;  ///< what it says of itself
  std::string refusal;             ///< why there are no figures: another law, a missing package
};

/// Peers in the folders, by name; of equal names the first.
[[nodiscard]] std::vector<Peer> find_peers(const std::vector<std::filesystem::path>& folders);

/// Writes the arrays of a problem: positions, connectivity, displacement and direction.
void write_peer_problem(const std::filesystem::path& folder, const Mesh& mesh,
                        const Vector& displacement, const Vector& direction);
/// Adds the tangent at the displacement in compressed rows, for peers that multiply matrices.
void write_peer_matrix(const std::filesystem::path& folder,
                       const Eigen::SparseMatrix<double>& matrix);

/// Builds what the peer needs, the first time, and measures.
/// @param builds  folder for what peers build, kept between calls
/// @throws WorkError  when it fails, with the end of what it said
[[nodiscard]] PeerAnswer run_peer(const Peer& peer, const std::filesystem::path& builds,
                                  const PeerProblem& problem);

/// What a peer computed: 3 numbers for each node.
/// @throws WorkError  when there are not as many as there are in `like`
[[nodiscard]] Vector read_peer_result(const Peer& peer, const PeerFigure& figure,
                                      const PeerProblem& problem, const Vector& like);

}  // namespace elastogen::selector
