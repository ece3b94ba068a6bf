// What opens every generated file: where it comes from and what it costs.
#pragma once

#include <string>
#include <vector>

#include "symgen/emit/source_writer.h"
#include "symgen/pipeline.h"

namespace elastogen::symgen {

struct Provenance {
  std::string association;
  std::string law_title, law_source;
  std::vector<std::string> law_terms;  ///< "volume: lambda/2*trE^2"
  std::string element, quadrature, split, profile, hash;
};

/// The provenance as comments (`//`), with a table of the operations that `reports` hold.
void print_provenance(const Provenance& provenance, const std::vector<VariantReport>& reports,
                      SourceWriter& out);

}  // namespace elastogen::symgen
