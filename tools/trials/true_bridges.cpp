#include "tools/trials/true_bridges.h"

#include "core/error.h"
#include "core/solve/state_name.h"

namespace voussoir {
namespace {

std::vector<double> shown(const SceneTable& table, std::size_t row) {
  const auto values = table.row(row);
  return {values.begin(), values.end()};
}

TrueBridge read_bridge(const Database& database, std::int32_t variant, std::size_t built, std::size_t lost) {
  const SceneTable as_built = database.table(variant, built);
  const SceneTable as_lost = database.table(variant, lost);
  TrueBridge bridge;
  for (std::size_t row = 0; row < as_built.rows; ++row) {
    if (!as_built.stands(row) || !as_lost.stands(row)) continue;
    const Scene scene = as_built.scene(row);
    if (scene.removed.empty())
      bridge.intact = shown(as_built, row);
    else
      bridge.damaged.push_back({scene, shown(as_built, row), shown(as_lost, row)});
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

std::vector<TrueBridge> read_true_bridges(const Database& database) {
  const std::size_t built = state_of(database, kBuiltState), lost = state_of(database, kLostState);
  if (database.variant_count() < 2)
    throw Failure(fmt::format("{}: has no variants beside the nominal bridge (build-database --variants)",
                              database.path().string()));
  std::vector<TrueBridge> bridges;
  for (std::size_t variant = 1; variant < database.variant_count(); ++variant)
    bridges.push_back(read_bridge(database, static_cast<std::int32_t>(variant), built, lost));
  return bridges;
}

}  // namespace voussoir
