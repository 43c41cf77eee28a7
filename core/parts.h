#pragma once
/// @file Many things in parts of so many, which threads work on side by side.

#include <algorithm>
#include <cstddef>

#include "core/threads.h"

namespace voussoir {

/// How many parts of `size` there are, of which the last may be smaller.
constexpr std::size_t parts_of(std::size_t count, std::size_t size) {
  return (count + size - 1) / size;
}

/// Calls work(part, first, count) for each, on all of the machine's threads.
template <class Work>
void for_parts(std::size_t count, std::size_t size, const Work& work) {
  for_each_index_on_threads(parts_of(count, size), hardware_threads(), [&](std::size_t part) {
    work(part, part * size, std::min(size, count - part * size));
  });
}

}  // namespace voussoir
