/// @file Factors from sampled bridges. Oracle: covariances summed up from their definition, the dense normal
/// density (LDLT), and samples whose covariance is that of the first order to the last digit.

#include "lookup/readings/sampled_bridges.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "lookup/evidence/scatter_factor.h"
#include "lookup/lookup.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

using namespace voussoir;
using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kSigma = 1e-5;  // [m]
constexpr std::size_t kStates = 2;
const Scene kIntact;

Scene single(int block) {
  return {{BlockId{block}}};
}

const Model& small_bridge() {
  static const Model bridge = make_model(test::small_bridge_file().description);
  return bridge;
}

/// How a variant differs from the nominal bridge at a control point in a state [m].
using Difference = std::function<double(const RecordKey& key, std::size_t state, Index point)>;

struct Making {
  std::size_t variants = 12;  ///< beside the nominal one
  Difference difference{};
  std::optional<Sensitivities> first_order{};
  std::function<bool(const RecordKey& key)> falls = [](const RecordKey&) { return false; };
  int most_missing = 1;
};

Solution made_up_state(const Making& making, const RecordKey& key, std::size_t state) {
  Solution solution = test::made_up_solution(small_bridge(), key.scene);
  solution.outcome = making.falls(key) ? Outcome::collapsed : Outcome::standing;
  solution.moving.clear();
  if (making.falls(key)) solution.moving = {BlockId{0}};
  solution.extent = collapse_extent(small_bridge().layout, solution.moving);
  solution.origin = Origin::solved;
  Field field = solution.displacement;
  const auto& points = small_bridge().control_points;
  for (std::size_t i = 0; i < points.size() && key.variant != kNominalVariant; ++i)
    field(1, value(points[i].node)) += making.difference(key, state, static_cast<Index>(i));
  solution.displacement = to_storage_precision(field);
  return solution;
}

/// A database of the small bridge, as built and as lost.
class Site {
 public:
  explicit Site(const Making& making) : database_(make(making)) {}
  const Database& database() const { return database_; }

 private:
  Database make(const Making& making) const {
    const std::vector<Scene> scenes = all_scenes(small_bridge().layout.size(), making.most_missing);
    DatabaseContent content = test::made_up_content(test::small_bridge_file(), small_bridge(), scenes,
                                                    KeepField::no, 1 + making.variants, kStates);
    content.states = {kBuiltState, kLostState};
    content.sensitivities = making.first_order;
    write_database(folder_ / "made-up.h5", content, [&](std::size_t row) {
      std::vector<Solution> solutions;
      for (std::size_t state = 0; state < kStates; ++state)
        solutions.push_back(made_up_state(making, content.keys[row], state));
      return make_record(content.keys[row], solutions, small_bridge().control_points, KeepField::no,
                         KeepField::no);
    });
    return Database::open(folder_ / "made-up.h5");
  }

  test::TemporaryFolder folder_;
  Database database_;
};

/// A number between -1 and 1 for each of them, the same each time.
double number_of(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  Random random(series_seed(series_seed(series_seed(series_seed(11, a), b), c), d));
  return 2.0 * random.uniform() - 1.0;
}

std::size_t block_of(const Scene& scene) {
  return scene.removed.empty() ? 0 : 1 + static_cast<std::size_t>(value(scene.removed.back()));
}

/// What all scenes of a variant have in common, and a fifth of it in each scene of its own.
double scattered(const RecordKey& key, std::size_t state, Index point) {
  const auto variant = static_cast<std::size_t>(key.variant), at = static_cast<std::size_t>(point);
  const double own = key.scene.removed.empty() ? 0.0 : number_of(variant, state, at, block_of(key.scene));
  return 1e-4 * (number_of(variant, 0, at, 0) + 0.2 * own);
}

