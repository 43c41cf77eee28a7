/// @file Evidence under an unknown bridge. Oracle: the dense multivariate normal, written down once more from
/// the definition of the model and factorised by Eigen (LDLT); for kappa its sum.

#include "lookup/evidence/unknown_evidence.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/lookup/evidence/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kSigma = 2e-5;  // [m]

double log_normal(const VectorXd& difference, const MatrixXd& covariance) {
  const Eigen::LDLT<MatrixXd> factorised(covariance);
  return -0.5 * (static_cast<double>(difference.size()) * std::log(2.0 * std::numbers::pi) +
                 factorised.vectorD().array().log().sum() + difference.dot(factorised.solve(difference)));
}

/// Readings of one row with a little of everything, at every point but one.
struct Question {
  SyntheticLibrary library{3, 4};
  Sensitivities sensitivities;
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  explicit Question(ReadingKind kind, Index columns = 5, std::size_t truth = 5)
      : sensitivities(made_up_sensitivities_of(library, columns)) {
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, std::vector<double>(library.points.size(), 3e-6)};
    const auto intact = library.intact();
    if (is_change(kind)) comparison.before = comparison.after = comparison.measured.displacement;
    for (std::size_t i = 1; i < library.points.size(); ++i) {
      const double wave = 4e-5 * std::sin(static_cast<double>(7 * i));
      const double shown = library.table.row(truth)[i] + wave;
      comparison.measured.displacement[i] = shown;
      comparison.measured.sigma[i] = kSigma * (i % 3 == 0 ? 2.0 : 1.0);
      if (!is_change(kind)) continue;
      comparison.before[i] = intact[i] + 0.7 * wave;
      comparison.after[i] = comparison.before[i] + shown - intact[i];
    }
  }
  Observation observation(const Nuisance& nuisance = {}) const {
    return observe(comparison, {NoiseShape::gaussian, 0.0}, nuisance);
  }
};

/// What a scene changes in the factors: its own or the sum of its blocks' own.
SceneFactors changed_by(const Sensitivities& from, const Scene& scene) {
  const SceneFactors& intact = from.states[0].scenes[0];
  const auto less_intact = [&](SceneFactors own) {
    for (Index i = 0; i < own.bridge.rows(); ++i)
      if (!own.bridge.row(i).isZero()) {
        own.bridge.row(i) -= intact.bridge.row(i);
        own.epoch.row(i) -= intact.epoch.row(i);
      }
    return own;
  };
  if (const SceneFactors* own = from.find(0, scene)) return less_intact(*own);
  SceneFactors sum{0.0 * intact.bridge, 0.0 * intact.epoch};
  for (const BlockId block : scene.removed)
    if (const SceneFactors* own = from.find(0, {{block}})) {
      sum.bridge += less_intact(*own).bridge;
      sum.epoch += less_intact(*own).epoch;
    }
  return sum;
}

/// The whole state of two epochs' displacements (first all points before, then all after) as one Gaussian of
/// independent causes, then the rows that are read.
struct Dense {
  MatrixXd covariance;
  VectorXd mean;
};

