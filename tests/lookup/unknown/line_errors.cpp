/// @file Errors that a line of levelling shares. Oracle: the density of the readings under a covariance with
/// a shift and a tilt of the line in it, from its definition (LDLT); lines written out.

#include "lookup/unknown/line_errors.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <functional>
#include <set>

#include "core/not_a_number.h"
#include "tests/lookup/unknown/explained_readings.h"
#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kShift = 0.4e-3;   // [m]
constexpr std::size_t kOfLine = 6;  // points
constexpr std::size_t kAll = 1000;

/// The intact bridge, read at T1 to T6 and A1 to A6; what is read at the latter is too high at the second
/// time.
struct ShiftedReadings {
  SyntheticLibrary library{3, 6};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison;

  explicit ShiftedReadings(ReadingKind kind)
      : comparison(absolute_readings(named(library), no_measurements(library.points.size()))) {
    comparison.kind = kind;
    comparison.factors = factors_of(library, sensitivities);
    comparison.model_error = {0.02, 0.01, {}};
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] = library.intact()[i] + (i < 6 ? 0.0 : kShift);
      comparison.measured.sigma[i] = 2e-5;
      if (kind == ReadingKind::change) comparison.before.push_back(library.intact()[i] + 1e-5);
    }
  }

  static Library named(SyntheticLibrary& made_up) {
    for (std::size_t i = 6; i < made_up.points.size(); ++i)
      made_up.points[i].name = "A" + std::to_string(i - 5);
    return made_up.library();
  }

  Observation observed(const Nuisance& nuisance = {}) const {
    return observe(comparison, {NoiseShape::gaussian, 0.0}, nuisance);
  }
};

struct Wanted {
  double size = 0.0;
  bool shift = true, tilt = false, first_epoch = false;
};

/// A shift of the channels, and a tilt that makes as much of their end, in rows of y.
MatrixXd line_columns(const UnknownBridge& bridge, const Comparison& comparison, const LineError& line,
                      const Wanted& wanted) {
  double least = 1e9, most = -1e9;
  for (const std::size_t channel : line.channels) {
    least = std::min(least, comparison.library.points[channel].position.x());
    most = std::max(most, comparison.library.points[channel].position.x());
  }
  MatrixXd columns = MatrixXd::Zero(bridge.reading.size(), 2);
  for (Index k = 0; k < columns.rows(); ++k) {
    const ReadingRow& row = bridge.rows[static_cast<std::size_t>(k)];
    if (std::ranges::find(line.channels, row.channel) == line.channels.end()) continue;
    const double x = comparison.library.points[row.channel].position.x();
    const double weight = wanted.size * (wanted.first_epoch ? row.before : row.after);
    if (wanted.shift) columns(k, 0) = weight;
    if (wanted.tilt) columns(k, 1) = weight * (2.0 * (x - least) / (most - least) - 1.0);
  }
  return columns;
}

/// Are these columns what explains the readings in one of the cases, and in none better?
bool explains(const UnknownBridge& bridge, const Observation& observation, const MatrixXd& columns,
              const UnstatedCause& cause) {
  const Explained best = explained_by(bridge, observation, columns);
  const VectorXd expected = columns * best.amounts;
  return cause.log == Approx(best.log).epsilon(1e-6) &&
         (cause.expected - expected).norm() < 1e-6 * expected.norm() &&
         (cause.covariance - columns * columns.transpose()).norm() < 1e-12 * cause.covariance.norm();
}

/// How often one of these columns of the line is what it says.
int columns_that_explain(const UnknownBridge& bridge, const ShiftedReadings& readings,
                         const Observation& observation, const LineError& line, bool shift, bool tilt) {
  int count = 0;
  for (const double size : {0.3e-3, 3e-3}) {
    const MatrixXd columns =
        line_columns(bridge, readings.comparison, line, {size, shift, tilt, line.first_epoch});
    count += explains(bridge, observation, columns, line.cause) ? 1 : 0;
  }
  return count;
}

/// Lines that may be off as a whole, by their number of points, and all lines.
struct FoundLines {
  std::multiset<std::size_t> whole, parted;
};
FoundLines lines_found(const ShiftedReadings& readings, const Nuisance& nuisance = {}) {
  const Observation observation = readings.observed(nuisance);
  const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, {});
  FoundLines found;
  for (const LineError& line : line_errors(bridge, observation, readings.comparison,
                                           intact_gaussians(bridge, observation, kTwoCases), kAll))
    (line.chance == 1e-3 ? found.whole : found.parted).insert(line.channels.size());
  return found;
}

}  // namespace

