#include "database/records/stored_table.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/statics/solution.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

template <class T>
std::span<const T> numbers_in(ByteView bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

template <class T>
std::span<const T> read_numbers(const Hdf5File& file, const char* path, const Sizes& sizes) {
  return numbers_in<T>(read_column(file, column_at(path), sizes));
}

using Ids = std::span<const std::int32_t>;

Ids without_padding(Ids ids) {
  return ids.first(static_cast<std::size_t>(std::find(ids.begin(), ids.end(), -1) - ids.begin()));
}

/// The ids before the padding; nothing unless they ascend, name one of so many blocks each, and only -1
/// follow.
std::optional<Ids> scene_in(Ids row, std::size_t blocks) {
  std::size_t size = 0;
  std::int32_t last = -1;
  while (size < row.size() && row[size] > last) last = row[size++];
  for (std::size_t i = size; i < row.size(); ++i)
    if (row[i] != -1) return std::nullopt;
  return last < static_cast<std::int64_t>(blocks) ? std::optional(row.first(size)) : std::nullopt;
}

}  // namespace

bool SceneTable::has_displacements(std::size_t scene) const {
  return std::ranges::any_of(row(scene), [](double value) { return !std::isnan(value); });
}

bool SceneTable::stands(std::size_t scene) const {
  return outcome[scene] == static_cast<std::uint8_t>(Outcome::standing);
}

Scene SceneTable::scene(std::size_t row) const {
  Scene scene;
  for (const std::int32_t id : removed.subspan(row * most_missing, most_missing))
    if (id >= 0) scene.removed.push_back(BlockId{id});
  return scene;
}

std::optional<std::size_t> SceneTable::find(const Scene& wanted) const {
  const auto order = [&](std::size_t row) {
    const Ids ids = without_padding(removed.subspan(row * most_missing, most_missing));
    return row_order(kNominalVariant, ids, kNominalVariant, wanted.removed);
  };
  const auto every = std::views::iota(std::size_t{0}, rows);
  const std::size_t row =
      *std::ranges::partition_point(every, [&](std::size_t each) { return order(each) < 0; });
  return row < rows && order(row) == 0 ? std::optional(row) : std::nullopt;
}

ByteView read_column(const Hdf5File& file, const Column& column, const Sizes& sizes) {
  return file.array(column.path, column.type, shape_of(column, sizes));
}

StoredTable::StoredTable(const Hdf5File& file, std::size_t blocks, std::size_t points, std::size_t states,
                         std::size_t variants) {
  const DatasetView removed_blocks = file.view(dataset::kRemoved);
  file.require(removed_blocks.shape.size() == 2,
               fmt::format("dataset '{}' has not the expected type and shape", dataset::kRemoved));
  sizes_ = {states, removed_blocks.shape[0], removed_blocks.shape[1], points, blocks, 0, 0};
  read_views(file);
  check_rows(file);
  check_values(file);
  for (std::size_t variant = 0; variant <= variants; ++variant)
    first_.push_back(static_cast<std::size_t>(
        std::lower_bound(variant_.begin(), variant_.end(), static_cast<std::int32_t>(variant)) -
        variant_.begin()));
  file.require(variant_.front() == kNominalVariant && first_.back() == sizes_.records,
               fmt::format("dataset '{}' names other variants than 0 to {} or lacks 0", dataset::kVariant,
                           variants - 1));
}

void StoredTable::read_views(const Hdf5File& file) {
  variant_ = read_numbers<std::int32_t>(file, dataset::kVariant, sizes_);
  removed_ = read_numbers<std::int32_t>(file, dataset::kRemoved, sizes_);
  outcome_ = read_numbers<std::uint8_t>(file, dataset::kOutcome, sizes_);
  collapse_ = read_numbers<std::uint8_t>(file, dataset::kCollapse, sizes_);
  if (file.has(dataset::kOrigin)) origin_ = read_numbers<std::uint8_t>(file, dataset::kOrigin, sizes_);
  vertical_ = read_numbers<double>(file, dataset::kVertical, sizes_);
}

void StoredTable::check_rows(const Hdf5File& file) const {
  Ids previous;
  for (std::size_t row = 0; row < sizes_.records; ++row) {
    const auto ids =
        scene_in(removed_.subspan(row * sizes_.most_missing, sizes_.most_missing), sizes_.blocks);
    // Messages are made only when they are needed: there are many rows.
    if (!ids) file.refuse(fmt::format("dataset '{}' holds no scene in row {}", dataset::kRemoved, row));
    if (row > 0 && row_order(variant_[row - 1], previous, variant_[row], *ids) >= 0)
      file.refuse(fmt::format("dataset '{}' or '{}' is out of order in row {}", dataset::kRemoved,
                              dataset::kVariant, row));
    previous = *ids;
  }
}

void StoredTable::check_values(const Hdf5File& file) const {
  const auto check = [&](std::span<const std::uint8_t> values, std::uint8_t highest, const char* path) {
    const auto wrong =
        std::find_if(values.begin(), values.end(), [&](std::uint8_t value) { return value > highest; });
    if (wrong != values.end())
      file.refuse(fmt::format("dataset '{}' holds {} where 0 to {} were expected", path, *wrong, highest));
  };
  check(outcome_, static_cast<std::uint8_t>(Outcome::unresolved), dataset::kOutcome);
  check(collapse_, static_cast<std::uint8_t>(CollapseExtent::arch), dataset::kCollapse);
  check(origin_, static_cast<std::uint8_t>(Origin::inherited), dataset::kOrigin);
}

SceneTable StoredTable::part(std::size_t variant, std::size_t state) const {
  const std::size_t first = first_[variant];
  const std::size_t rows = first_[variant + 1] - first;
  const std::size_t place = state * sizes_.records + first;
  return {rows,
          sizes_.points,
          sizes_.most_missing,
          vertical_.subspan(place * sizes_.points, rows * sizes_.points),
          removed_.subspan(first * sizes_.most_missing, rows * sizes_.most_missing),
          outcome_.subspan(place, rows),
          collapse_.subspan(place, rows),
          origin_.empty() ? origin_ : origin_.subspan(place, rows),
          first};
}

std::span<const std::int32_t> StoredTable::removed(std::size_t row) const {
  return without_padding(removed_.subspan(row * sizes_.most_missing, sizes_.most_missing));
}

RecordKey StoredTable::key(std::size_t row) const {
  RecordKey key{variant_[row], {}};
  for (const std::int32_t id : removed(row)) key.scene.removed.push_back(BlockId{id});
  return key;
}

std::optional<std::size_t> StoredTable::find(std::int32_t variant, const Scene& scene) const {
  std::size_t low = 0;
  std::size_t high = sizes_.records;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (row_order(variant_[middle], removed(middle), variant, scene.removed) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  const bool found =
      low < sizes_.records && row_order(variant_[low], removed(low), variant, scene.removed) == 0;
  return found ? std::optional(low) : std::nullopt;
}

}  // namespace voussoir
