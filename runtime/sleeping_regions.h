// Regions of a body that do not move keep their forces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/element_group.h"
#include "runtime/thread_plan.h"
#include "runtime/vector.h"

namespace elastogen {

/// Runs of batches, each of which sleeps or is awake as a whole. A region whose nodes have all
/// stayed within `motion` of where they were, component by component, for a number of calls falls
/// asleep: its forces are computed once more and kept. It wakes as soon as one of its nodes is
/// farther than `motion` from where it fell asleep, whatever moved it: neighbours, loads or
/// constraints. So the forces of every element are those of a displacement that is at most `motion`
/// from the true one.
class SleepingRegions {
 public:
  /// @param motion  [m], > 0
  /// @param calls   of follow(), >= 1
  template <class Scalar>
  SleepingRegions(const std::vector<ElementGroup<Scalar>>& groups, int dim, double motion,
                  int calls);

  /// Takes note of a displacement, node-major in the groups' numbers.
  void follow(const double* u, int threads);

  /// Of the last follow(): whether any region woke or fell asleep; those that fell asleep, whose
  /// forces are to be kept now; and what is awake apart from them.
  [[nodiscard]] bool has_changed() const { return has_changed_; }
  [[nodiscard]] const std::vector<std::size_t>& falling_asleep() const { return falling_asleep_; }
  [[nodiscard]] std::vector<BatchRange> awake() const;

  [[nodiscard]] const BatchRange& batches(std::size_t region) const {
    return regions_[region].batches;
  }
  /// Keeps a region's forces: takes them from `forces`, which has nothing else at its nodes, and
  /// leaves 0 there.
  void keep(std::size_t region, double* forces);
  /// sum += the kept forces of all sleeping regions
  void add_kept(double* sum) const;

  [[nodiscard]] std::size_t num_sleeping_elements() const { return num_sleeping_elements_; }

 private:
  struct Region {
    BatchRange batches;
    std::size_t num_elements = 0;
    std::vector<std::int32_t> dofs;  // of its nodes
    std::vector<double> place;       // their displacement when it moved last, or fell asleep
    std::vector<double> forces;      // kept; of a sleeping region
    int still_calls = 0;
    bool is_asleep = false;
  };
  enum class Change { none, woke, fell_asleep };

  [[nodiscard]] Change follow(Region& region, const double* u) const;

  int dim_;
  double motion_;
  int calls_;
  std::vector<Region> regions_;
  std::vector<Change> changes_;  // [region], of the last call
  std::vector<std::size_t> falling_asleep_;
  bool has_changed_ = false;
  std::size_t num_sleeping_elements_ = 0;
};

}  // namespace elastogen
