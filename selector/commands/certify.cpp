#include "selector/commands/certify.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/error.h"
#include "selector/certify/certificate_report.h"
#include "selector/commands/associations.h"
#include "selector/io/atomic_file.h"
#include "selector/support/files.h"

namespace elastogen::selector {
namespace {

struct CertifyCommand {
  std::vector<std::string> patterns;
  bool shipped = false;
  std::string precision = "both";
  CertifyOptions options;
  std::filesystem::path out;
  std::filesystem::path baseline;
  double slack = 2;
  bool json = false;
};

/// Every shipped law on every linear element with its usual rule; quadratic ones take minutes each.
const std::vector<std::string>& shipped_patterns() {
  static const std::vector<std::string> patterns = {"*-tri3-q1-none",   "*-quad4-q4-none",
                                                    "*-tet4-q1-none",   "*-hexa8-q8-none",
                                                    "*-prism6-q6-none", "*-pyramid5-q5-none"};
  return patterns;
}

template <class Scalar>
Certificate certify_compiled(const symgen::AssociationId& id, const symgen::Law& law,
                             const LoadedKernels& kernels, const symgen::ExactElement& exact,
                             const CertifyCommand& command, const Context& context) {
  const char* precision = std::is_same_v<Scalar, float> ? "float" : "double";
  context.tell(fmt::format("certifying {} in {}", id.text(), precision));
  return certify<Scalar>(id, law, kernels.table<Scalar>(), exact, command.options);
}

int run_certify(const CertifyCommand& command, const Context& context) {
  if (command.shipped == !command.patterns.empty()) {
    throw InputError("give either patterns of associations, such as 'stvk-*-none', or --shipped");
  }
  AssociationFilter filter;
  filter.patterns = command.shipped ? shipped_patterns() : command.patterns;
  const std::vector<symgen::AssociationId> ids = find_associations(filter, context.law_folders());
  std::optional<nlohmann::json> baseline;
  if (!command.baseline.empty()) {
    baseline = nlohmann::json::parse(read_text_file(command.baseline, "baseline"), nullptr, false);
    if (baseline->is_discarded()) {
      throw InputError(fmt::format("{} is no JSON", command.baseline.string()));
    }
  }
  if (!command.out.empty()) check_can_be_written(command.out);

  std::vector<KernelRequest> requests;
  std::vector<symgen::Law> laws;
  for (const symgen::AssociationId& id : ids) {
    laws.push_back(read_law_of(id, context));
    for (const bool single : {false, true}) {
      if (command.precision == (single ? "double" : "float")) continue;
      KernelRequest request{id, laws.back(), {}};
      request.what.single_precision = single;
      request.what.operations = {"energy", "forces", "product", "stiffness", "stress"};
      requests.push_back(std::move(request));
    }
  }
  KernelLoader loader(context.loader_options());
  const std::vector<LoadedKernels> kernels = loader.load(requests);

  std::vector<Certificate> certificates;
  std::size_t next = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const symgen::ExactElement exact(ids[k], laws[k], symgen::Derivation::dag);
    for (; next < requests.size() && requests[next].id == ids[k]; ++next) {
      certificates.push_back(
          requests[next].what.single_precision
              ? certify_compiled<float>(ids[k], laws[k], kernels[next], exact, command, context)
              : certify_compiled<double>(ids[k], laws[k], kernels[next], exact, command, context));
    }
  }

  const nlohmann::ordered_json all = certificates_json(certificates, command.options);
  const std::string json = all.dump() + "\n";
  if (!command.out.empty()) {
    write_text_file(command.out / "certificates.json", json);
    write_text_file(command.out / "accuracy.json", figures_alone(all).dump(1) + "\n");
    write_text_file(command.out / "accuracy.md",
                    certificates_markdown(certificates, command.options));
    write_text_file(command.out / "accuracy.html",
                    certificates_html(certificates, command.options));
  }
  fmt::print("{}", command.json ? json : certificates_table(certificates));
  int violations = 0;
  for (const Certificate& certificate : certificates) {
    violations += certificate.violations();
    for (const FamilyRecord& family : certificate.families) {
      if (family.violations == 0) continue;
      fmt::print(stderr, "violation: {} in {}, {}: {} of {} cases; first: {}\n",
                 certificate.association, certificate.single_precision ? "float" : "double",
                 family.family, family.violations, family.num_cases, family.first_violation);
    }
  }
  std::vector<std::string> worse;
  if (baseline) {
    worse = worse_than(*baseline, command.baseline.string(), certificates, command.slack);
  }
  for (const std::string& line : worse) fmt::print(stderr, "worse: {}\n", line);
  return violations > 0 || !worse.empty() ? 1 : 0;
}

}  // namespace

void add_certify_command(CLI::App& app, Context& context) {
  const auto command = std::make_shared<CertifyCommand>();
  CLI::App* sub = app.add_subcommand(
      "certify", "How wrong compiled kernels are, against exact evaluation in 60 digits");
  sub->footer(
      "Errors are in units of the scalar's epsilon, over random and adversarial inputs; see\n"
      "docs/accuracy.md for what is measured and for the figures of the shipped laws.\n"
      "Exit status: 0; 1 a finite result beyond its bound without a flag, or worse than the\n"
      "baseline; 2 the call was wrong.\n"
      "Examples:\n"
      "  elastogen certify 'neo_hookean-*-none'\n"
      "  elastogen certify my_law-tet4-q1-none --laws . --cases 200 --out certificate\n"
      "  elastogen certify --shipped --out docs");
  sub->add_option("PATTERN", command->patterns, "Globs of whole ids");
  sub->add_flag("--shipped", command->shipped,
                "All laws in the law folders on all linear elements with their usual rules");
  sub->add_option("--precision", command->precision, "Which kernels")
      ->check(CLI::IsMember({"double", "float", "both"}))
      ->capture_default_str();
  sub->add_option("--cases", command->options.cases, "Cases of each kind of input")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub->add_option("--seed", command->options.seed, "Of the random inputs")->capture_default_str();
  sub->add_option(
         "--out", command->out,
         "Folder for certificates.json (all figures, worst inputs), accuracy.json (worst figures), "
         "accuracy.md and accuracy.html")
      ->type_name("DIR");
  sub->add_option("--baseline", command->baseline,
                  "accuracy.json of an earlier run that figures must not be worse than")
      ->type_name("FILE");
  sub->add_option("--slack", command->slack, "Factor above the baseline that is allowed")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  sub->add_flag("--json", command->json, "Print JSON instead of a table");
  sub->callback([command, &context] {
    context.action = [command, &context] { return run_certify(*command, context); };
  });
}

}  // namespace elastogen::selector
