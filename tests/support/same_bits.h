#pragma once
/// @file Fields compared bit by bit, NaN and zeros included.

#include <cstring>

#include "core/structure/mesh.h"

namespace voussoir::test {

inline bool same_bits(const Field& first, const Field& second) {
  return first.cols() == second.cols() &&
         std::memcmp(first.data(), second.data(), static_cast<std::size_t>(first.size()) * sizeof(double)) ==
             0;
}

}  // namespace voussoir::test
