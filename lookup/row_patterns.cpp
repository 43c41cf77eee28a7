#include "lookup/row_patterns.h"

#include <cmath>
#include <map>

namespace voussoir {
namespace {

constexpr std::size_t kBits = 64;

/// A bit for each point, set where the function says so.
template <typename Function>
std::vector<std::uint64_t> bits(std::size_t points, Function is_set) {
  std::vector<std::uint64_t> words((points + kBits - 1) / kBits, 0);
  for (std::size_t i = 0; i < points; ++i)
    if (is_set(i)) words[i / kBits] |= std::uint64_t{1} << i % kBits;
  return words;
}

}  // namespace

RowPatterns::RowPatterns(std::span<const double> rows, std::size_t points) {
  std::map<std::vector<std::uint64_t>, std::uint32_t> known;
  for (std::size_t first = 0; first < rows.size(); first += points) {
    const auto lacks = bits(points, [&](std::size_t i) { return std::isnan(rows[first + i]); });
    pattern_.push_back(known.try_emplace(lacks, static_cast<std::uint32_t>(known.size())).first->second);
  }
  count_ = known.size();
  lacks_.resize(count_ * ((points + kBits - 1) / kBits));
  for (const auto& [lacks, pattern] : known)
    for (std::size_t word = 0; word < lacks.size(); ++word) lacks_[word * count_ + pattern] = lacks[word];
}

std::vector<std::uint64_t> RowPatterns::lacking(std::span<const double> readings) const {
  const auto read = bits(readings.size(), [&](std::size_t i) { return !std::isnan(readings[i]); });
  std::vector<std::uint64_t> result(count_, 0);
  for (std::size_t word = 0; word < read.size(); ++word)
    for (std::size_t i = 0; i < count_; ++i) result[i] |= lacks_[word * count_ + i] & read[word];
  return result;
}

}  // namespace voussoir