/// The first order's factors, which vary from scene to scene, zero where a block is gone.
Sensitivities first_order_of(Index columns) {
  const auto& points = small_bridge().control_points;
  const auto p = static_cast<Index>(points.size());
  Sensitivities made;
  for (Index i = 0; i < columns; ++i)
    made.parameters.push_back({"stiffness " + std::to_string(i), "1", 0.2, false});
  made.parameters.push_back({"temperature", "K", 10.0, true});
  made.basis = MatrixXd::Identity(columns, columns);
  made.scenes = all_scenes(small_bridge().layout.size(), 1);
  for (std::size_t state = 0; state < kStates; ++state) {
    StateSensitivities& one = made.states.emplace_back();
    for (const Scene& scene : made.scenes) {
      SceneFactors factors{MatrixXd::Zero(p, columns), MatrixXd::Zero(p, 1)};
      for (Index i = 0; i < p; ++i) {
        if (scene.lacks(points[static_cast<std::size_t>(i)].block)) continue;
        const auto at = static_cast<std::size_t>(i), block = block_of(scene);
        for (Index j = 0; j < columns; ++j) {
          const auto column = 1000 + static_cast<std::size_t>(j);
          factors.bridge(i, j) = 1e-4 * (number_of(column, 0, at, 0) +
                                         (block == 0 ? 0.0 : 0.2 * number_of(column, state, at, block)));
        }
        factors.epoch(i, 0) = 1e-4 * (1.0 + 0.1 * number_of(9, 9, at, block));
      }
      one.scenes.push_back(std::move(factors));
    }
    one.residual = {MatrixXd::Constant(p, 1, 1e-5), MatrixXd::Constant(p, 1, 1e-5), 0.3, 0.4, 0.1, 0.2};
  }
  return made;
}

VectorXd shown(const Database& database, std::int32_t variant, std::size_t state, const Scene& scene) {
  const SceneTable table = database.table(variant, state);
  const auto row = table.row(table.find(scene).value());
  const VectorXd values = Eigen::Map<const VectorXd>(row.data(), static_cast<Index>(row.size()));
  return values.array().isNaN().select(0.0, values);
}

/// Of the intact bridge's displacements and then the scene's signal: the mean over the variants in which the
/// scene stands of x x^T, x being how far they are from the nominal bridge's.
MatrixXd sampled_covariance(const Database& database, std::size_t state, const Scene& scene,
                            const std::vector<std::int32_t>& variants) {
  const auto p = static_cast<Index>(database.control_points().size());
  const VectorXd gone = shown(database, kNominalVariant, state, scene);
  const auto signal = [&](std::int32_t variant) {
    const VectorXd change = shown(database, variant, state, scene) - shown(database, variant, state, kIntact);
    return VectorXd((gone.array() == 0.0).select(0.0, change));
  };
  MatrixXd sum = MatrixXd::Zero(2 * p, 2 * p);
  for (const std::int32_t variant : variants) {
    VectorXd x(2 * p);
    x << shown(database, variant, state, kIntact) - shown(database, kNominalVariant, state, kIntact),
        signal(variant) - signal(kNominalVariant);
    sum += x * x.transpose();
  }
  return sum / static_cast<double>(variants.size());
}

/// The same of factors, a signal's being widened.
MatrixXd covariance_of(const SceneFactors& intact, const SceneFactors& scene, double widening = 1.0) {
  const Index p = intact.bridge.rows();
  MatrixXd columns(2 * p, intact.bridge.cols());
  columns << intact.bridge, widening * (scene.bridge - intact.bridge);
  for (Index i = 0; i < p; ++i)
    if (scene.bridge.row(i).isZero(0.0)) columns.row(p + i).setZero();
  return columns * columns.transpose();
}

std::vector<std::int32_t> numbers_to(std::int32_t count, std::int32_t without = 0) {
  std::vector<std::int32_t> numbers;
  for (std::int32_t i = 1; i <= count; ++i)
    if (i != without) numbers.push_back(i);
  return numbers;
}

}  // namespace

