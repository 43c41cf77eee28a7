#include "tools/benchmarks/triples_library.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/error.h"
#include "database/search/index_building.h"
#include "tools/benchmarks/timing.h"

namespace voussoir {
namespace {

constexpr std::size_t kMost = 3;  // missing blocks

/// Where rows of a table of all singles and pairs of `blocks` blocks are: the intact bridge, singles, pairs.
struct PairRows {
  std::size_t blocks;

  std::size_t count() const { return 1 + blocks + blocks * (blocks - 1) / 2; }
  std::size_t single(std::size_t a) const { return 1 + a; }
  std::size_t pair(std::size_t a, std::size_t b) const {
    return 1 + blocks + a * (2 * blocks - a - 1) / 2 + b - a - 1;
  }
};

PairRows rows_of(const SceneTable& table) {
  std::size_t blocks = 0;
  while (1 + blocks < table.rows && table.scene(1 + blocks).missing() == 1) ++blocks;
  const PairRows rows{blocks};
  if (table.most_missing != 2 || table.rows != rows.count())
    throw Failure(
        fmt::format("triples are made up from all singles and pairs of a bridge, expected {} scenes "
                    "with up to two missing blocks, found {} with up to {}",
                    rows.count(), table.rows, table.most_missing));
  return rows;
}

}  // namespace

TriplesLibrary::TriplesLibrary(const Library& pairs) : library_{{}, pairs.points, pairs.layout} {
  const SceneTable& table = pairs.table;
  for (std::size_t row = 0; row < table.rows; ++row)
    add(table.row(row), table.removed.subspan(row * table.most_missing, table.most_missing),
        table.outcome[row]);
  add_triples(pairs);
  library_.table = {outcome_.size(), table.points, kMost, vertical_, removed_, outcome_};
  const double start = processor_seconds();
  index_ = build_search_index(vertical_, table.points);
  seconds_of_index_ = processor_seconds() - start;
  library_.index = index_.view();
}

void TriplesLibrary::add(std::span<const double> row, std::span<const std::int32_t> removed,
                         std::uint8_t outcome) {
  vertical_.insert(vertical_.end(), row.begin(), row.end());
  removed_.insert(removed_.end(), removed.begin(), removed.end());
  removed_.resize(removed_.size() + kMost - removed.size(), -1);
  outcome_.push_back(outcome);
}

void TriplesLibrary::add_triples(const Library& pairs) {
  const SceneTable& table = pairs.table;
  const PairRows rows = rows_of(table);
  const std::size_t n = rows.blocks, count = rows.count() + n * (n - 1) * (n - 2) / 6;
  vertical_.reserve(count * table.points);
  removed_.reserve(count * kMost);
  outcome_.reserve(count);
  std::vector<double> made_up(table.points);
  const auto id = [&](std::size_t block) { return table.removed[rows.single(block) * table.most_missing]; };
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c) {
        const std::array<std::size_t, 6> parts = {rows.pair(a, b), rows.pair(a, c), rows.pair(b, c),
                                                  rows.single(a),  rows.single(b),  rows.single(c)};
        const bool stand = std::ranges::all_of(parts, [&](std::size_t row) { return table.stands(row); });
        for (std::size_t i = 0; i < table.points; ++i) {
          const auto at = [&](std::size_t part) { return table.row(parts[part])[i]; };
          made_up[i] = stand ? at(0) + at(1) + at(2) - at(3) - at(4) - at(5) + table.row(0)[i]
                             : std::numeric_limits<double>::quiet_NaN();
        }
        add(made_up, std::array{id(a), id(b), id(c)},
            static_cast<std::uint8_t>(stand ? Outcome::standing : Outcome::collapsed));
      }
}

}  // namespace voussoir
