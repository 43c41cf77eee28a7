#include "lookup/readings/comparison.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "lookup/readings/reading_states.h"

namespace voussoir {
namespace {

std::vector<Channel> channels_of(const ReadingsFile& file, const SensorList& list,
                                 const ReadingStates& states) {
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < file.readings.size(); ++i) {
    const Reading& reading = file.readings[i];
    channels.push_back({&list.sensors[reading.sensor], reading.sensor, reading.load, states.loaded[i]});
  }
  return channels;
}

std::vector<Channel> control_point_channels(const SensorList& list) {
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < list.control_points; ++i) channels.push_back({&list.sensors[i], i});
  return channels;
}

bool is_vertical(const Channel& channel) {
  return channel.sensor->quantity == Quantity::uy;
}

/// By channel; where nothing is read that of the first reading.
std::vector<std::string> levelling_names(const ReadingsFile& file, const Comparison& comparison) {
  std::vector<std::string> names(comparison.library.points.size(), file.readings.front().levelling);
  for (std::size_t i = 0; i < file.readings.size(); ++i)
    names[channel_of(comparison, file.readings[i], i)] = file.readings[i].levelling;
  return names;
}

/// Readings of heights with one load were levelled together, unless the file names levellings; other
/// instruments have no common level.
std::vector<int> levelling_of(const std::vector<Channel>& channels, const std::vector<std::string>& names) {
  std::vector<int> groups;
  std::vector<std::pair<std::string, std::string>> levellings;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!is_vertical(channels[i])) {
      groups.push_back(kNoLevelling);
      continue;
    }
    const std::pair levelling{channels[i].load, names[i]};
    const auto found = std::ranges::find(levellings, levelling);
    groups.push_back(static_cast<int>(found - levellings.begin()));
    if (found == levellings.end()) levellings.push_back(levelling);
  }
  return groups;
}

/// Puts the readings into their channels.
void enter(const ReadingsFile& file, std::optional<double> sigma, Comparison& comparison) {
  const std::size_t channels = comparison.library.points.size();
  comparison.measured = no_measurements(channels);
  if (file.two_epochs) comparison.before = comparison.after = no_measurements(channels).displacement;
  const std::vector<double> origin = origin_of(comparison);
  for (std::size_t i = 0; i < file.readings.size(); ++i) {
    const Reading& reading = file.readings[i];
    const std::size_t channel = channel_of(comparison, reading, i);
    comparison.measured.displacement[channel] = origin[channel] + reading.value;
    comparison.measured.silent[channel] = reading.silent;
    comparison.measured.sigma[channel] = std::isnan(reading.sigma) && sigma ? *sigma : reading.sigma;
    if (!file.two_epochs) continue;
    comparison.before[channel] = reading.before;
    comparison.after[channel] = reading.after;
  }
}

double root_mean_square(std::span<const double> values) {
  double sum = 0.0;
  int count = 0;
  for (const double value : values)
    if (!std::isnan(value)) sum += value * value, ++count;
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

/// The errors of the states that channels come from. The error of a signal: the largest of any state. That of
/// the intact bridge: at control points the state's own, of what a load adds the difference (the mesh errs to
/// one side in both states); elsewhere the share that control points have.
ModelError model_error_of(const Database& database, std::size_t base, const std::vector<Channel>& channels,
                          const Library& library) {
  ModelError result = database.model_errors()[base];
  const std::vector<double> at_points = result.intact;
  result.intact.clear();
  for (const Channel& channel : channels)
    if (channel.loaded) {
      const ModelError& loaded = database.model_errors()[*channel.loaded];
      result.share = std::max(result.share, loaded.share);
      result.common = std::max(result.common, loaded.common);
    }
  if (at_points.empty()) return result;
  const SceneTable table = database.table(kNominalVariant, base);
  const double size = root_mean_square(intact_predictions(table));
  const double share = size > 0.0 ? root_mean_square(at_points) / size : 0.0;
  const std::span<const double> intact = intact_predictions(library.table);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Channel& channel = channels[i];
    if (!channel.sensor->weights.empty()) {  // no control point
      result.intact.push_back(share * std::abs(intact[i]));
      continue;
    }
    const double own = at_points[channel.point];
    result.intact.push_back(
        channel.loaded ? std::abs(database.model_errors()[*channel.loaded].intact[channel.point] - own)
                       : own);
  }
  return result;
}

