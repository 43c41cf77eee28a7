#pragma once
/// @file Memory that will soon be needed.

#include <cstddef>
#include <span>

namespace voussoir {

/// Asks the processor to fetch values that it would not look for by itself.
template <typename T>
void fetch(std::span<const T> values) {
  constexpr std::size_t kCacheLine = 64 / sizeof(T);
  for (std::size_t i = 0; i < values.size(); i += kCacheLine) __builtin_prefetch(values.data() + i);
}

}  // namespace voussoir
