/// What else would explain readings. Oracle: readings as they were made, of which the answer is known.

#include "lookup/checks/other_explanations.h"

#include <catch2/catch.hpp>

#include "tests/lookup/unknown/made_up_factors.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

constexpr double kSigma = 1e-5;  // [m]

/// Changes of the intact bridge.
struct IntactBridge {
  SyntheticLibrary library{3, 6};
  Sensitivities sensitivities = made_up_sensitivities_of(library);
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));

  explicit IntactBridge(std::uint64_t seed) {
    Random random(seed);
    comparison.kind = ReadingKind::change;
    comparison.factors = factors_of(library, sensitivities);
    for (std::size_t i = 0; i < library.points.size(); ++i) {
      comparison.measured.displacement[i] = library.intact()[i] + kSigma * random.gaussian();
      comparison.measured.sigma[i] = kSigma;
    }
  }
};

bool is_alarm(const Answer& answer) {
  return answer.fit->explained && intact_probability(*answer.posterior) < 1.0 - kCertain;
}

}  // namespace

TEST_CASE("What is read on one block, all of it wrong by as much, names no block") {
  int of_one_block = 0;
  for (const std::uint64_t seed : {1, 2, 3})
    for (std::size_t first = 0; first < 12; first += 2)
      for (const double off : {-2e-3, -3e-4, 3e-4, 2e-3}) {
        IntactBridge bridge(seed);
        REQUIRE(!is_alarm(locate_damage(bridge.comparison, {})));
        for (const std::size_t channel : {first, first + 1})
          bridge.comparison.measured.displacement[channel] += off;
        const Answer answer = locate_damage(bridge.comparison, {});
        INFO(seed << " points from " << first << " off by " << off << ": " << answer.fit->reason);
        CHECK(!is_alarm(answer));
        CHECK(!answer.fit->explained);
        of_one_block += answer.fit->reason.starts_with("only the readings at T") ? 1 : 0;
      }
  CHECK(of_one_block >= 10);  // of 72, the others by their fit or by one of the two
}

TEST_CASE("A loss that two blocks' sensors show is located (made from its own row)") {
  const SyntheticLibrary library{3, 6};
  int located = 0;
  for (const std::int32_t lost : {7, 8, 9, 10}) {
    IntactBridge bridge(1);
    const std::span<const double> row = library.table.row(library.row_of({{BlockId{lost}}}));
    for (std::size_t i = 0; i < row.size(); ++i)
      bridge.comparison.measured.displacement[i] += row[i] - library.intact()[i];
    const Answer answer = locate_damage(bridge.comparison, {});
    INFO(lost << ": " << answer.fit->reason);
    CHECK(answer.fit->explained);
    located += is_alarm(answer) && answer.candidates.front().scene == Scene{{BlockId{lost}}} ? 1 : 0;
  }
  CHECK(located == 4);
}

TEST_CASE("A load that stood there at one of the two times and is not stated names no block") {
  int alarms = 0, loads = 0;
  for (const std::uint64_t seed : {1, 2, 3})
    for (const bool is_known : {false, true})
      for (const double force : {-60e3, 60e3}) {
        IntactBridge bridge(seed);
        const auto points = static_cast<Eigen::Index>(bridge.library.points.size());
        Eigen::MatrixXd influence(points, 5);
        for (Eigen::Index place = 0; place < 5; ++place)  // as a missing block's signal, or nearly
          for (Eigen::Index point = 0; point < points; ++point) {
            const std::span<const double> row =
                bridge.library.table.row(bridge.library.row_of({{BlockId{7 + static_cast<int>(place)}}}));
            const auto i = static_cast<std::size_t>(point);
            influence(point, place) = 2e-5 * (row[i] - bridge.library.intact()[i]);
          }
        if (is_known) bridge.sensitivities.load = {{0.0, 1.0, 2.0, 3.0, 4.0}, influence};
        const Eigen::VectorXd loaded = force * (0.6 * influence.col(1) + 0.4 * influence.col(2));
        for (std::size_t i = 0; i < bridge.library.points.size(); ++i)
          bridge.comparison.measured.displacement[i] += loaded[static_cast<Eigen::Index>(i)];
        const Answer answer = locate_damage(bridge.comparison, {});
        INFO(seed << ", " << force << " N/m: " << answer.fit->reason);
        if (is_known) CHECK(!is_alarm(answer));
        alarms += is_alarm(answer) ? 1 : 0;
        loads += answer.fit->reason.starts_with("a load of about") ? 1 : 0;
      }
  CHECK(alarms >= 3);  // of 6 of which nobody knows what loads do
  CHECK(loads >= 3);
}

TEST_CASE("A line that was levelled apart from the others, all of it off alike, names no block") {
  int alarms = 0, lines = 0;
  for (const std::uint64_t seed : {1, 2, 3})
    for (const bool is_line : {false, true})
      for (const double off : {-1e-4, 1e-4}) {
        IntactBridge bridge(seed);
        for (std::size_t i = 4; i < 10; ++i) {  // on three blocks
          if (is_line) bridge.comparison.library.points[i].name = "A" + std::to_string(i - 3);
          bridge.comparison.measured.displacement[i] += off;
        }
        const Answer answer = locate_damage(bridge.comparison, {});
        INFO(seed << ", off by " << off << " m: " << answer.fit->reason);
        if (is_line) CHECK(!is_alarm(answer));
        alarms += is_alarm(answer) ? 1 : 0;
        lines +=
            answer.fit->reason.starts_with("an error of about 0.1 mm that all readings at A1 to A6") ? 1 : 0;
      }
  UNSCOPED_INFO(alarms << " alarms, " << lines << " lines");
  CHECK(alarms >= 3);  // of 6 in which all points are of one line
  CHECK(lines >= 3);
}
