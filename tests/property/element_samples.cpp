#include "element_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "symgen/element/element.h"
#include "symgen/quadrature/quadrature.h"
#include "tested_kernels.h"

namespace elastogen::test {

using symgen::AssociationId;
using symgen::ElementCase;
using symgen::Law;

std::vector<double> sample_parameters(const Law& law) {
  // Of laws of rubber, whose parameters do not follow from E and nu.
  static const std::map<std::string, double> values = {
      {"c1", 130}, {"c2", 60}, {"c3", 20}, {"kappa", 800}};
  const bool by_name = std::all_of(law.parameters.begin(), law.parameters.end(),
                                   [&](const auto& p) { return values.contains(p.name); });
  if (!by_name) return symgen::parameters_from_young_poisson(law, 1000.0, 0.3);
  std::vector<double> parameters;
  for (const symgen::Parameter& parameter : law.parameters) {
    parameters.push_back(values.at(parameter.name));
  }
  return parameters;
}

void straighten_edges(const symgen::Element& element, std::vector<double>& positions) {
  const auto dim = static_cast<std::size_t>(element.dim);
  const std::size_t corners = element.nodes.size() - element.edges.size();
  for (std::size_t k = 0; k < element.edges.size(); ++k) {
    const auto [a, b] = element.edges[k];
    for (std::size_t i = 0; i < dim; ++i) {
      positions[dim * (corners + k) + i] = (positions[dim * a + i] + positions[dim * b + i]) / 2;
    }
  }
}

ElementCase sample_case(const AssociationId& id, const Law& law, const SampleOptions& options) {
  std::mt19937 generator(options.seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const symgen::Element& element = symgen::find_element(id.element);
  const std::array<double, 3> edges{1.0, 0.75, 1.5};
  // Nodes in the middle of edges halve the distance between nodes, and what they may be moved.
  const double distortion = options.distortion * (element.edges.empty() ? 1.0 : 0.5);
  ElementCase sample;
  for (const auto& node : element.nodes) {
    for (int i = 0; i < element.dim; ++i) {
      const double reference = GiNaC::ex_to<GiNaC::numeric>(node[i].evalf()).to_double();
      sample.rest_positions.push_back(options.box ? edges[i] * reference + 0.25 * i
                                                  : reference + distortion * uniform(generator));
    }
  }
  if (options.straight) straighten_edges(element, sample.rest_positions);
  for (std::size_t k = 0; k < sample.rest_positions.size(); ++k) {
    sample.displacement.push_back(options.strain * uniform(generator));
  }
  for (std::size_t k = 0; k < sample.rest_positions.size(); ++k) {
    sample.direction.push_back(uniform(generator));
  }
  sample.parameters = sample_parameters(law);
  return sample;
}

void make_rigid_motion(ElementCase& sample, int dim, double angle) {
  if (dim == 2) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t a = 0; a < sample.rest_positions.size(); a += 2) {
      const double x = sample.rest_positions[a], y = sample.rest_positions[a + 1];
      sample.displacement[a] = c * x - s * y - x + 0.5;
      sample.displacement[a + 1] = s * x + c * y - y + 1.0;
    }
    return;
  }
  const double length = std::sqrt(14.0);
  const std::array<double, 3> n{1 / length, 2 / length, 3 / length};
  const double c = std::cos(angle), s = std::sin(angle);
  for (std::size_t a = 0; a < sample.rest_positions.size(); a += 3) {
    const double* x = &sample.rest_positions[a];
    const double along = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double cross = n[j] * x[k] - n[k] * x[j];
      const double turned = c * x[i] + s * cross + (1 - c) * along * n[i];
      sample.displacement[a + i] = turned - x[i] + 0.5 * (i + 1);
    }
  }
}

Law law_named(const std::string& name) {
  return symgen::read_law(symgen::find_law_file(
      name, {std::string(ELASTOGEN_SOURCE_DIR) + "/laws", ELASTOGEN_TEST_DATA "/laws"}));
}

std::vector<std::string> unsplit_associations() {
  std::vector<std::string> ids;
  for (const char* name : {"hooke", "neo_hookean", "stvk"}) {
    const bool polynomial = law_named(name).polynomial;
    for (const std::string& element : symgen::element_names()) {
      if (!symgen::find_element(element).edges.empty()) continue;
      for (const std::string& quadrature : symgen::quadrature_names(element)) {
        const bool analytic = symgen::find_quadrature(element, quadrature).polynomial_laws_only;
        if (polynomial || !analytic) {
          ids.push_back(std::string(name) + "-" + element + "-" + quadrature + "-none");
        }
      }
    }
  }
  for (const std::string& id : quadratic_associations()) ids.push_back(id);
  return ids;
}

std::vector<std::string> unsplit_tested() {
  std::vector<std::string> ids = unsplit_associations();
  std::erase_if(ids, [](const std::string& id) { return !is_tested(id); });
  return ids;
}

std::vector<std::string> unsplit_walked() {
  std::vector<std::string> ids = unsplit_tested();
#ifndef ELASTOGEN_CATALOGUE
  std::erase_if(ids, [](const std::string& text) {
    const symgen::AssociationId id = symgen::AssociationId::parse(text);
    return symgen::find_quadrature(id.element, id.quadrature).num_points() >= 20;
  });
#endif
  return ids;
}

std::vector<std::string> quadratic_associations() {
  return {"stvk-tet10-q4-none", "neo_hookean-tet10-q4-none", "stvk-hexa20-q8-none"};
}

std::string test_name(const std::string& association) {
  std::string name = association;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace elastogen::test
