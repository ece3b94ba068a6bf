#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "runtime/error.h"
#include "selector/bench/speed/operator_speed.h"
#include "selector/bench/speed/peer.h"
#include "selector/bench/speed/speed_mesh.h"
#include "symgen/law/moduli.h"

namespace elastogen::selector {
namespace {

namespace fs = std::filesystem;
using Add = std::function<void(const SpeedRecord&)>;

/// A peer whose result differs more computes something else, and its time says nothing.
constexpr double same_result = 1e-9;

/// About as many unknowns for every element.
std::size_t usual_size(const std::string& element) {
  return symgen::find_element(element).num_nodes() <= 8 ? 100000 : 20000;
}

/// Lame's parameters where the law has just these.
bool has_lame_parameters(const symgen::Law& law) {
  return law.parameters.size() == 2 && law.parameters[0].name == "lambda" &&
         law.parameters[1].name == "mu";
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// One association on one mesh: in each round elastogen, then every peer. What disturbs a round
/// disturbs all of them.
class PeerRounds {
 public:
  PeerRounds(const AssociationKernels& kernels, const Mesh& mesh, const SpeedRecord& start,
             const SpeedOptions& options, const PeerOptions& peers, const MachineLimits& limits)
      : options_(options),
        peers_(peers),
        start_(start),
        add_ours_([this](const SpeedRecord& record) { note(record); }),
        ours_(kernels, mesh, start, options, limits, add_ours_) {
    const symgen::AssociationId& id = kernels.id;
    problem_ = {peers.work / "problem", id.law,         id.element, kernels.parameters[0],
                kernels.parameters[1],  options.seconds};
    write_peer_problem(problem_.folder, mesh, ours_.displacement(), ours_.direction());
    Model model = ours_.make_model(TangentProduct::recompute);
    model.linearize(ours_.displacement());
    Vector f = Vector::Zero(ours_.displacement().size());
    model.forces(ours_.displacement(), f);
    results_["forces"] = f;
    f.setZero();
    model.product(ours_.direction(), 1, f);
    results_["product"] = f;
    if (!peers.with_matrix) return;
    Eigen::SparseMatrix<double> matrix;
    model.assemble(matrix);
    write_peer_matrix(problem_.folder, matrix);
  }

  void run_round() {
    round_.clear();
    ours_.measure_forces();
    for (const std::string& strategy : options_.strategies) ours_.measure_products(strategy);
    for (const Peer& peer : peers_.peers) {
      if (options_.interrupted()) return;
      if (!refused_.contains(peer.name)) ask(peer);
    }
  }

  /// A record for each figure, ours first.
  void finish(const Add& add) const {
    for (const std::string& key : order_) {
      const Samples& samples = samples_.at(key);
      SpeedRecord record = samples.record;
      record.median = median(samples.medians);
      record.ratio = median(samples.ratios);
      record.ratio_least = *std::min_element(samples.ratios.begin(), samples.ratios.end());
      record.ratio_most = *std::max_element(samples.ratios.begin(), samples.ratios.end());
      add(record);
    }
  }

 private:
  struct Samples {
    SpeedRecord record;  ///< with the least time of all rounds
    std::vector<double> medians, ratios;
  };

  /// What a peer answers; nothing if it fails, which shall not lose what others have measured.
  std::optional<PeerAnswer> answer_of(const Peer& peer) {
    try {
      return run_peer(peer, peers_.work / "builds", problem_);
    } catch (const WorkError& error) {
      // Ctrl-C at the terminal ends the peer, too.
      if (!options_.interrupted()) fmt::print(stderr, "warning: {}\n", error.what());
      refused_.insert(peer.name);
      return {};
    }
  }

  void ask(const Peer& peer) {
    const std::optional<PeerAnswer> asked = answer_of(peer);
    if (!asked) return;
    const PeerAnswer& answer = *asked;
    const bool is_first = told_.insert(peer.name).second;
    if (!answer.refusal.empty()) {
      refused_.insert(peer.name);
      options_.tell(answer.refusal);
      return;
    }
    if (is_first) {
      for (const std::string& line : answer.notes) {
        options_.tell(fmt::format("{}: {}", peer.name, line));
      }
    }
    for (const PeerFigure& figure : answer.figures) {
      SpeedRecord record = start_;
      record.peer = peer.name + " " + figure.variant;
      record.operation = figure.operation;
      const double elements = static_cast<double>(record.elements);
      record.minimum = 1e9 * figure.timing.minimum / elements;
      record.median = 1e9 * figure.timing.median / elements;
      if (const auto ours = results_.find(figure.operation); ours != results_.end()) {
        const Vector theirs = read_peer_result(peer, figure, problem_, ours->second);
        record.difference = (theirs - ours->second).lpNorm<Eigen::Infinity>() /
                            ours->second.lpNorm<Eigen::Infinity>();
      }
      // Not less or equal: what is no number differs.
      if (!(record.difference <= same_result)) {
        if (is_first) {
          options_.tell(fmt::format("{} is left out: its {} differ by {:.1e} from ours",
                                    record.peer, record.operation, record.difference));
        }
        continue;
      }
      note(record);
    }
  }

  void note(const SpeedRecord& record) {
    // What peers are compared with: forces, and the product that keeps nothing.
    const bool is_ours = record.peer.empty();
    if (is_ours && (record.strategy.empty() || record.strategy == "recompute")) {
      round_[record.operation] = record.minimum;
    }
    const auto base = round_.find(record.operation);
    const double ratio = base == round_.end() ? 0 : record.minimum / base->second;
    const std::string key = record.key();
    auto [found, is_new] = samples_.try_emplace(key);
    if (is_new) order_.push_back(key);
    Samples& samples = found->second;
    if (is_new || record.minimum < samples.record.minimum) samples.record = record;
    samples.medians.push_back(record.median);
    samples.ratios.push_back(ratio);
  }

  const SpeedOptions& options_;
  const PeerOptions& peers_;
  SpeedRecord start_;
  std::function<void(const SpeedRecord&)> add_ours_;
  OperatorSpeed ours_;
  PeerProblem problem_;
  std::map<std::string, Vector> results_;  ///< ours, by operation
  std::map<std::string, double> round_;    ///< our least times in this round, by operation
  std::map<std::string, Samples> samples_;
  std::vector<std::string> order_;  ///< keys of the samples
  std::set<std::string> refused_, told_;
};

void measure_mesh(const AssociationKernels& kernels, const std::string& shape,
                  const SpeedOptions& options, const PeerOptions& peers,
                  const MachineLimits& limits, const Add& add) {
  const std::size_t size =
      options.elements.empty() ? usual_size(kernels.id.element) : options.elements.front();
  const Mesh mesh = make_speed_mesh(kernels.id, size, shape == "distorted");
  SpeedRecord start = record_on_mesh("peers", kernels, mesh, shape);
  start.order = "natural";
  PeerRounds rounds(kernels, mesh, start, options, peers, limits);
  for (int round = 1; round <= peers.rounds && !options.interrupted(); ++round) {
    options.tell(fmt::format("{} on {} {} elements: round {} of {}", kernels.id.text(),
                             mesh.num_elements(), shape, round, peers.rounds));
    rounds.run_round();
  }
  rounds.finish(add);
}

}  // namespace

void measure_peers(const SpeedOptions& options, const PeerOptions& peers,
                   const MachineLimits& limits, const Add& add) {
  for (const symgen::AssociationId& id : options.associations) {
    const symgen::Law law = symgen::read_law(symgen::find_law_file(id.law, options.law_folders));
    if (!has_lame_parameters(law)) {
      options.tell(fmt::format("{} is left out: peers have laws of lambda and mu", id.text()));
      continue;
    }
    const AssociationKernels kernels = load_kernels(id, options);
    for (const std::string& shape : options.meshes) {
      measure_mesh(kernels, shape, options, peers, limits, add);
      if (options.interrupted()) return;
    }
  }
}

}  // namespace elastogen::selector
