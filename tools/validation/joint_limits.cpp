#include "tools/validation/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "core/statics/quasi_static_solver.h"
#include "tools/validation/bisection.h"

namespace voussoir::validation {
namespace {

constexpr double kSpecificWeight = 2400.0 * 9.81;  ///< [N/m3]

}  // namespace

double compliance(double normal_stiffness) {
  return kSpecificWeight / normal_stiffness;
}

bool newton_stands(const Model& bridge, Field& start, const Field& load) {
  QuasiStaticSettings settings;
  settings.most_warm_iterations = 200;
  settings.most_iterations = 100;
  QuasiStaticSolver solver(bridge, settings);
  StageTask task;
  task.stage.load = load;
  if (start.size() > 0) task.start = &start;
  const Solution solution = solver.solve(task);
  if (solution.outcome != Outcome::standing) return false;
  start = solution.displacement;
  return true;
}

Limit find_limit(const std::vector<double>& stiffnesses, const std::function<double(double)>& value) {
  Limit limit;
  for (const double stiffness : stiffnesses) {
    limit.roots.push_back(std::cbrt(compliance(stiffness)));
    limit.values.push_back(value(stiffness));
  }
  const std::size_t order = std::max<std::size_t>(3, stiffnesses.size() - 1);
  limit.rigid = extrapolated(limit.roots, limit.values, order);
  limit.spread =
      std::abs(extrapolated(limit.roots, limit.values, 3) - extrapolated(limit.roots, limit.values, 2));
  return limit;
}

}  // namespace voussoir::validation