TEST_CASE("An error that a line shares explains readings as well as its covariance makes them likely") {
  const ShiftedReadings readings(GENERATE(ReadingKind::absolute, ReadingKind::change));
  const UnknownSettings settings{GENERATE(Epochs::change, Epochs::both)};
  const Observation observation = readings.observed();
  const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, settings);
  const auto found = line_errors(bridge, observation, readings.comparison,
                                 intact_gaussians(bridge, observation, kTwoCases), kAll);

  // Of two lines the whole, and the likelier of the first and last three points, at one time or two.
  REQUIRE(found.size() == (bridge.has_first_epoch() ? 8 : 4));
  CHECK(std::ranges::is_sorted(found, std::ranges::greater{},
                               [](const LineError& line) { return line.cause.log + std::log(line.chance); }));
  for (const LineError& line : found) {
    INFO(line.channels.size() << " from channel " << line.channels.front() << " on, off by " << line.size);
    const bool is_whole = line.channels.size() == kOfLine;
    CHECK(line.chance == (is_whole ? 1e-3 : 1e-4));
    CHECK(columns_that_explain(bridge, readings, observation, line, true, is_whole) == 1);
  }
  if (bridge.has_first_epoch()) return;
  CHECK(found.front().channels.size() == kOfLine);
  CHECK(found.front().size == Approx(kShift).epsilon(0.3));
}

TEST_CASE("What is stated of a levelling is no error of it, but what is not stated is (written out)") {
  ShiftedReadings readings(ReadingKind::change);
  readings.comparison.levelling = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  const auto check = [&](const Nuisance& nuisance, bool shift, bool tilt) {
    const Observation observation = readings.observed(nuisance);
    const UnknownBridge bridge = unknown_bridge(readings.comparison, observation, {});
    for (const LineError& line : line_errors(bridge, observation, readings.comparison,
                                             intact_gaussians(bridge, observation, kTwoCases), kAll))
      if (line.chance == 1e-3)
        CHECK(columns_that_explain(bridge, readings, observation, line, shift, tilt) == 1);
  };
  check({}, true, true);
  check({.datum = 1e-3}, false, true);
  check({.tilt = 1e-3}, true, false);
  CHECK(lines_found(readings, {.datum = 1e-3, .tilt = 1e-3}).whole.empty());
  CHECK(lines_found(readings, {.datum = 1e-3, .tilt = 1e-3}).parted.size() == 2);
}

TEST_CASE("Lines are what was levelled at once or is named alike, unless it is all (written out)") {
  using Sizes = std::multiset<std::size_t>;
  ShiftedReadings readings(ReadingKind::change);
  CHECK(lines_found(readings).whole == Sizes{6, 6});                   // T and A
  CHECK(lines_found(readings, {.datum = 1e-3}).whole == Sizes{6, 6});  // of one levelling
  readings.comparison.levelling = {0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  // T1 to T3; T4 to A6, and of it T4 to T6; T; A.
  CHECK(lines_found(readings).whole == Sizes{3, 9, 3, 6, 6});
  readings.comparison.levelling = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
  CHECK(lines_found(readings).whole == Sizes{6, 6});
  CHECK(lines_found(readings, {.datum = 1e-3}).whole.empty());
  readings.comparison.levelling = std::vector<int>(12, kNoLevelling);
  CHECK(lines_found(readings).whole.empty());
  readings.comparison.levelling.clear();
  for (std::size_t i = 8; i < 12; ++i) readings.comparison.measured.displacement[i] = kNan;
  CHECK(lines_found(readings).whole == Sizes{6});  // A1 and A2 are too few
}

TEST_CASE("Lines under a load are those of its points (written out)") {
  ShiftedReadings readings(ReadingKind::load);
  readings.comparison.load = std::vector<std::string>(12, "truck@2");
  for (StoredPoint& point : readings.comparison.library.points) point.name += " under truck@2";
  CHECK(lines_found(readings).whole == std::multiset<std::size_t>{6, 6});
}
