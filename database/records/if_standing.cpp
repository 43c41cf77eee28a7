#include "database/records/if_standing.h"

#include <algorithm>

#include "core/not_a_number.h"

namespace voussoir {
namespace {

/// A point on a block that is gone shows nothing.
void put_fall(const Scene& scene, const Eigen::VectorXd& shown, const std::vector<StoredPoint>& points,
              std::span<double> row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_gone =
        std::ranges::any_of(scene.removed, [&](BlockId block) { return points[i].is_on(block); });
    row[i] = is_gone ? kNan : shown[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

std::optional<IfStanding> if_standing(const SceneTable& table, const Sensitivities& sensitivities,
                                      std::size_t state, const std::vector<StoredPoint>& points) {
  if (sensitivities.standing_share.empty()) return std::nullopt;
  std::optional<IfStanding> made;
  for (const Scene& scene : sensitivities.scenes) {
    const auto fall = sensitivities.find_fall(state, scene);
    const auto row = fall ? table.find(scene) : std::nullopt;
    if (!row || table.stands(*row)) continue;
    if (!made) made = {{table.vertical.begin(), table.vertical.end()}, std::vector<double>(table.rows, 0.0)};
    put_fall(scene, fall->if_standing, points,
             std::span(made->vertical).subspan(*row * table.points, table.points));
    made->standing_share[*row] = fall->standing_share;
  }
  return made;
}

}  // namespace voussoir
