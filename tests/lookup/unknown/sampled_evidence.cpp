/// @file Answers from sampled bridges. Oracle: the dense normal density (LDLT) of samples, summed up from its
/// definition; and the first order, where bridges are as it says.

#include <catch2/catch.hpp>

#include "core/error.h"
#include "lookup/lookup.h"
#include "lookup/unknown/scatter_factor.h"
#include "tests/lookup/readings/sampled_site.h"
#include "tests/lookup/unknown/dense_normal.h"

using namespace voussoir;
using namespace voussoir::test;
using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kGauge = 1e-5;  // [m]

/// Readings of every control point, as the nominal bridge without a block shows them, and an error.
ReadingsFile readings_of(const Database& database, ReadingKind kind, bool two_epochs, int block) {
  const std::size_t state = is_change(kind) ? 1 : 0;
  const VectorXd before = shown(database, kNominalVariant, state, kIntact),
                 after = shown(database, kNominalVariant, state, single(block));
  ReadingsFile file{"made up", kind, two_epochs, {}};
  for (std::size_t i = 0; i < database.control_points().size(); ++i) {
    const auto at = static_cast<Index>(i);
    const double error = 2e-5 * number_of(7, i, 7, 7), first = before[at] + 1e-5 * number_of(8, i, 8, 8);
    Reading reading{.sensor = i, .sigma = kGauge};
    reading.silent = database.control_points()[i].block == BlockId{block};
    reading.before = first;
    reading.after = reading.silent ? std::nan("") : first + after[at] - before[at] + error;
    reading.value = is_change(kind) ? reading.after - first : after[at] + error;
    if (reading.silent) reading.value = std::nan("");
    file.readings.push_back(reading);
  }
  return file;
}

struct Answered {
  Comparison comparison;
  Answer answer;
};

Answered ask(const Database& database, const ReadingsFile& file, Epochs epochs, ScatterEvidence evidence,
             Conditions conditions = Conditions::known) {
  const SensorList list = control_point_sensors(database.control_points());
  Answered asked{compare(file, list, database, {.sampled = sampled_bridges(database, evidence)}), {}};
  LookupSettings settings;
  settings.noise = {NoiseShape::gaussian, 0.0};
  settings.epochs = epochs;
  settings.conditions = conditions;
  asked.answer = locate_damage(asked.comparison, settings);
  return asked;
}

/// log p(readings | scene) of the sampled bridges' normal, for the changes alone.
double log_of_change(const Database& database, const Comparison& comparison, const Scene& scene,
                     std::int32_t variants) {
  const auto p = static_cast<Index>(database.control_points().size());
  const VectorXd intact = shown(database, kNominalVariant, 1, kIntact),
                 expected = shown(database, kNominalVariant, 1, scene) - intact;
  std::vector<Index> points;
  for (Index i = 0; i < p; ++i)
    if (!std::isnan(comparison.measured.displacement[static_cast<std::size_t>(i)])) points.push_back(i);
  const VectorXd read =
      Eigen::Map<const VectorXd>(comparison.measured.displacement.data(), p) - intact - expected;
  MatrixXd all = MatrixXd::Zero(p, p);
  for (std::int32_t variant = 1; variant <= variants; ++variant) {
    const VectorXd x = difference_of(database, variant, 1, scene).tail(p);
    all += x * x.transpose() / static_cast<double>(variants);
  }
  const MatrixXd covariance = all(points, points);
  const MatrixXd noise = kGauge * kGauge * MatrixXd::Identity(covariance.rows(), covariance.cols());
  double sum = 0.0;
  for (std::size_t k = 0; k < kScatterFactors.size(); ++k)
    sum += kScatterPrior[k] *
           std::exp(log_normal(read(points), kScatterFactors[k] * covariance + noise) - 500.0);
  return 500.0 + std::log(sum);
}

}  // namespace

