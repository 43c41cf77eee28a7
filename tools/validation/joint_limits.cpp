#include "tools/validation/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/statics/quasi_static_solver.h"
#include "tools/validation/assemblies.h"
#include "tools/validation/bisection.h"

namespace voussoir::validation {
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

double continued_down(double from, double step, double width, const std::function<Model(double)>& bridge_of) {
  Field at;
  if (!newton_stands(bridge_of(from), at)) throw Failure("no equilibrium to go on from");
  Field per_step = Field::Zero(2, at.cols());
  while (step > width) {
    Field next = at + step * per_step;
    if (newton_stands(bridge_of(from - step), next)) {
      per_step = (next - at) / step;
      at = std::move(next);
      from -= step;
    } else {
      step *= 0.5;
    }
  }
  return from;
}

Limit find_limit(const std::vector<double>& stiffnesses, const std::function<double(double)>& value,
                 double power) {
  Limit limit;
  for (const double stiffness : stiffnesses) {
    limit.roots.push_back(std::pow(compliance(stiffness), power));
    limit.values.push_back(value(stiffness));
  }
  const std::size_t order = std::max<std::size_t>(3, stiffnesses.size() - 1);
  limit.rigid = extrapolated(limit.roots, limit.values, order);
  limit.spread =
      std::abs(extrapolated(limit.roots, limit.values, 3) - extrapolated(limit.roots, limit.values, 2));
  return limit;
}

}  // namespace voussoir::validation
