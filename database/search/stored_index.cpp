#include "database/search/stored_index.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "database/search/index_building.h"

namespace voussoir {
namespace {

constexpr std::array<std::int32_t, 1> kNoSlots = {0};
constexpr std::int32_t kLargestExponent = 64, kMostCoarse = 12, kMostStep = 1000, kMostStart = 1 << 28;

/// SlotBounds as they are in memory.
std::vector<std::int32_t> as_numbers(const std::vector<SlotBounds>& bounds) {
  std::vector<std::int32_t> numbers;
  for (const SlotBounds& one : bounds) {
    numbers.push_back(static_cast<std::int32_t>(one.distance_and_step));
    numbers.push_back(one.start);
  }
  return numbers;
}

bool within(std::span<const std::int16_t> values) {
  return std::all_of(values.begin(), values.end(),
                     [](std::int16_t value) { return value >= -kFarthestPlace && value <= kFarthestPlace; });
}

bool within(std::span<const std::int32_t> values, std::int32_t least, std::int32_t most) {
  return std::all_of(values.begin(), values.end(),
                     [&](std::int32_t value) { return value >= least && value <= most; });
}

bool none_has_displacements(std::span<const double> rows) {
  return std::ranges::none_of(rows, [](double value) { return std::isfinite(value); });
}

/// Each of so many rows at most once.
bool none_twice(std::span<const std::int32_t> rows, std::size_t count) {
  std::vector<bool> seen(count, false);
  for (const std::int32_t row : rows) {
    const auto place = static_cast<std::size_t>(row);
    if (row < 0 || place >= count || seen[place]) return false;
    seen[place] = true;
  }
  return true;
}

/// Clusters follow each other, none is empty, and finer units come first.
bool in_order(const SearchIndex& index) {
  return index.first.size() == index.clusters() + 1 && index.first.front() == 0 &&
         static_cast<std::size_t>(index.first.back()) == index.row.size() &&
         std::adjacent_find(index.first.begin(), index.first.end(), std::greater_equal<>()) ==
             index.first.end() &&
         std::is_sorted(index.exponent.begin(), index.exponent.end());
}

bool is_small(const SlotBounds& bounds) {
  return bounds.step() <= kMostStep && bounds.start >= -kMostStart && bounds.start <= kMostStart;
}

}  // namespace

std::string index_path(const std::string& state, const char* name) {
  return "search_" + state + "/" + name;
}

std::vector<DatasetValue> search_datasets(const std::string& state, std::span<const double> rows,
                                          std::size_t points) {
  const SearchIndexData index = build_search_index(rows, points);
  if (index.row.empty()) return {};
  const std::uint64_t places = index.places;
  std::vector<DatasetValue> datasets = {
      dataset_of(index_dataset::kExponent, ElementType::int32, index.exponent, kFlat, "1",
                 "of each cluster: its unit is 2^exponent metres"),
      dataset_of(index_dataset::kCoarseness, ElementType::int32, index.coarseness, kFlat, "1",
                 "of each cluster: its rows' distances count 2^coarseness units"),
      dataset_of(index_dataset::kFirst, ElementType::int32, index.first, kFlat, "1",
                 "the first slot of each cluster, and one past the last slot"),
      dataset_of(index_dataset::kCentre, ElementType::int16, index.centre, places, "1",
                 "the middle of each cluster's rows [units]; places beyond the points are filled up"),
      dataset_of(index_dataset::kLeast, ElementType::int16, index.least, places, "1",
                 "the least displacements of each cluster's rows, rounded down [units]"),
      dataset_of(index_dataset::kMost, ElementType::int16, index.most, places, "1",
                 "the largest displacements of each cluster's rows, rounded up [units]"),
      dataset_of(index_dataset::kRow, ElementType::int32, index.row, kFlat, "1", "the scene of each slot"),
      dataset_of(
          index_dataset::kBounds, ElementType::int32, as_numbers(index.bounds), 2, "1",
          "of each slot: distance from the centre (lower 16 bits) and step (upper 16 bits); what sketching "
          "lost less step times the sum of the sketch"),
      dataset_of(index_dataset::kSketch, ElementType::int8, index.sketch, places, "1",
                 "of each slot: the steps from the centre"),
  };
  for (DatasetValue& each : datasets) each.path = index_path(state, each.path.c_str());
  return datasets;
}

SearchIndex read_search_index(const Hdf5File& file, const std::string& state, std::span<const double> rows,
                              std::size_t points) {
  const auto path = [&](const char* name) { return index_path(state, name); };
  SearchIndex index;
  index.places = places_for(points);
  if (!file.has(path(index_dataset::kRow).c_str()) && none_has_displacements(rows)) {
    index.first = kNoSlots;
    return index;
  }
  index.exponent =
      file.numbers<std::int32_t>(path(index_dataset::kExponent).c_str(), ElementType::int32, kFlat);
  index.coarseness =
      file.numbers<std::int32_t>(path(index_dataset::kCoarseness).c_str(), ElementType::int32, kFlat);
  index.first = file.numbers<std::int32_t>(path(index_dataset::kFirst).c_str(), ElementType::int32, kFlat);
  index.centre =
      file.numbers<std::int16_t>(path(index_dataset::kCentre).c_str(), ElementType::int16, index.places);
  index.least =
      file.numbers<std::int16_t>(path(index_dataset::kLeast).c_str(), ElementType::int16, index.places);
  index.most =
      file.numbers<std::int16_t>(path(index_dataset::kMost).c_str(), ElementType::int16, index.places);
  index.row = file.numbers<std::int32_t>(path(index_dataset::kRow).c_str(), ElementType::int32, kFlat);
  const auto bounds = file.numbers<std::int32_t>(path(index_dataset::kBounds).c_str(), ElementType::int32, 2);
  index.bounds = {reinterpret_cast<const SlotBounds*>(bounds.data()), bounds.size() / 2};
  index.sketch =
      file.numbers<std::int8_t>(path(index_dataset::kSketch).c_str(), ElementType::int8, index.places);
  const std::size_t in_boxes = index.clusters() * index.places;
  const std::size_t count = rows.size() / points;
  file.require(index.row.size() <= count && index.bounds.size() == index.row.size() &&
                   index.sketch.size() == index.row.size() * index.places &&
                   index.coarseness.size() == index.clusters() && index.centre.size() == in_boxes &&
                   index.least.size() == in_boxes && index.most.size() == in_boxes && in_order(index) &&
                   none_twice(index.row, count),
               "the datasets of " + path("") + " do not fit together");
  file.require(within(index.exponent, -kLargestExponent, kLargestExponent) &&
                   within(index.coarseness, 0, kMostCoarse) && within(index.centre) && within(index.least) &&
                   within(index.most) && std::all_of(index.bounds.begin(), index.bounds.end(), is_small),
               "the datasets of " + path("") + " hold numbers out of range");
  return index;
}

}  // namespace voussoir
