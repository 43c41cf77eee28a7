/// What else would explain readings. Oracle: readings as they were made, of which the answer is known.

#include "lookup/other_explanations.h"

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