TEST_CASE("Factors of sampled bridges have the samples' covariance about the nominal bridge") {
  const Site site({.variants = 24, .difference = scattered});
  const SampledBridges sampled = sampled_bridges(site.database());
  CHECK(sampled.count == 24);
  CHECK_FALSE(sampled.has_first_order);
  CHECK(sampled.sensitivities.parameters.empty());
  int compared = 0;
  for (std::size_t state = 0; state < kStates; ++state)
    for (const int block : {0, 3, 12, 37}) {
      const SceneFactors* const intact = sampled.sensitivities.find(state, kIntact),
                         *const scene = sampled.sensitivities.find(state, single(block));
      REQUIRE(intact != nullptr);
      REQUIRE(scene != nullptr);
      const MatrixXd expected = sampled_covariance(site.database(), state, single(block), numbers_to(24));
      CHECK(covariance_of(*intact, *scene).isApprox(expected, 1e-10));
      ++compared;
    }
  CHECK(compared == 8);
}

TEST_CASE("Beside sampled bridges the first order counts as twenty more, each scene with those that stand") {
  const int fallen = 12;
  const std::int32_t where = 5;
  const Sensitivities first = first_order_of(7);
  const Site site({.difference = scattered, .first_order = first, .falls = [&](const RecordKey& key) {
                     return key.variant == where && key.scene == single(fallen);
                   }});
  const SampledBridges sampled = sampled_bridges(site.database());
  CHECK(sampled.count == 12);
  CHECK(sampled.has_first_order);
  const double widening = std::sqrt(1.0 + 0.3 * 0.3 + 0.4 * 0.4);
  const auto p = static_cast<Index>(site.database().control_points().size());
  for (const int block : {3, fallen}) {
    const auto variants = numbers_to(12, block == fallen ? where : 0);
    const auto n = static_cast<double>(variants.size());
    const MatrixXd samples = sampled_covariance(site.database(), 1, single(block), variants),
                   order = covariance_of(*first.find(1, kIntact), *first.find(1, single(block)), widening);
    const MatrixXd expected = (20.0 * order + n * samples) / (20.0 + n);
    const MatrixXd made = covariance_of(*sampled.sensitivities.find(1, kIntact),
                                        *sampled.sensitivities.find(1, single(block)));
    // Of a scene that falls in one bridge the intact bridge's own covariance still has all twelve.
    CHECK(made.bottomRightCorner(p, p).isApprox(expected.bottomRightCorner(p, p), 1e-10));
    if (block != fallen) CHECK(made.isApprox(expected, 1e-10));
  }
  const FirstOrderResidual& residual = sampled.sensitivities.states[1].residual;
  CHECK(residual.share == 0.0);
  CHECK(residual.epoch_share == 0.1);
  CHECK(residual.bridge(0, 0) == Approx(1e-5 * std::sqrt(20.0 / 32.0)));
}

