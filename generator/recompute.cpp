#include "generator/recompute.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "core/structure/mirror_symmetry.h"
#include "generator/start_field.h"

namespace voussoir {
namespace {

double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0.0;
  const double apart = std::abs(a - b);
  return std::isnan(apart) ? std::numeric_limits<double>::infinity() : apart;
}

}  // namespace

std::vector<std::size_t> choose_rows(std::size_t rows, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> chosen(rows);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  count = std::min(count, rows);
  for (std::size_t i = 0; i < count; ++i) std::swap(chosen[i], chosen[i + random() % (rows - i)]);
  chosen.resize(count);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Solution recompute(const RecordKey& key, const Database& database, const Model& bridge,
                   const PlanRules& rules, const SceneSolver& solver) {
  const Scene solved = representative(key.scene, bridge, rules);
  StartingFields starts;
  for (const Scene& start : starting_scenes(solved, rules)) {
    const auto row = database.has_fields() ? database.find(key.variant, start) : std::nullopt;
    const Solution solution =
        row ? database.solution(*row) : recompute({key.variant, start}, database, bridge, rules, solver);
    starts.add(start, solution.outcome, solution.displacement);
  }
  const auto start = starts.start_for(solved);
  const StageTask task{.stage = {.scene = solved}, .start = start ? &*start : nullptr};
  const Solution solution = solve_for_storage(solver, std::span(&task, 1)).front();
  return solved == key.scene ? solution : mirrored_solution(solution, *bridge.symmetry);
}

double largest_difference(const Solution& recomputed, const Database& database, std::size_t row,
                          const std::vector<ControlPoint>& points) {
  double largest = 0.0;
  const auto compare = [&largest](const auto& now, const auto& stored) {
    for (Eigen::Index i = 0; i < now.size(); ++i) largest = std::max(largest, difference(now(i), stored(i)));
  };
  if (database.has_fields()) {
    const Field stored = database.field(row);
    compare(recomputed.displacement.reshaped(), stored.reshaped());
  } else {
    const std::vector<double> stored = database.record(row).states.front().vertical;
    compare(vertical_displacements(recomputed.displacement, points),
            Eigen::Map<const Eigen::VectorXd>(stored.data(), static_cast<Eigen::Index>(stored.size())));
  }
  return largest;
}

}  // namespace voussoir
