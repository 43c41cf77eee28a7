#include <catch2/catch.hpp>

#include "generator/running/progress.h"

namespace voussoir {

TEST_CASE("Progress in words: count, rate of this run and the time that is left at this rate") {
  CHECK(progress_text(0, 100, "scenes", 0, 0.0) == "0 of 100 scenes");
  CHECK(progress_text(50, 100, "scenes", 10, 2.0) == "50 of 100 scenes, 5/s, 10 s left");
  CHECK(progress_text(1000, 22579, "scenes", 1000, 5.0) == "1000 of 22579 scenes, 200/s, 1 min 48 s left");
  CHECK(progress_text(8, 128, "sampled bridges", 8, 32.0) ==
        "8 of 128 sampled bridges, 0.25/s, 8 min 0 s left");
}

TEST_CASE("The bar fills from left to right") {
  CHECK(progress_bar(0, 10, 5) == "[-----]");
  CHECK(progress_bar(5, 10, 4) == "[##--]");
  CHECK(progress_bar(10, 10, 5) == "[#####]");
  CHECK(progress_bar(0, 0, 2) == "[--]");
}

}  // namespace voussoir
