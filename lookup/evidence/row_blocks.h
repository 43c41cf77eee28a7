#pragma once
/// @file Rows of a table in blocks that are worked out together.

#include <algorithm>
#include <span>
#include <vector>

#include "core/parts.h"

namespace voussoir {

inline constexpr std::size_t kRowsInCache = 1024;  ///< of which intermediate results stay in the cache
inline constexpr std::size_t kRowsOfAThread = 64;  ///< which take long enough to be shared out

/// The rows, in their order, in blocks of so many.
inline std::vector<std::span<const std::size_t>> row_blocks(std::span<const std::size_t> rows,
                                                            std::size_t of) {
  std::vector<std::span<const std::size_t>> blocks;
  for (std::size_t first = 0; first < rows.size(); first += of)
    blocks.push_back(rows.subspan(first, std::min(of, rows.size() - first)));
  return blocks;
}

/// A function that gives a value for each row of a block, applied to all of them.
template <typename Function>
std::vector<double> block_by_block(std::span<const std::size_t> rows, Function function) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const auto block : row_blocks(rows, kRowsInCache)) {
    const std::vector<double> part = function(block);
    result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

/// Calls work(block) for blocks of all rows, on all of the machine's threads.
template <typename Work>
void for_row_blocks_on_threads(std::span<const std::size_t> rows, Work work) {
  for_parts(rows.size(), kRowsOfAThread,
            [&](std::size_t, std::size_t first, std::size_t count) { work(rows.subspan(first, count)); });
}

}  // namespace voussoir
