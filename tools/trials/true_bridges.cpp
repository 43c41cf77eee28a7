#include "tools/trials/true_bridges.h"

#include <algorithm>
#include <functional>

#include "core/error.h"
#include "core/solve/state_name.h"

namespace voussoir {
namespace {

std::vector<double> shown(const SceneTable& table, std::size_t row) {
  const auto values = table.row(row);
  return {values.begin(), values.end()};
}

/// The states that trials are about.
struct AskedStates {
  std::size_t built, lost;
  std::optional<std::size_t> loaded;  ///< after `lost`
};

TrueBridge read_bridge(const Database& database, std::int32_t variant, const AskedStates& states) {
  const SceneTable as_built = database.table(variant, states.built);
  const SceneTable as_lost = database.table(variant, states.lost);
  const SceneTable loaded = database.table(variant, states.loaded.value_or(states.lost));
  TrueBridge bridge;
  for (std::size_t row = 0; row < as_built.rows; ++row) {
    if (!as_built.stands(row) || !as_lost.stands(row) || !loaded.stands(row)) continue;
    const Scene scene = as_built.scene(row);
    std::vector<double> added;
    if (states.loaded) added = added_by_load(shown(loaded, row), shown(as_lost, row));
    if (scene.removed.empty()) {
      bridge.intact = shown(as_built, row);
      bridge.added = std::move(added);
    } else {
      bridge.damaged.push_back({scene, shown(as_built, row), shown(as_lost, row), std::move(added)});
    }
  }
  if (bridge.intact.empty())
    throw Failure(fmt::format("{}: the intact bridge of variant {} is missing or does not stand",
                              database.path().string(), variant));
  return bridge;
}

std::size_t state_of(const Database& database, const std::string& name) {
  const auto state = database.find_state(name);
  if (!state) throw Failure(fmt::format("{}: has no state {}", database.path().string(), name));
  return *state;
}

}  // namespace

std::vector<double> added_by_load(std::vector<double> loaded, const std::vector<double>& unloaded) {
  std::ranges::transform(loaded, unloaded, loaded.begin(), std::minus{});
  return loaded;
}

std::vector<TrueBridge> read_true_bridges(const Database& database, const std::string& load) {
  AskedStates states{state_of(database, kBuiltState), state_of(database, kLostState), {}};
  if (!load.empty()) states.loaded = state_of(database, state_name(kLostState, load));
  if (database.variant_count() < 2)
    throw Failure(fmt::format("{}: has no variants beside the nominal bridge (build-database --variants)",
                              database.path().string()));
  std::vector<TrueBridge> bridges;
  for (std::size_t variant = 1; variant < database.variant_count(); ++variant)
    bridges.push_back(read_bridge(database, static_cast<std::int32_t>(variant), states));
  return bridges;
}

}  // namespace voussoir
