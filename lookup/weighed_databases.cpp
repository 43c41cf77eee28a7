#include "lookup/weighed_databases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace voussoir {
namespace {

double width_of(const std::vector<StoredPoint>& points) {
  const auto [first, last] =
      std::ranges::minmax(points, {}, [](const StoredPoint& point) { return point.position.x(); });
  return last.position.x() - first.position.x();
}

std::string place_in(const DatabaseReadings& one, const std::string& sensor) {
  const Point& place = one.sensors.at(sensor).position;
  return fmt::format("x {:g}, y {:g} m in {}", place.x(), place.y(), one.file);
}

void require_same_places(const DatabaseReadings& one, const DatabaseReadings& other) {
  const double most = std::min(kMostApart, kMostApartOfWidth * std::min(one.width, other.width));
  for (const auto& [sensor, read] : one.sensors) {
    const auto found = other.sensors.find(sensor);
    if (found == other.sensors.end()) continue;
    if (found->second.quantity != read.quantity)
      throw InputError(fmt::format("sensor {} reads {} in {} and {} in {}, expected the same in both", sensor,
                                   to_string(read.quantity), one.file, to_string(found->second.quantity),
                                   other.file));
    if ((found->second.position - read.position).norm() <= most) continue;
    throw InputError(
        fmt::format("sensor {} is at {} and at {}, expected at most {:.2g} m in between: several databases "
                    "are one bridge under different assumptions",
                    sensor, place_in(one, sensor), place_in(other, sensor), most));
  }
}

void require_counted_too(const DatabaseReadings& one, const DatabaseReadings& other) {
  for (const std::string& sensor : one.counted)
    if (!other.counted.contains(sensor))
      throw InputError(
          fmt::format("the reading of {} counts in {} and not in {}, as the point is held there: expected "
                      "errors that are no share of what moves (sigma_mm or --sigma)",
                      sensor, one.file, other.file));
}

}  // namespace

DatabaseReadings database_readings(const std::string& file, const std::vector<StoredPoint>& control_points,
                                   const Comparison& comparison, const Answer& answer) {
  DatabaseReadings result{file, width_of(control_points), {}, {}};
  const std::vector<StoredPoint>& channels = comparison.library.points;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (comparison.measured.silent[i] || !std::isnan(comparison.measured.displacement[i]))
      result.sensors.emplace(channels[i].name, ReadPlace{channels[i].position, quantity_of(comparison, i)});
  for (const std::size_t channel : answer.counted) result.counted.insert(channels[channel].name);
  return result;
}

void require_one_bridge(std::span<const DatabaseReadings> all) {
  for (const DatabaseReadings& other : all) require_same_places(all.front(), other);
}

void require_same_readings(std::span<const DatabaseReadings> all) {
  for (const DatabaseReadings& other : all) {
    require_counted_too(all.front(), other);
    require_counted_too(other, all.front());
  }
}

void weigh(std::vector<AskedDatabase>& databases) {
  std::ranges::stable_sort(databases, std::ranges::greater{}, &AskedDatabase::log_evidence);
  const double most = databases.front().log_evidence;
  double total = 0.0;
  for (AskedDatabase& one : databases) {
    // Where none has a possible scene, none is more likely than the others.
    one.probability = one.log_evidence == most ? 1.0 : std::exp(one.log_evidence - most);
    total += one.probability;
  }
  for (AskedDatabase& one : databases) one.probability /= total;
}

bool is_contested(std::span<const AskedDatabase> databases) {
  const AskedDatabase& first = databases.front();
  return std::ranges::any_of(databases.subspan(1), [&](const AskedDatabase& other) {
    if (other.probability < kCounting) return false;
    return other.verdict != first.verdict ||
           (first.verdict == Verdict::located && other.first != first.first);
  });
}

}  // namespace voussoir