TEST_CASE("Sampled bridges alone answer as their dense normal density does") {
  const Site site({.variants = 24, .difference = scattered});
  const Database& database = site.database();
  const int truth = 12;
  const Answered asked = ask(database, readings_of(database, ReadingKind::change, false, truth),
                             Epochs::change, ScatterEvidence::variants);
  REQUIRE(asked.answer.posterior);
  // Of all possible singles, whose weights beforehand are the same.
  const SceneTable& table = asked.comparison.library.table;
  const auto& probability = asked.answer.posterior->probability;
  const std::size_t reference = table.find(single(truth)).value();
  REQUIRE(probability[reference] > 0.0);
  const double best = log_of_change(database, asked.comparison, single(truth), 24);
  int compared = 0;
  for (std::size_t row = 1; row < table.rows; ++row) {
    if (!(probability[row] > 1e-6)) continue;
    const double log = log_of_change(database, asked.comparison, table.scene(row), 24) - best;
    CHECK(std::log(probability[row] / probability[reference]) == Approx(log).margin(1e-6));
    ++compared;
  }
  CHECK(compared > 1);
}

TEST_CASE("Bridges that are as the first order says give its answer") {
  Sensitivities first = first_order_of_stored_bridge();
  for (FirstOrderResidual& residual : first.residuals) {  // it leaves nothing
    residual.share = residual.common = 0.0;
    residual.bridge.setZero();
  }
  const auto exact = [&](const RecordKey& key, std::size_t state, Index point) -> double {
    return first.find(state, key.scene)->bridge.row(point) * position_of(key.variant);
  };
  const Site site({.difference = exact, .first_order = first});
  const Database& database = site.database();
  int compared = 0;
  for (const auto& [kind, epochs] :
       {std::pair(ReadingKind::change, Epochs::change), std::pair(ReadingKind::change, Epochs::both),
        std::pair(ReadingKind::absolute, Epochs::change)})
    for (const Conditions conditions : {Conditions::known, Conditions::uncertain}) {
      const ReadingsFile file = readings_of(database, kind, is_change(kind), 12);
      const Answered order = ask(database, file, epochs, ScatterEvidence::first_order, conditions),
                     variants = ask(database, file, epochs, ScatterEvidence::variants, conditions);
      const auto &expected = order.answer.posterior->probability,
                 &found = variants.answer.posterior->probability;
      for (std::size_t row = 0; row < order.comparison.library.table.rows; ++row)
        // Fields are stored in single precision: 1e-10 m of a spread of 1e-4 m.
        CHECK(found[row] == Approx(expected[row]).margin(1e-3));
      CHECK(variants.answer.bridge->posterior.bridge_mean.norm() ==
            Approx(order.answer.bridge->posterior.bridge_mean.norm()).epsilon(1e-3));
      CHECK(order.comparison.sampled == nullptr);
      CHECK(variants.comparison.sampled->count == 12);
      ++compared;
    }
  CHECK(compared == 6);
}

TEST_CASE("Sampled bridges alone refuse what they cannot tell, with what to do") {
  const Site alone({.variants = 20, .difference = scattered});
  const Database& database = alone.database();
  const auto error = [&](ReadingKind kind, Epochs epochs, Conditions conditions) -> std::string {
    try {
      ask(database, readings_of(database, kind, true, 12), epochs, ScatterEvidence::variants, conditions);
    } catch (const InputError& refused) {
      return refused.what();
    }
    return "";
  };
  CHECK_THAT(error(ReadingKind::change, Epochs::change, Conditions::uncertain),
             Contains("--conditions known") && Contains("sensitivities"));
  CHECK_THAT(error(ReadingKind::change, Epochs::both, Conditions::known), Contains("--epochs change"));
  CHECK_THAT(error(ReadingKind::absolute, Epochs::change, Conditions::known), Contains("expected changes"));
  CHECK(error(ReadingKind::change, Epochs::change, Conditions::known).empty());
}
