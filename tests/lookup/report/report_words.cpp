#include "lookup/report/report_words.h"

#include <catch2/catch.hpp>

using namespace voussoir;

namespace {

Candidate candidate(double misfit, std::optional<double> posterior) {
  Candidate result;
  result.misfit = misfit;
  result.posterior = posterior;
  return result;
}

}  // namespace

TEST_CASE("Without probabilities a candidate is behind by the difference of misfits (written out)") {
  CHECK(behind(candidate(-3.25, {}), candidate(-4.5, {})) == "+1.2500");
  CHECK(behind(candidate(-4.5, {}), candidate(-4.5, {})) == "+0.0000");
}

TEST_CASE("With probabilities a candidate is behind by their ratio, whatever the misfits (written out)") {
  const Candidate best = candidate(-3.0, 0.75);
  CHECK(behind(candidate(-4.5, 0.25), best) == "1 : 3");
  CHECK(behind(candidate(-3.0, 0.75), best) == "1 : 1");
  CHECK(behind(candidate(-2.0, 0.75e-5), best) == "1 : 1e+05");
  CHECK(behind(candidate(-2.0, 1e-9), best) == "1 : > 10^6");
  CHECK(behind(candidate(-2.0, 0.0), best) == "negligible");
}
