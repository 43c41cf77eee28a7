/// @file What readings say of a bridge, over scenes, cases and factors of the scatter. Oracle: brute force;
/// of every part one joint Gaussian of the readings and all their causes, solved by Eigen's LU, and the mean
/// of all parts by Bayes' rule.

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "lookup/unknown/bridge_posterior.h"
#include "tests/lookup/unknown/dense_normal.h"
#include "tests/lookup/unknown/made_up_factors.h"
#include "tests/lookup/unknown/widened_loss.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kOwnError = 1e-5;  // [m] of the instruments, beside their share
constexpr std::size_t kMostMissing = 2;
constexpr double kHeaviest = 0.98;  // the heaviest parts that hold this much are all that is averaged

/// Readings without stated errors at all points, of a bridge that lost block 5 or hardly anything.
struct MixedQuestion {
  SyntheticLibrary library{3, 4};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  Epochs epochs;

  MixedQuestion(ReadingKind kind, Epochs both) : epochs(both) {
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.03, 0.04, {}};
    const std::span<const double> intact = library.intact(),
                                  lost = library.table.row(library.row_of({{BlockId{5}}}));
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      const double wave = std::sin(static_cast<double>(7 * i)), signal = 0.5 * (lost[i] - intact[i]);
      comparison.measured.displacement[i] = intact[i] + signal + 5e-5 * wave;
      comparison.before.push_back(intact[i] + 1e-4 * wave);
    }
  }
  Index points() const { return static_cast<Index>(library.points.size()); }
  bool is_absolute() const { return !is_change(comparison.kind); }

  /// From displacements before and after to what is compared: after; the change; or before and the change.
  MatrixXd compared() const {
    const MatrixXd one = MatrixXd::Identity(points(), points()), none = 0.0 * one;
    MatrixXd change(points(), 2 * points()), both(2 * points(), 2 * points());
    change << (is_absolute() ? none : MatrixXd(-one)), one;
    both << one, none, -one, one;
    return epochs == Epochs::both ? both : change;
  }
  /// Displacements of the intact bridge, or as they were shown: before and after.
  VectorXd intact() const {
    return Eigen::Map<const VectorXd>(library.intact().data(), points()).replicate(2, 1);
  }
  VectorXd shown() const {
    VectorXd both(2 * points());
    for (Index i = 0; i < points(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      both[i] = epochs == Epochs::both ? comparison.before[at] : intact()[i];
      both[points() + i] = both[i] + comparison.measured.displacement[at] - library.intact()[at];
    }
    return both;
  }
};

/// Independent causes of what is read: what a unit of each changes, and its variance.
struct PartCauses {
  MatrixXd shows;  // rows before and after
  VectorXd variance;
  Index bridge = 0, epoch = 0, uneven = 0;  // columns: of the bridge first, then of both epochs, of each

  void add(const MatrixXd& before, const MatrixXd& after, double size) {
    const Index old = shows.cols();
    shows.conservativeResize(2 * before.rows(), old + before.cols());
    shows.rightCols(before.cols()) << before, after;
    variance.conservativeResize(old + before.cols());
    variance.tail(before.cols()).setConstant(size);
  }
  void add_each(const MatrixXd& before, const MatrixXd& after, double size) {
    add(before, 0.0 * before, size);
    add(0.0 * after, after, size);
  }
};

/// What the loss of a scene's blocks changes, as the first order says and what it leaves.
SceneFactors loss_of_blocks(const Sensitivities& from, const Scene& scene) {
  const FactorsView intact = from.find(0, {}).value();
  SceneFactors sum{0.0 * intact.bridge, 0.0 * epoch_columns_of(intact)};
  for (const BlockId block : scene.removed) {
    const SceneFactors loss = widened_loss(from, {{block}});
    sum.bridge += loss.bridge;
    sum.epoch += loss.epoch;
  }
  return sum;
}

VectorXd signal_of_loss(const MixedQuestion& question, const Scene& scene) {
  const std::span<const double> row = question.library.table.row(question.library.row_of(scene));
  return Eigen::Map<const VectorXd>(row.data(), question.points()) -
         question.intact().head(question.points());
}

