/// @file What may be asked of a database. Oracle: counts by hand.

#include "lookup/answer/preparation.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/lookup/synthetic_library.h"

namespace voussoir {
namespace {

/// Of all scenes with so many missing blocks only that they fall.
void let_fall(test::SyntheticLibrary& library, int missing) {
  for (std::size_t row = 0; row < library.table.rows; ++row) {
    if (missing_blocks(library.table, row) != missing) continue;
    library.outcome[row] = static_cast<std::uint8_t>(Outcome::collapsed);
    std::fill_n(library.vertical.begin() + static_cast<std::ptrdiff_t>(row * library.table.points),
                library.table.points, std::numeric_limits<double>::quiet_NaN());
  }
  library.make_index();
}

LookupSettings asking_for(std::vector<int> missing) {
  LookupSettings settings;
  settings.prior.missing = std::move(missing);
  return settings;
}

}  // namespace

TEST_CASE("Where all pairs fall all else is asked, and pairs alone are no question") {
  test::SyntheticLibrary library(2, 3);
  let_fall(library, 2);
  const Preparation all(library.library(), {}, false);
  CHECK(all.eligible().rows.size() == 1 + 6);
  CHECK(all.eligible().fallen == std::vector<std::size_t>{0, 0, 15});
  CHECK_THROWS_WITH(Preparation(library.library(), asking_for({2}), false),
                    Catch::Contains("in all scenes with 2 missing blocks something falls"));
  CHECK_THROWS_WITH(Preparation(library.library(), asking_for({3}), false),
                    Catch::Contains("no solved scene with 3 missing blocks, expected of 0, 1, 2"));
}

}  // namespace voussoir
