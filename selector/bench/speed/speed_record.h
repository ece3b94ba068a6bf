// What the benchmarks of speed measure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "selector/bench/bench_run.h"
#include "selector/bench/speed/machine_limits.h"
#include "selector/bench/speed/timing.h"

namespace elastogen::selector {

/// One operation of one association. Figures that were not measured are 0.
struct SpeedRecord {
  /// "kernels": operands in cache; "operators": on a mesh; "scaling": likewise by size, order and
  /// threads; "peers": beside other programs
  std::string benchmark;
  std::string peer;         ///< whose time it is: "ffcx vectors"; empty: elastogen's
  std::string association;  ///< "stvk-hexa8-q8-none"
  std::string geometry;     ///< "general", "affine", "box"
  std::string precision;    ///< of the kernels: "double", "single"
  std::string operation;    ///< "forces", "product"; of operators also "rebuild" (before products)
  std::string strategy;     ///< of the product: "recompute", "two-stage", "assembled"; else empty
  std::string mesh;         ///< "distorted", "box-shaped"; not of kernels
  std::string order;        ///< of elements and nodes: "natural", "random", "reordered"
  std::size_t elements = 0;
  std::size_t dofs = 0;
  int threads = 1;
  double minimum = 0;  ///< per element [ns]; processor time in one thread, time of day in several
  double median = 0;   ///< likewise
  double flops = 0;    ///< per element; a multiply-add is two
  double bytes = 0;    ///< per element that must be read or written
  double stored = 0;   ///< bytes per element that the model keeps
  double of_peak = 0;  ///< flops per second, of the peak of multiply-adds
  /// Time that the peak or the bandwidth allow at the least, of the minimum.
  double of_roofline = 0;
  /// Of the least time to elastogen's of the same operation in the same round (its product is
  /// "recompute"): median, least and greatest over the rounds. Of "peers".
  double ratio = 0, ratio_least = 0, ratio_most = 0;
  /// Greatest difference of a peer's result from elastogen's, over the greatest component.
  double difference = 0;

  /// What makes a record the same as one of another run.
  [[nodiscard]] std::string key() const;
  /// 10^6 degrees of freedom per second.
  [[nodiscard]] double mdofs() const {
    return static_cast<double>(dofs) / static_cast<double>(elements) / minimum * 1e3;
  }
};

/// Calls `visit(name, member)` for every member, in the order of files and tables.
template <class Record, class Visit>
void for_each_speed_field(Record& record, Visit&& visit) {
  visit("benchmark", record.benchmark);
  visit("peer", record.peer);
  visit("association", record.association);
  visit("geometry", record.geometry);
  visit("precision", record.precision);
  visit("operation", record.operation);
  visit("strategy", record.strategy);
  visit("mesh", record.mesh);
  visit("order", record.order);
  visit("elements", record.elements);
  visit("dofs", record.dofs);
  visit("threads", record.threads);
  visit("minimum_ns", record.minimum);
  visit("median_ns", record.median);
  visit("flops", record.flops);
  visit("bytes", record.bytes);
  visit("stored_bytes", record.stored);
  visit("of_peak", record.of_peak);
  visit("of_roofline", record.of_roofline);
  visit("ratio", record.ratio);
  visit("ratio_least", record.ratio_least);
  visit("ratio_most", record.ratio_most);
  visit("difference", record.difference);
}

struct SpeedResults {
  BenchRun run;
  MachineLimits limits;
  std::vector<SpeedRecord> records;
};

}  // namespace elastogen::selector