namespace {

/// Readings of every control point, as the nominal bridge without a block shows them, and an error.
ReadingsFile readings_of(const Database& database, ReadingKind kind, bool two_epochs, int block) {
  const std::size_t state = is_change(kind) ? 1 : 0;
  const VectorXd before = shown(database, kNominalVariant, state, kIntact),
                 after = shown(database, kNominalVariant, state, single(block));
  ReadingsFile file{"made up", kind, two_epochs, {}};
  for (std::size_t i = 0; i < database.control_points().size(); ++i) {
    const auto at = static_cast<Index>(i);
    const double error = 2e-5 * number_of(7, i, 7, 7), first = before[at] + 1e-5 * number_of(8, i, 8, 8);
    Reading reading{.sensor = i, .sigma = kSigma};
    reading.silent = database.control_points()[i].block == BlockId{block};
    reading.before = first;
    reading.after = reading.silent ? std::nan("") : first + after[at] - before[at] + error;
    reading.value = is_change(kind) ? reading.after - first : after[at] + error;
    if (reading.silent) reading.value = std::nan("");
    file.readings.push_back(reading);
  }
  return file;
}

struct Asked {
  Comparison comparison;
  Answer answer;
};

Asked ask(const Database& database, const ReadingsFile& file, Epochs epochs, ScatterEvidence evidence,
          Conditions conditions = Conditions::known) {
  const SensorList list = control_point_sensors(database.control_points());
  Asked asked{compare(file, list, database, {.sampled = sampled_bridges(database, evidence)}), {}};
  LookupSettings settings;
  settings.noise = {NoiseShape::gaussian, 0.0};
  settings.epochs = epochs;
  settings.conditions = conditions;
  asked.answer = locate_damage(asked.comparison, settings);
  return asked;
}

double log_normal(const VectorXd& difference, const MatrixXd& covariance) {
  const Eigen::LDLT<MatrixXd> factorised(covariance);
  return -0.5 * (static_cast<double>(difference.size()) * std::log(2.0 * std::numbers::pi) +
                 factorised.vectorD().array().log().sum() + difference.dot(factorised.solve(difference)));
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
  const MatrixXd all = sampled_covariance(database, 1, scene, numbers_to(variants)).bottomRightCorner(p, p);
  const MatrixXd covariance = all(points, points);
  const MatrixXd noise = kSigma * kSigma * MatrixXd::Identity(covariance.rows(), covariance.cols());
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
  const Asked asked = ask(database, readings_of(database, ReadingKind::change, false, truth), Epochs::change,
                          ScatterEvidence::variants);
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

namespace {

/// Sensitivities without epochs' own parameters, of which the first order leaves nothing: what samples can
/// show exactly.
Sensitivities exact_first_order(Index columns) {
  Sensitivities made = first_order_of(columns);
  for (StateSensitivities& state : made.states) {
    state.residual.share = state.residual.common = 0.0;
    state.residual.bridge.setZero();
  }
  return made;
}

}  // namespace

TEST_CASE("Bridges that are one derivative away from the nominal one each give the first order's answer") {
  const Index columns = 9;
  const Sensitivities first = exact_first_order(columns);
  // Variants 2 i + 1 and 2 i + 2 go along column i, in both ways: the mean of x x^T is A A^T.
  const auto one_column = [&](const RecordKey& key, std::size_t state, Index point) {
    const Index column = (key.variant - 1) / 2;
    const double size = std::sqrt(static_cast<double>(columns)) * (key.variant % 2 == 1 ? 1.0 : -1.0);
    return size * first.find(state, key.scene)->bridge(point, column);
  };
  const Site site({.variants = 2 * columns, .difference = one_column, .first_order = first});
  const Database& database = site.database();
  int compared = 0;
  for (const bool change : {true, false})
    for (const Epochs epochs : {Epochs::change, Epochs::both}) {
      if (!change && epochs == Epochs::both) continue;
      const ReadingsFile file =
          readings_of(database, change ? ReadingKind::change : ReadingKind::absolute, change, 12);
      for (const Conditions conditions : {Conditions::known, Conditions::uncertain}) {
        const Asked order = ask(database, file, epochs, ScatterEvidence::first_order, conditions),
                    variants = ask(database, file, epochs, ScatterEvidence::variants, conditions);
        const auto &expected = order.answer.posterior->probability,
                   &found = variants.answer.posterior->probability;
        for (std::size_t row = 0; row < expected.size(); ++row)
          // Fields are stored in single precision: 1e-10 m of a spread of 1e-4 m.
          CHECK(found[row] == Approx(expected[row]).margin(2e-3));
        CHECK(variants.comparison.sampled->count == 18);
        CHECK(order.comparison.sampled == nullptr);
        ++compared;
      }
    }
  CHECK(compared == 6);
}

TEST_CASE("What sampled bridges cannot tell is said, with what to do") {
  const Site none({.variants = 0}), few({.variants = 9, .difference = scattered}),
      intact_only({.variants = 20, .difference = scattered, .most_missing = 0}),
      alone({.variants = 20, .difference = scattered});
  CHECK_THROWS_WITH(sampled_bridges(none.database()),
                    Contains("made-up.h5") && Contains("no sampled bridge") && Contains("--variants"));
  CHECK_THROWS_WITH(sampled_bridges(few.database()),
                    Contains("9 sampled bridges") && Contains("at least 20") && Contains("--variants"));
  CHECK_THROWS_WITH(sampled_bridges(intact_only.database()), Contains("--scenes singles"));
  CHECK(sampled_bridges(few.database(), ScatterEvidence::first_order) == nullptr);
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
