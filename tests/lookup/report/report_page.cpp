#include <catch2/catch.hpp>

#include "lookup/report/report.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using Catch::Matchers::Contains;

TEST_CASE("The page names scenes that sensors cannot tell from the first when there are any, and only then") {
  // Oracle: the names of the scenes that the answer holds, by the order in which the blocks were laid.
  const test::SyntheticLibrary library(4, 9);
  Random random(7);
  const LookupSettings settings;
  const Measurements measured =
      library.measure(library.row_of({{BlockId{5}}}), 0.01, NoiseShape::uniform, random);
  Answer answer = locate_damage(absolute_readings(library.library(), measured), settings);
  const auto page = [&] {
    return page_report(answer, settings, absolute_readings(library.library(), measured), {});
  };
  std::vector<Scene>& same = answer.candidates.front().same_readings;
  same.clear();
  CHECK_THAT(page(), !Contains("cannot tell it from"));
  same = {{{BlockId{6}}}};
  CHECK_THAT(page(), Contains("These sensors cannot tell it from: 1,7<"));
  same.push_back({{BlockId{6}, BlockId{10}}});
  CHECK_THAT(page(), Contains("These sensors cannot tell it from: 1,7; 1,7+2,2<"));
}