Dense two_epochs(const Question& question, std::size_t row, double kappa, double datum, bool levelled_both) {
  const SyntheticLibrary& library = question.library;
  const Sensitivities& from = question.sensitivities;
  const SceneFactors& intact_factors = from.states[0].scenes[0];
  const FirstOrderResidual& residual = from.states[0].residual;
  const ModelError& error = question.comparison.model_error;
  const auto p = static_cast<Index>(library.points.size());
  const Scene scene = library.table.scene(row);
  const SceneFactors change = changed_by(from, scene);
  VectorXd intact(p), predicted(p);
  for (Index i = 0; i < p; ++i) {
    intact[i] = library.intact()[static_cast<std::size_t>(i)];
    predicted[i] = library.table.row(row)[static_cast<std::size_t>(i)];
  }
  Dense dense{MatrixXd::Zero(2 * p, 2 * p), VectorXd(2 * p)};
  dense.mean << intact, predicted;
  const auto add = [&](const MatrixXd& before, const MatrixXd& after, double variance) {
    MatrixXd both(2 * p, before.cols());
    both << before, after;
    dense.covariance += variance * both * both.transpose();
  };
  const MatrixXd none = MatrixXd::Zero(p, 1);
  add(intact_factors.bridge, intact_factors.bridge + change.bridge, kappa);
  add(intact_factors.epoch, MatrixXd::Zero(p, from.of_epoch()), 1.0);
  add(MatrixXd::Zero(p, from.of_epoch()), intact_factors.epoch + change.epoch, 1.0);
  add(residual.bridge, residual.bridge, 1.0);
  add(residual.epoch, MatrixXd::Zero(p, residual.epoch.cols()), 1.0);
  add(MatrixXd::Zero(p, residual.epoch.cols()), residual.epoch, 1.0);
  MatrixXd level = MatrixXd::Ones(p, 1);
  level(0, 0) = 0.0;  // no reading there
  add(levelled_both ? level : none, none, datum * datum);
  add(none, level, datum * datum);
  VectorXd own = VectorXd::Constant(p, error.intact.front());
  add(own.asDiagonal(), own.asDiagonal(), 1.0);
  // What each loss leaves uncertain by itself.
  const auto loss = [&](const SceneFactors& of, const VectorXd& signal) {
    const VectorXd spread = of.bridge.rowwise().squaredNorm(), epochs = of.epoch.rowwise().squaredNorm();
    const double alike = error.common * error.common * signal.squaredNorm() / static_cast<double>(p) +
                         std::pow(residual.common, 2) * spread.mean() +
                         std::pow(residual.epoch_common, 2) * epochs.mean();
    const VectorXd variance = (error.share * signal).array().square().matrix() +
                              std::pow(residual.share, 2) * spread +
                              std::pow(residual.epoch_share, 2) * epochs + VectorXd::Constant(p, alike);
    add(MatrixXd::Zero(p, p), MatrixXd(variance.array().sqrt().matrix().asDiagonal()), 1.0);
  };
  const auto signal_of_block = [&](BlockId block) {
    VectorXd signal(p);
    const auto single = library.table.row(library.row_of({{block}}));
    for (Index i = 0; i < p; ++i) signal[i] = single[static_cast<std::size_t>(i)] - intact[i];
    return signal;
  };
  std::vector<double> shares;
  for (std::size_t b = 0; b < library.blocks; ++b)
    if (const Scene alone{{BlockId{static_cast<std::int32_t>(b)}}}; from.find(0, alone) != nullptr) {
      const SceneFactors of = changed_by(from, alone);
      // A block that carries a point gives NaN there; such rows are not compared with these readings' rows.
      VectorXd signal = signal_of_block(BlockId{static_cast<std::int32_t>(b)});
      double square = 0.0, norm = 0.0;
      for (Index i = 0; i < p; ++i) {
        square += of.bridge.row(i).squaredNorm() + of.epoch.row(i).squaredNorm();
        if (i > 0 && !std::isnan(signal[i])) norm += signal[i] * signal[i];
      }
      shares.push_back(std::sqrt(square / norm));
    }
  std::sort(shares.begin(), shares.end());
  const double typical = shares[shares.size() / 2];
  VectorXd beyond = predicted - intact;
  if (scene.missing() == 2 && from.find(0, scene) != nullptr) {
    loss(change, beyond);
    beyond.setZero();
  } else {
    for (const BlockId block : scene.removed)
      if (const Scene alone{{block}}; from.find(0, alone) != nullptr) {
        loss(changed_by(from, alone), signal_of_block(block));
        beyond -= signal_of_block(block);
      }
  }
  add(none, typical * beyond, 1.0);
  const double rms = beyond.tail(p - 1).norm() / std::sqrt(static_cast<double>(p - 1));
  add(MatrixXd::Zero(p, p), MatrixXd(typical * rms * MatrixXd::Identity(p, p)), 1.0);
  return dense;
}

