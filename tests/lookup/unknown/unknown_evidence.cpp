/// @file Evidence under an unknown bridge. Oracle: the dense multivariate normal, written down once more from
/// the definition of the model and factorised by Eigen (LDLT); for kappa its sum.

#include "lookup/unknown/unknown_evidence.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/lookup/unknown/dense_normal.h"
#include "tests/lookup/unknown/made_up_factors.h"
#include "tests/lookup/unknown/widened_loss.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kInstrument = 2e-5;  // [m]

/// Readings of one row with a little of everything, at every point but one.
struct Question {
  SyntheticLibrary library{3, 4, 3};
  Sensitivities sensitivities;
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  explicit Question(ReadingKind kind, Index columns = 5, std::size_t truth = 5)
      : sensitivities(made_up_sensitivities_of(library, columns)) {
    change_together();
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, std::vector<double>(library.points.size(), 3e-6)};
    const auto intact = library.intact();
    if (is_change(kind)) comparison.before = comparison.after = comparison.measured.displacement;
    for (std::size_t i = 1; i < library.points.size(); ++i) {
      const double wave = 4e-5 * std::sin(static_cast<double>(7 * i));
      const double shown = library.table.row(truth)[i] + wave;
      comparison.measured.displacement[i] = shown;
      comparison.measured.sigma[i] = kInstrument * (i % 3 == 0 ? 2.0 : 1.0);
      if (!is_change(kind)) continue;
      comparison.before[i] = intact[i] + 0.7 * wave;
      comparison.after[i] = comparison.before[i] + shown - intact[i];
    }
  }
  /// Two losses and more change something beyond the sum of their own, as those of blocks that touch do.
  void change_together() {
    const std::size_t points = library.points.size();
    for (std::size_t row = 0; row < library.table.rows; ++row) {
      if (library.table.scene(row).missing() < 2) continue;
      for (std::size_t i = 0; i < points; ++i)
        library.vertical[row * points + i] += 6e-5 * std::sin(static_cast<double>(row + 3 * i));
    }
    library.make_index();
  }
  Observation observation(const Nuisance& nuisance = {}) const {
    return observe(comparison, {NoiseShape::gaussian, 0.0}, nuisance);
  }
};

/// What a scene changes in the factors: its own or the sum of its blocks' own.
SceneFactors changed_by(const Sensitivities& from, const Scene& scene) {
  if (!scene.removed.empty() && from.find(0, scene)) return widened_loss(from, scene);
  const FactorsView intact = from.find(0, {}).value();
  SceneFactors sum{0.0 * intact.bridge, 0.0 * epoch_columns_of(intact)};
  for (const BlockId block : scene.removed)
    if (from.find(0, {{block}})) {
      const SceneFactors loss = widened_loss(from, {{block}});
      sum.bridge += loss.bridge;
      sum.epoch += loss.epoch;
    }
  return sum;
}

/// The whole state of two epochs' displacements (first all points before, then all after) as one Gaussian of
/// independent causes.
class TwoEpochs {
 public:
  TwoEpochs(const Question& question, std::size_t row, double kappa, double datum, double conditions)
      : question_(question),
        scene_(question.library.table.scene(row)),
        p_(points()),
        conditions_(conditions) {
    intact_ = displacements(0);
    signal_ = displacements(row) - intact_;
    mean.resize(2 * p_);
    mean << intact_, intact_ + signal_;
    covariance = MatrixXd::Zero(2 * p_, 2 * p_);
    add_parameters(kappa);
    add_common(datum);
    add_losses();
  }
  MatrixXd covariance;
  VectorXd mean;

 private:
  Index points() const { return static_cast<Index>(question_.library.points.size()); }
  VectorXd displacements(std::size_t row) const {
    const auto values = question_.library.table.row(row);
    return Eigen::Map<const VectorXd>(values.data(), p_);
  }
  void add(const MatrixXd& before, const MatrixXd& after, double variance = 1.0) {
    MatrixXd both(2 * p_, before.cols());
    both << before, after;
    covariance += variance * both * both.transpose();
  }
  void add_after(const MatrixXd& after) { add(MatrixXd::Zero(p_, after.cols()), after); }
  void add_each(const MatrixXd& before, const MatrixXd& after) {
    add(before, MatrixXd::Zero(p_, before.cols()));
    add_after(after);
  }

  void add_parameters(double kappa) {
    const FactorsView of = from().find(0, {}).value();
    const SceneFactors intact{of.bridge, epoch_columns_of(of)};
    const SceneFactors change = changed_by(from(), scene_);
    add(intact.bridge, intact.bridge + change.bridge, kappa);
    add_each(conditions_ * intact.epoch, conditions_ * (intact.epoch + change.epoch));
  }

  void add_common(double datum) {
    const FirstOrderResidual& residual = from().residuals[0];
    add(residual.bridge, residual.bridge);
    const double left = conditions_ * std::max(1.0, 2.0 * conditions_);  // with heavy tails
    add_each(left * residual.epoch, left * residual.epoch);
    add_each(from().unevenness[0], from().unevenness[0]);
    MatrixXd level = datum * MatrixXd::Ones(p_, 1);
    level(0, 0) = 0.0;  // no reading there
    add_each(level, level);
    const MatrixXd own = question_.comparison.model_error.intact.front() * MatrixXd::Identity(p_, p_);
    add(own, own);
  }

