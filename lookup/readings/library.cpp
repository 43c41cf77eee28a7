#include "lookup/readings/library.h"

#include <algorithm>

#include "core/error.h"
#include "core/not_a_number.h"
#include "core/solve/state_name.h"
#include "core/threads.h"

namespace voussoir {
namespace {

bool is(Outcome outcome, const SceneTable& table, std::size_t row) {
  return table.outcome[row] == static_cast<std::uint8_t>(outcome);
}

SceneTable table_of(const Database& database, std::size_t state, BridgeShown shown) {
  return shown == BridgeShown::as_stated ? database.table(kNominalVariant, state)
                                         : database.table_if_standing(state);
}

/// Fills a library row by row; rows are independent of each other.
class Predictions {
 public:
  Predictions(const Database& database, std::size_t base, const std::vector<Channel>& channels,
              BridgeShown shown)
      : database_(database), channels_(channels), states_{base} {
    for (const Channel& channel : channels)
      if (channel.loaded && std::find(states_.begin(), states_.end(), *channel.loaded) == states_.end())
        states_.push_back(*channel.loaded);
    for (const std::size_t state : states_) tables_.push_back(table_of(database, state, shown));
    with_fields_ = std::any_of(channels.begin(), channels.end(),
                               [](const Channel& channel) { return !channel.sensor->weights.empty(); });
  }

  const SceneTable& base() const { return tables_.front(); }

  LibraryStorage compute() const {
    const std::size_t rows = base().rows;
    LibraryStorage storage{std::vector<double>(rows * channels_.size()), std::vector<std::uint8_t>(rows)};
    if (std::ranges::any_of(tables_, [](const SceneTable& table) { return !table.standing_share.empty(); }))
      storage.standing_share.resize(rows);
    const int threads = with_fields_ ? hardware_threads() : 1;
    for_each_index_on_threads(rows, threads, [&](std::size_t row) {
      storage.outcome[row] = outcome(row);
      if (!storage.standing_share.empty()) storage.standing_share[row] = standing_share(row);
      const auto predictions =
          std::span(storage.predictions).subspan(row * channels_.size(), channels_.size());
      if (base().is_uncertain_fall(row) && storage.standing_share[row] == 0.0)
        std::ranges::fill(predictions, kNan);
      else
        fill(row, predictions);
    });
    return storage;
  }

 private:
  /// What stands under a load stands without it. 0 as well if it never stands in one of the states.
  double standing_share(std::size_t row) const {
    double least = 1.0;
    bool is_uncertain = false;
    for (const SceneTable& table : tables_) {
      if (!table.may_stand(row)) return 0.0;
      least = std::min(least, table.weight(row));
      is_uncertain = is_uncertain || table.is_uncertain_fall(row);
    }
    return is_uncertain ? least : 0.0;
  }

  std::uint8_t outcome(std::size_t row) const {
    const bool unresolved = std::any_of(tables_.begin(), tables_.end(), [&](const SceneTable& table) {
      return is(Outcome::unresolved, table, row);
    });
    return unresolved ? static_cast<std::uint8_t>(Outcome::unresolved) : base().outcome[row];
  }

  void fill(std::size_t row, std::span<double> predictions) const {
    std::vector<Field> fields;
    if (with_fields_)
      for (const std::size_t state : states_)
        fields.push_back(database_.field(base().first_record + row, state));
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const Channel& channel = channels_[i];
      predictions[i] = shown(channel, row, 0, fields);
      if (channel.loaded) predictions[i] = added_by_load(channel, row, predictions[i], fields);
    }
  }

  double added_by_load(const Channel& channel, std::size_t row, double unloaded,
                       const std::vector<Field>& fields) const {
    const auto found = std::find(states_.begin(), states_.end(), *channel.loaded);
    const auto state = static_cast<std::size_t>(found - states_.begin());
    const bool stands = base().may_stand(row) && tables_[state].may_stand(row);
    return stands ? shown(channel, row, state, fields) - unloaded : kNan;
  }

  double shown(const Channel& channel, std::size_t row, std::size_t state,
               const std::vector<Field>& fields) const {
    return channel.sensor->weights.empty() ? tables_[state].row(row)[channel.point]
                                           : weighted_sum(channel.sensor->weights, fields[state]);
  }

  const Database& database_;
  const std::vector<Channel>& channels_;
  std::vector<std::size_t> states_;  // that are looked at, `base` first
  std::vector<SceneTable> tables_;   // of these states
  bool with_fields_ = false;
};

}  // namespace

/// The index is that of the table as it is stored.
Library library_of(const Database& database, std::size_t state, BridgeShown shown) {
  Library library{table_of(database, state, shown), database.control_points(), database.layout()};
  const bool has_index = state == 0 || is_history(database.states().at(state));
  if (has_index && library.table.standing_share.empty()) library.index = database.search_index(state);
  return library;
}

std::string under_load(const std::string& load) {
  return load.empty() ? "" : " under " + load;
}

Library library_of_channels(const Database& database, std::size_t base, const std::vector<Channel>& channels,
                            BridgeShown shown) {
  const Predictions predictions(database, base, channels, shown);
  const auto storage = std::make_shared<const LibraryStorage>(predictions.compute());
  Library library{predictions.base(), {}, database.layout(), {}, storage};
  library.table.points = channels.size();
  library.table.vertical = storage->predictions;
  library.table.outcome = storage->outcome;
  library.table.standing_share = storage->standing_share;
  for (const Channel& channel : channels) {
    const Sensor& sensor = *channel.sensor;
    library.points.push_back({sensor.name + under_load(channel.load), sensor.position, sensor.blocks.front(),
                              sensor.quantity,
                              sensor.blocks.size() > 1 ? std::optional(sensor.blocks.back()) : std::nullopt});
  }
  return library;
}

void expect_displacements(const Library& library, std::size_t row) {
  if (library.table.has_displacements(row)) return;
  throw Failure(fmt::format(
      "of scene {} the database says only that it falls, without displacements to read: expected one that "
      "stands, or a database built with --collapses field, and of three missing blocks --without inherited",
      to_string(library.table.scene(row), library.layout)));
}

std::span<const double> intact_predictions(const SceneTable& table) {
  for (std::size_t row = 0; row < table.rows; ++row)
    if (table.scene(row).removed.empty()) return table.row(row);
  throw Failure("the database has no intact scene, from which changes count");
}

}  // namespace voussoir