PartCauses causes_of_part(const MixedQuestion& question, const Scene& scene, const UnknownCase& in,
                          double kappa) {
  const Sensitivities& from = question.sensitivities;
  const FirstOrderResidual& left = from.residuals[0];
  const MatrixXd bridge = from.find(0, {})->bridge, epoch = epoch_columns_of(*from.find(0, {}));
  const MatrixXd none = MatrixXd::Zero(question.points(), 1);
  const SceneFactors change = loss_of_blocks(from, scene);
  const double heavy_tails = in.conditions * std::max(1.0, 2.0 * in.conditions);
  PartCauses causes{{}, {}, bridge.cols(), epoch.cols(), from.unevenness[0].cols()};
  causes.add(bridge, bridge + change.bridge, kappa);
  causes.add_each(epoch, epoch + change.epoch, in.conditions * in.conditions);
  causes.add_each(from.unevenness[0], from.unevenness[0], 1.0);
  causes.add(left.bridge, left.bridge, 1.0);
  causes.add_each(left.epoch, left.epoch, heavy_tails * heavy_tails);
  for (std::size_t i = 0; i < kMostMissing; ++i) {  // as many columns for every scene
    const bool lost = i < scene.removed.size();
    causes.add(none, lost ? MatrixXd(signal_of_loss(question, {{scene.removed[i]}})) : none,
               std::pow(0.03, 2) + std::pow(0.04, 2));
  }
  const VectorXd moved = question.shown() - (question.is_absolute() ? 0.0 : 1.0) * question.intact();
  for (Index i = 0; i < 2 * question.points(); ++i) {  // a share of what moved since the reading's origin
    const double movement = question.epochs == Epochs::both ? question.shown()[i] : moved[i];
    const double floor = question.epochs == Epochs::both ? kOwnError / std::sqrt(2.0) : kOwnError;
    const double deviation = in.level * (std::abs(movement) + kSmallestMovement) + floor;
    const bool one_error = question.epochs == Epochs::change && i < question.points();
    const MatrixXd at = VectorXd::Unit(2 * question.points(), i);
    causes.add(at.topRows(question.points()), at.bottomRows(question.points()),
               one_error ? 0.0 : deviation * deviation);
  }
  return causes;
}

/// What one part of the mixture says.
struct MixedPart {
  double log = 0.0, weight = 0.0, kappa = 1.0, chance = 0.0;
  VectorXd mean, signal, bridge, epochs, unevenness, beside, others, spread;
  std::vector<VectorXd*> vectors() {
    return {&mean, &signal, &bridge, &epochs, &unevenness, &beside, &others, &spread};
  }
  MatrixXd covariance;
};

/// Of chi square with an even number of degrees of freedom.
double even_chance_of(double square, Index degrees) {
  double term = std::exp(-0.5 * square), sum = 0.0;
  for (Index k = 0; k < degrees / 2; term *= 0.5 * square / static_cast<double>(++k)) sum += term;
  return sum;
}

/// Each reading against what all others let expect.
void add_leave_one_out(const VectorXd& difference, const MatrixXd& covariance, MixedPart& part) {
  const Index n = difference.size();
  part.beside = part.spread = part.others = VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    std::vector<Index> rest(static_cast<std::size_t>(n));
    std::iota(rest.begin(), rest.end(), Index{0});
    rest.erase(rest.begin() + i);
    const Eigen::FullPivLU<MatrixXd> solver(covariance(rest, rest));
    const VectorXd gain = solver.solve(covariance(rest, i));
    part.beside[i] = difference[i] - gain.dot(VectorXd(difference(rest)));
    part.spread[i] = std::sqrt(covariance(i, i) - gain.dot(VectorXd(covariance(rest, i))));
    part.others[i] = part.beside[i] / part.spread[i];
  }
}

MixedPart mixed_part_of(const MixedQuestion& question, const Scene& scene, const UnknownCase& in,
                        std::size_t k) {
  const PartCauses causes = causes_of_part(question, scene, in, kScatterFactors[k]);
  const MatrixXd design = question.compared() * causes.shows;
  VectorXd predicted = question.intact();
  predicted.tail(question.points()) += signal_of_loss(question, scene);
  const VectorXd difference = question.compared() * (question.shown() - predicted);
  const MatrixXd prior = causes.variance.asDiagonal();
  const MatrixXd covariance = design * prior * design.transpose();
  const Eigen::FullPivLU<MatrixXd> solver(1e8 * covariance);  // near one, for the pivots
  const MatrixXd gain = 1e8 * prior * design.transpose() * solver.inverse();
  MixedPart part;
  part.kappa = kScatterFactors[k];
  part.log = std::log(kScatterPrior[k]) + log_normal(difference, covariance);
  part.mean = gain * difference;
  part.covariance = prior - gain * design * prior;
  part.chance = even_chance_of(1e8 * difference.dot(solver.solve(difference)), difference.size());
  const auto made_by = [&](Index first, Index columns) -> VectorXd {
    return design.middleCols(first, columns) * part.mean.segment(first, columns);
  };
  const Index second = causes.bridge + causes.epoch, parameters = question.sensitivities.of_epoch();
  part.signal = question.compared() * (predicted - question.intact());
  part.bridge = made_by(0, causes.bridge);
  part.epochs = made_by(causes.bridge, parameters) + made_by(second, parameters);
  part.unevenness = made_by(second + causes.epoch, 2 * causes.uneven);
  add_leave_one_out(difference, covariance, part);
  return part;
}

/// All parts, the heaviest first, with their weights.
std::vector<MixedPart> all_parts(const MixedQuestion& question, const std::vector<Scene>& scenes,
                                 const std::vector<double>& probability,
                                 const std::vector<UnknownCase>& cases) {
  std::vector<MixedPart> all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    std::vector<MixedPart> of_scene;
    for (const UnknownCase& in : cases)
      for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
        of_scene.push_back(mixed_part_of(question, scenes[i], in, k));
    const double most = std::ranges::max(of_scene, {}, &MixedPart::log).log;
    double total = 0.0;
    for (MixedPart& part : of_scene) total += part.weight = std::exp(part.log - most);
    for (MixedPart& part : of_scene) part.weight *= probability[i] / total;
    all.insert(all.end(), of_scene.begin(), of_scene.end());
  }
  std::ranges::sort(all, std::ranges::greater{}, &MixedPart::weight);
  return all;
}

