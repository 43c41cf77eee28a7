#pragma once
/// @file Rows of a table in blocks that are worked out together.

#include <algorithm>
#include <span>
#include <vector>

namespace voussoir {

/// The rows, in their order, in blocks of which intermediate results stay in the cache.
inline std::vector<std::span<const std::size_t>> row_blocks(std::span<const std::size_t> rows) {
  constexpr std::size_t kBlockRows = 1024;
  std::vector<std::span<const std::size_t>> blocks;
  for (std::size_t first = 0; first < rows.size(); first += kBlockRows)
    blocks.push_back(rows.subspan(first, std::min(kBlockRows, rows.size() - first)));
  return blocks;
}

/// A function that gives a value for each row of a block, applied to all of them.
template <typename Function>
std::vector<double> block_by_block(std::span<const std::size_t> rows, Function function) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const auto block : row_blocks(rows)) {
    const std::vector<double> part = function(block);
    result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

}  // namespace voussoir
