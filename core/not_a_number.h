#pragma once
/// @file The value of a reading, or of a result, that is not there.

#include <limits>

namespace voussoir {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace voussoir
