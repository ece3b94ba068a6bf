// Kernels by themselves, the runtime's passes over meshes, and those of other programs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "selector/bench/speed/peer.h"
#include "selector/bench/speed/speed_record.h"
#include "selector/jit/kernel_loader.h"
#include "symgen/pipeline.h"

namespace elastogen::selector {

/// What is measured.
struct SpeedOptions {
  std::vector<symgen::AssociationId> associations;
  std::vector<std::filesystem::path> law_folders;
  LoaderOptions loader;
  std::vector<std::string> precisions;  ///< "double", "single"
  std::vector<std::string> meshes;      ///< "distorted", "box-shaped"
  std::vector<std::size_t> elements;    ///< sizes of meshes; empty: three for each element
  std::vector<std::string> orders;      ///< "natural", "random", "reordered"; of scaling
  std::vector<std::string> strategies;  ///< "recompute", "two-stage", "assembled"
  std::vector<int> threads;
  double seconds = 0.2;  ///< for each figure
  std::size_t most_bytes = std::size_t(4)
                           << 30;  ///< meshes whose model would take more are left out
  std::function<void(const std::string&)> tell;
  std::function<bool()> interrupted;
};

/// Every operation of every geometry variant with its operands in the first cache, in one thread.
/// @param add  takes each record as soon as it is measured
/// @throws InputError, WorkError  as KernelLoader::load
void measure_kernels(const SpeedOptions& options, const MachineLimits& limits,
                     const std::function<void(const SpeedRecord&)>& add);

/// Forces, energy, and the products of every strategy with what they need beforehand, on beams of
/// growing size: gather, kernel and addition.
void measure_operators(const SpeedOptions& options, const MachineLimits& limits,
                       const std::function<void(const SpeedRecord&)>& add);

/// Forces and products by number of elements, their order and threads. Sizes that would not fit
/// into the memory that is free are left out.
void measure_scaling(const SpeedOptions& options, const MachineLimits& limits,
                     const std::function<void(const SpeedRecord&)>& add);

/// Whom `measure_peers` compares with.
struct PeerOptions {
  std::vector<Peer> peers;
  bool with_matrix = false;    ///< give them the assembled tangent
  std::filesystem::path work;  ///< folder for what they build and for problems
  int rounds = 3;
};

/// Forces and products in one thread beside those of other programs on the same mesh. A peer whose
/// result differs from ours is said so and left out, and so is one that fails.
void measure_peers(const SpeedOptions& options, const PeerOptions& peers,
                   const MachineLimits& limits, const std::function<void(const SpeedRecord&)>& add);

}  // namespace elastogen::selector
