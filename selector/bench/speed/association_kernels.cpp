#include "selector/bench/speed/association_kernels.h"

#include <algorithm>

#include "runtime/error.h"
#include "symgen/law/moduli.h"

namespace elastogen::selector {
namespace {

std::vector<double> usual_parameters(const symgen::Law& law) {
  if (symgen::follows_from_young_poisson(law)) {
    return symgen::parameters_from_young_poisson(law, 1e6, 0.3);
  }
  return std::vector<double>(law.parameters.size(), 1.0);
}

}  // namespace

const symgen::OperationReport& AssociationKernels::report(const std::string& geometry,
                                                          const std::string& operation) const {
  for (const symgen::VariantReport& variant : generated.variants) {
    if (variant.geometry != geometry) continue;
    for (const symgen::OperationReport& report : variant.operations) {
      if (report.name == operation) return report;
    }
  }
  throw InternalError(id.text() + ": no operation " + operation + " (" + geometry + ")");
}

AssociationKernels load_kernels(const symgen::AssociationId& id, const SpeedOptions& options) {
  AssociationKernels kernels;
  kernels.id = id;
  const symgen::Law law = symgen::read_law(symgen::find_law_file(id.law, options.law_folders));
  symgen::check_association(id, law);
  kernels.generated = symgen::generate_association(id, law, options.loader.generate);
  kernels.parameters = usual_parameters(law);
  KernelRequest request{id, law, {}};
  request.what.operations = {"energy", "forces", "product", "linearize", "apply", "stiffness"};
  std::vector<KernelRequest> requests = {request};
  const bool single = std::find(options.precisions.begin(), options.precisions.end(), "single") !=
                      options.precisions.end();
  if (single) {
    request.what.single_precision = true;
    requests.push_back(request);
  }
  const std::vector<LoadedKernels> loaded = KernelLoader(options.loader).load(requests);
  kernels.in_double = loaded[0];
  if (single) kernels.in_single = loaded[1];
  return kernels;
}

}  // namespace elastogen::selector