/// Of sensors that are not its own the database has no sensitivities.
void require_control_points(const ReadingsFile& file, const SensorList& list) {
  for (const Reading& reading : file.readings)
    if (reading.sensor >= list.control_points)
      throw InputError(
          at_line(file.name, reading.line,
                  fmt::format("sensor {} is not of the database: what it shows of a bridge that is not "
                              "exactly known follows when the database is built with it ([[sensors]] in the "
                              "bridge file); expected a sensor of the database, or --known-bridge",
                              in_quotes(list.sensors[reading.sensor].name))));
}

/// What says how the readings of a bridge scatter that is not exactly known. Nothing: it counts as known.
struct Evidence {
  std::shared_ptr<const SampledBridges> sampled;
  std::shared_ptr<const ReadingFactors> factors;
};

Evidence evidence_of(const ReadingsFile& file, const SensorList& list, const Database& database,
                     const ComparisonSettings& settings, std::size_t base,
                     const std::vector<Channel>& channels) {
  if (settings.known_bridge) return {};
  const Sensitivities* const sensitivities =
      settings.sampled ? &settings.sampled->sensitivities : database.sensitivities();
  if (sensitivities == nullptr) return {};
  require_control_points(file, list);
  return {settings.sampled, reading_factors(*sensitivities, base, channels, database.layout().size())};
}

/// A bridge that falls by itself shows nothing that readings could be compared with.
void require_standing(const Database& database, const Library& library) {
  const std::span<const double> intact = intact_predictions(library.table);
  if (std::ranges::any_of(intact, [](double value) { return std::isfinite(value); })) return;
  throw InputError(
      at_line(database.path().string(), 0,
              "the intact bridge shows nothing of what was read, as it does not stand: expected a database "
              "of a bridge that stands, under the loads, too (build-database --draw shows how it is held)"));
}

}  // namespace

Comparison absolute_readings(Library library, Measurements measured) {
  return {.library = std::move(library), .measured = std::move(measured), .model_error = {}};
}

Comparison compare(const ReadingsFile& file, const SensorList& list, const Database& database,
                   const ComparisonSettings& settings) {
  const ReadingStates states = find_reading_states(file, database, settings.history);
  const bool own_table = std::all_of(file.readings.begin(), file.readings.end(), [&](const Reading& reading) {
    return reading.load.empty() && reading.sensor < list.control_points;
  });
  const std::vector<Channel> channels =
      own_table ? control_point_channels(list) : channels_of(file, list, states);
  const Evidence evidence = evidence_of(file, list, database, settings, states.base, channels);
  const BridgeShown shown = evidence.factors ? BridgeShown::not_quite_known : BridgeShown::as_stated;
  Comparison result{.kind = file.kind,
                    .history = states.history,
                    .library = own_table ? library_of(database, states.base, shown)
                                         : library_of_channels(database, states.base, channels, shown),
                    .measured = {},
                    .model_error = {},
                    .factors = evidence.factors,
                    .sampled = evidence.sampled};
  require_standing(database, result.library);
  enter(file, settings.sigma, result);
  result.model_error = settings.model_error ? ModelError{*settings.model_error, 0.0, {}}
                                            : model_error_of(database, states.base, channels, result.library);
  const bool heights_alone = own_table && std::ranges::all_of(channels, is_vertical);
  const std::vector<std::string> levellings = levelling_names(file, result);
  const bool one_levelling =
      std::ranges::all_of(levellings, [&](const std::string& name) { return name == levellings.front(); });
  if (!heights_alone || !one_levelling) result.levelling = levelling_of(channels, levellings);
  if (heights_alone) return result;
  for (const Channel& channel : channels) {
    result.quantity.push_back(channel.sensor->quantity);
    result.load.push_back(channel.load);
  }
  return result;
}

/// In the database's own table the channels are control points, else the file's rows.
std::size_t channel_of(const Comparison& comparison, const Reading& reading, std::size_t position) {
  return comparison.library.storage == nullptr ? reading.sensor : position;
}

Quantity quantity_of(const Comparison& comparison, std::size_t channel) {
  return comparison.quantity.empty() ? Quantity::uy : comparison.quantity[channel];
}

std::string load_of(const Comparison& comparison, std::size_t channel) {
  return comparison.load.empty() ? std::string() : comparison.load[channel];
}

/// Channels are named "T1 under truck@2" (under_load).
std::string name_without_load(const Comparison& comparison, std::size_t channel) {
  const std::string& name = comparison.library.points[channel].name;
  return name.substr(0, name.size() - under_load(load_of(comparison, channel)).size());
}

std::vector<double> origin_of(const Comparison& comparison) {
  if (!is_change(comparison.kind)) return std::vector<double>(comparison.library.points.size(), 0.0);
  const std::span<const double> intact = intact_predictions(comparison.library.table);
  return {intact.begin(), intact.end()};
}

}  // namespace voussoir
