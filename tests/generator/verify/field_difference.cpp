#include "generator/verify/field_difference.h"

#include <catch2/catch.hpp>
#include <limits>

namespace voussoir {

TEST_CASE(
    "Fields differ by their largest difference, and without bound where only one has a value (by hand)") {
  constexpr double kGone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d field(1.0, kGone, -2.0);
  CHECK(largest_difference(field, field) == 0.0);
  CHECK(largest_difference(field, Eigen::Vector3d(1.5, kGone, 1.0)) == 3.0);
  CHECK(largest_difference(field, Eigen::Vector3d(1.0, 0.0, -2.0)) == kInfinite);
  CHECK(largest_difference(Eigen::Vector3d(1.0, 0.0, -2.0), field) == kInfinite);
}

}  // namespace voussoir