/// The heaviest parts' mean and covariance.
MixedPart mean_of_parts(const std::vector<MixedPart>& all) {
  MixedPart mean = all.front();
  mean.chance = 0.0;
  for (VectorXd* of : mean.vectors()) of->setZero();
  mean.covariance.setZero();
  double held = 0.0;
  for (MixedPart part : all)
    if (held < kHeaviest) {
      held += part.weight;
      mean.chance += part.weight * part.chance;
      part.spread = part.spread.cwiseAbs2() + part.beside.cwiseAbs2();
      for (std::size_t i = 0; i < mean.vectors().size(); ++i)
        *mean.vectors()[i] += part.weight * *part.vectors()[i];
      mean.covariance += part.weight * (part.covariance + part.mean * part.mean.transpose());
    }
  mean.chance /= held;
  for (VectorXd* of : mean.vectors()) *of /= held;
  mean.spread = (mean.spread - mean.beside.cwiseAbs2()).cwiseSqrt();
  mean.covariance = mean.covariance / held - mean.mean * mean.mean.transpose();
  return mean;
}

void check_scatter(const BridgePosterior& found, const std::vector<MixedPart>& all) {
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k) {
    double of_kappa = 0.0;
    for (const MixedPart& part : all) of_kappa += part.kappa == kScatterFactors[k] ? part.weight : 0.0;
    CHECK(found.scatter[k] == Approx(of_kappa).epsilon(1e-6));
  }
}

void check_parameters(const BridgePosterior& found, const MixedPart& mean, const MixedQuestion& question) {
  const Index m = found.bridge_mean.size(), e = found.epoch_mean.size();
  const Index first = m + (question.is_absolute() ? e : 0);  // of the second epoch alone
  CHECK(found.bridge_mean.isApprox(mean.mean.head(m), 1e-6));
  CHECK(found.epoch_mean.isApprox(mean.mean.segment(first, e), 1e-6));
  CHECK(found.epoch_covariance.isApprox(mean.covariance.block(first, first, e, e), 1e-6));
  for (Index i = 0; i <= m; ++i) {
    const VectorXd row = question.sensitivities.basis.row(i);
    const double variance = row.dot(mean.covariance.topLeftCorner(m, m) * row);
    CHECK(parameter_estimate(found, row).deviation == Approx(std::sqrt(variance)).epsilon(1e-6));
  }
}

}  // namespace

TEST_CASE("What readings say of a bridge is the mean over scenes, conditions, noise and scatter") {
  const auto [kind, epochs] =
      GENERATE(values<std::pair<ReadingKind, Epochs>>({{ReadingKind::absolute, Epochs::change},
                                                       {ReadingKind::change, Epochs::change},
                                                       {ReadingKind::change, Epochs::both}}));
  const MixedQuestion question(kind, epochs);
  const std::vector<Scene> scenes = {{}, {{BlockId{5}}}, {{BlockId{3}, BlockId{6}}}};
  const std::vector<double> probability = {0.5, 0.3, 0.2};
  const std::vector<UnknownCase> cases = {{0.1, 3.0},  {0.1, 1.0},  {0.1, 0.2},
                                          {0.02, 3.0}, {0.02, 1.0}, {0.02, 0.2}};
  NoiseModel noise{NoiseShape::gaussian};
  noise.floor = kOwnError;
  const Observation observation = observe(question.comparison, noise);
  const UnknownBridge bridge = unknown_bridge(question.comparison, observation, {.epochs = epochs});
  std::vector<WeightedScene> weighted;
  for (std::size_t i = 0; i < scenes.size(); ++i)  // others hold a tenth
    weighted.push_back({question.library.row_of(scenes[i]), 0.9 * probability[i]});
  const BridgePosterior found =
      bridge_posterior(bridge, observation, question.library.table, weighted, cases);
  const std::vector<MixedPart> all = all_parts(question, scenes, probability, cases);
  const MixedPart mean = mean_of_parts(all);
  CHECK(found.parts.size() > 10);  // or it would be no mean
  check_scatter(found, all);
  check_parameters(found, mean, question);
  CHECK(found.chance == Approx(mean.chance).epsilon(1e-6));
  CHECK(found.signal.isApprox(mean.signal, 1e-6));
  CHECK(found.from_bridge.isApprox(mean.bridge, 1e-6));
  CHECK(VectorXd(found.from_epochs.rowwise().sum()).isApprox(mean.epochs, 1e-6));
  CHECK(found.from_unevenness.isApprox(mean.unevenness, 1e-6));
  CHECK(found.beside.isApprox(mean.beside, 1e-6));
  CHECK(found.spread.isApprox(mean.spread, 1e-6));
  CHECK(found.others.isApprox(mean.others, 1e-6));
}