/// log density of what was read.
double oracle(const Question& question, std::size_t row, double kappa, double datum, Epochs epochs) {
  const auto p = static_cast<Index>(question.library.points.size());
  const Comparison& c = question.comparison;
  Dense dense = two_epochs(question, row, kappa, datum, is_change(c.kind));
  const Index n = p - 1;
  const bool both = is_change(c.kind) && epochs == Epochs::both;
  MatrixXd take = MatrixXd::Zero(both ? 2 * n : n, 2 * p);
  VectorXd y(take.rows());
  for (Index i = 1; i < p; ++i) {
    const auto point = static_cast<std::size_t>(i);
    const double variance = c.measured.sigma[point] * c.measured.sigma[point];
    if (is_change(c.kind)) {
      dense.covariance(i, i) += 0.5 * variance;
      dense.covariance(p + i, p + i) += 0.5 * variance;
    } else {
      dense.covariance(p + i, p + i) += variance;
    }
    if (both) {
      take(i - 1, i) = 1.0;
      y[i - 1] = c.before[point];
      take(n + i - 1, p + i) = 1.0;
      y[n + i - 1] = c.after[point];
    } else {
      take(i - 1, p + i) = 1.0;
      if (is_change(c.kind)) take(i - 1, i) = -1.0;
      y[i - 1] = is_change(c.kind) ? c.after[point] - c.before[point] : c.measured.displacement[point];
    }
  }
  return log_normal(y - take * dense.mean, take * dense.covariance * take.transpose());
}

}  // namespace

TEST_CASE("The evidence of an unknown bridge is that of the dense Gaussian of both epochs") {
  struct Case {
    ReadingKind kind;
    Epochs epochs;
    double datum;
  };
  const auto& [kind, epochs, datum] = GENERATE(values<Case>({{ReadingKind::absolute, Epochs::change, 0.0},
                                                             {ReadingKind::absolute, Epochs::change, 1e-4},
                                                             {ReadingKind::change, Epochs::change, 0.0},
                                                             {ReadingKind::change, Epochs::change, 1e-4},
                                                             {ReadingKind::change, Epochs::both, 0.0},
                                                             {ReadingKind::change, Epochs::both, 1e-4}}));
  const Question question(kind);
  const SceneTable& table = question.library.table;
  const Observation observation = question.observation({0.0, datum, 0.0});
  const UnknownBridge bridge = unknown_bridge(question.comparison, observation, 0.0, {.epochs = epochs});
  const auto rows = all_rows(table);
  const auto logs = scatter_logs(bridge, observation, table, rows, 2);
  std::size_t compared = 0;
  for (const std::size_t row : rows) {
    const auto predicted = table.row(row);
    if (std::any_of(predicted.begin() + 1, predicted.end(), [](double value) { return std::isnan(value); })) {
      CHECK(logs[row][0] == -std::numeric_limits<double>::infinity());
      continue;
    }
    if (std::isnan(predicted[0])) continue;  // the oracle has no prediction for the point without a reading
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
      REQUIRE(logs[row][k] == Approx(oracle(question, row, kScatterFactors[k], datum, epochs)).epsilon(1e-8));
    ++compared;
  }
  CHECK(compared > 20);
}

TEST_CASE(
    "Many columns of the basis count as they are for single blocks, few for what pairs have in common") {
  const Question question(ReadingKind::change, kLeadingColumns + 20);
  const SceneTable& table = question.library.table;
  const Observation observation = question.observation();
  const UnknownBridge bridge = unknown_bridge(question.comparison, observation, 0.0, {});
  std::size_t compared = 0;
  for (std::size_t row = 0; row < table.rows && table.scene(row).missing() < 2; ++row) {
    const auto predicted = table.row(row);
    if (std::any_of(predicted.begin(), predicted.end(), [](double value) { return std::isnan(value); }))
      continue;
    const std::array<std::size_t, 1> rows = {row};
    const auto logs = scatter_logs(bridge, observation, table, rows, 1);
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
      REQUIRE(logs[0][k] ==
              Approx(oracle(question, row, kScatterFactors[k], 0.0, Epochs::change)).epsilon(1e-8));
    ++compared;
  }
  CHECK(compared >= 8);
}

TEST_CASE("Over the scatter the density is the weighted mean of those of each factor") {
  const ScatterLogs logs = {-3.0, -1.0, -2.0, -700.0};
  double sum = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) sum += kScatterPrior[k] * std::exp(logs[k]);
  CHECK(over_scatter(logs) == Approx(std::log(sum)).epsilon(1e-14));
  double weights = 0.0;
  for (const double weight : kScatterPrior) weights += weight;
  CHECK(weights == Approx(1.0).epsilon(1e-15));
}