  /// The model's own error in a loss: one factor of its signal.
  void add_loss(const VectorXd& signal) {
    const ModelError& error = question_.comparison.model_error;
    add_after(std::sqrt(error.share * error.share + error.common * error.common) * signal);
  }

  VectorXd signal_of(BlockId block) const {
    return displacements(question_.library.row_of({{block}})) - intact_;
  }

  /// The median of what single losses' signals spread, as a share of them, at the points with readings.
  double typical_spread() const {
    std::vector<double> shares;
    for (std::size_t b = 0; b < question_.library.blocks; ++b) {
      const BlockId block{static_cast<std::int32_t>(b)};
      if (!from().find(0, {{block}})) continue;
      const SceneFactors of = changed_by(from(), {{block}});
      double norm = 0.0;
      const VectorXd signal = signal_of(block).tail(p_ - 1);
      for (const double one : signal) norm += std::isnan(one) ? 0.0 : one * one;
      shares.push_back(std::sqrt((of.bridge.bottomRows(p_ - 1).squaredNorm() +
                                  conditions_ * conditions_ * of.epoch.bottomRows(p_ - 1).squaredNorm()) /
                                 norm));
    }
    std::sort(shares.begin(), shares.end());
    return shares[shares.size() / 2];
  }

  void add_losses() {
    VectorXd beyond = signal_;
    bool all_known = true;
    if (scene_.missing() == 2 && from().find(0, scene_)) {
      add_loss(signal_);
      beyond.setZero();
    } else {
      for (const BlockId block : scene_.removed) {
        if (!from().find(0, {{block}})) {
          all_known = false;
          continue;
        }
        add_loss(signal_of(block));
        beyond -= signal_of(block);
      }
    }
    const double spread = typical_spread();
    add_after(spread * beyond);
    if (all_known) return;
    const double rms = beyond.tail(p_ - 1).norm() / std::sqrt(static_cast<double>(p_ - 1));
    add_after(spread * rms * MatrixXd::Identity(p_, p_));
  }

  const Sensitivities& from() const { return question_.sensitivities; }

  const Question& question_;
  Scene scene_;
  Index p_;
  double conditions_;
  VectorXd intact_, signal_;
};

/// log density of what was read.
double oracle(const Question& question, std::size_t row, double kappa, double datum, Epochs epochs,
              double conditions) {
  const auto p = static_cast<Index>(question.library.points.size());
  const Comparison& c = question.comparison;
  TwoEpochs dense(question, row, kappa, datum, conditions);
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
    double conditions = 1.0;
  };
  const auto& [kind, epochs, datum, conditions] =
      GENERATE(values<Case>({{ReadingKind::absolute, Epochs::change, 0.0},
                             {ReadingKind::absolute, Epochs::change, 1e-4},
                             {ReadingKind::change, Epochs::change, 0.0},
                             {ReadingKind::change, Epochs::change, 1e-4},
                             {ReadingKind::change, Epochs::change, 0.0, 0.03},
                             {ReadingKind::change, Epochs::both, 0.0},
                             {ReadingKind::change, Epochs::both, 1e-4},
                             {ReadingKind::change, Epochs::both, 0.0, 0.0}}));
  const Question question(kind);
  const SceneTable& table = question.library.table;
  const Observation observation = question.observation({0.0, datum, 0.0});
  const UnknownBridge bridge = unknown_bridge(question.comparison, observation, {.epochs = epochs});
  const CaseNoise noise = case_noise(bridge, observation, {0.0, conditions});
  const auto rows = all_rows(table);
  const auto logs = scatter_logs(bridge, noise, observation, table, rows, 2);
  std::size_t compared = 0;
  for (const std::size_t row : rows) {
    const auto predicted = table.row(row);
    if (std::any_of(predicted.begin() + 1, predicted.end(), [](double value) { return std::isnan(value); })) {
      CHECK(logs[row][0] == -std::numeric_limits<double>::infinity());
      continue;
    }
    if (std::isnan(predicted[0])) continue;  // the oracle has no prediction for the point without a reading
    CAPTURE(to_string(table.scene(row), question.library.layout));
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
      REQUIRE(logs[row][k] ==
              Approx(oracle(question, row, kScatterFactors[k], datum, epochs, conditions)).epsilon(1e-8));
    ++compared;
  }
  CHECK(compared > 60);
}

TEST_CASE(
    "Many columns of the basis count as they are for single blocks, few for what pairs have in common") {
  const Question question(ReadingKind::change, kLeadingColumns + 20);
  const SceneTable& table = question.library.table;
  const Observation observation = question.observation();
  const UnknownBridge bridge = unknown_bridge(question.comparison, observation, {});
  const CaseNoise noise = case_noise(bridge, observation, {});
  std::size_t compared = 0;
  for (std::size_t row = 0; row < table.rows && table.scene(row).missing() < 2; ++row) {
    const auto predicted = table.row(row);
    if (std::any_of(predicted.begin(), predicted.end(), [](double value) { return std::isnan(value); }))
      continue;
    const std::array<std::size_t, 1> rows = {row};
    const auto logs = scatter_logs(bridge, noise, observation, table, rows, 1);
    for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
      REQUIRE(logs[0][k] ==
              Approx(oracle(question, row, kScatterFactors[k], 0.0, Epochs::change, 1.0)).epsilon(1e-8));
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
