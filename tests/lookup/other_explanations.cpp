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
  for (const std::uint64_t seed : {1, 2, 3})
    for (std::size_t first = 0; first < 12; first += 2)
      for (const double off : {-2e-3, -3e-4, 3e-4, 2e-3}) {
        IntactBridge bridge(seed);
        REQUIRE(!is_alarm(locate_damage(bridge.comparison, {})));
        for (const std::size_t channel : {first, first + 1})
          bridge.comparison.measured.displacement[channel] += off;
        const Answer answer = locate_damage(bridge.comparison, {});
        INFO(seed << " points from " << first << " off by " << off);
        CHECK(!is_alarm(answer));
        CHECK(!answer.fit->explained);
        UNSCOPED_INFO(answer.fit->reason);
      }
}
