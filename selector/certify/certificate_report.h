// Certificates as JSON, as a table in Markdown, and as a page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "selector/certify/certificate.h"

namespace elastogen::selector {

/// All figures; of each association and operation the worst inputs in the form that `evaluate`
/// reads.
[[nodiscard]] nlohmann::ordered_json certificates_json(const std::vector<Certificate>& certificates,
                                                       const CertifyOptions& options);

/// The worst figures alone, without families and inputs: what a baseline needs.
[[nodiscard]] nlohmann::ordered_json figures_alone(nlohmann::ordered_json certificates);

/// A table with a line for each association and precision, for a terminal or a document.
[[nodiscard]] std::string certificates_table(const std::vector<Certificate>& certificates);

/// docs/accuracy.md: what the figures mean, and the tables.
[[nodiscard]] std::string certificates_markdown(const std::vector<Certificate>& certificates,
                                                const CertifyOptions& options);

/// A page with every family of every association, coloured by how near to its bound it is.
[[nodiscard]] std::string certificates_html(const std::vector<Certificate>& certificates,
                                            const CertifyOptions& options);

/// What has become worse since a baseline (the JSON of an earlier run): figures above `slack` times
/// the baseline's, counting none below 4 epsilon, and new violations. Empty if nothing has. An
/// operation that an association of the baseline lacks is not compared.
/// @throws InputError  a baseline that does not hold one of the associations
[[nodiscard]] std::vector<std::string> worse_than(const nlohmann::json& baseline,
                                                  const std::string& baseline_name,
                                                  const std::vector<Certificate>& certificates,
                                                  double slack);

}  // namespace elastogen::selector
