// The runtime's passes on one mesh, timed.
#pragma once

#include <functional>
#include <string>

#include "runtime/model.h"
#include "selector/bench/speed/association_kernels.h"

namespace elastogen::selector {

/// What every record of operators on a mesh has; in double precision and one thread.
/// @param shape  "distorted" or "box-shaped"
[[nodiscard]] SpeedRecord record_on_mesh(const std::string& benchmark,
                                         const AssociationKernels& kernels, const Mesh& mesh,
                                         const std::string& shape);

/// Operators of one association on one mesh, in the precision and the number of threads that
/// `start` says. What it is given must outlive it.
class OperatorSpeed {
 public:
  /// @param start  of every record: what is known before anything is measured
  /// @param add    takes each record as soon as it is measured
  OperatorSpeed(const AssociationKernels& kernels, const Mesh& mesh, SpeedRecord start,
                const SpeedOptions& options, const MachineLimits& limits,
                const std::function<void(const SpeedRecord&)>& add);

  void measure_forces();
  void measure_energy();
  /// Products, and what they need before where the strategy needs it.
  /// @param strategy  "recompute", "two-stage" or "assembled"
  void measure_products(const std::string& strategy);

  [[nodiscard]] const Vector& displacement() const { return u_; }
  [[nodiscard]] const Vector& direction() const { return v_; }
  [[nodiscard]] Model make_model(TangentProduct product) const;

 private:
  template <class Function>
  void time(Model& model, const std::string& operation, const std::string& strategy,
            Function&& function);
  void count(Model& model, SpeedRecord& record);
  double num_entries(Model& model);

  const AssociationKernels& kernels_;
  const Mesh& mesh_;
  SpeedRecord start_;
  const SpeedOptions& options_;
  const MachineLimits& limits_;
  const std::function<void(const SpeedRecord&)>& add_;
  Vector u_, v_, f_;
  double energy_ = 0;
  double num_entries_ = 0;
};

}  // namespace elastogen::selector
