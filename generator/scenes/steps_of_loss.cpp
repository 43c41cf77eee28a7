#include "generator/scenes/steps_of_loss.h"

#include <algorithm>

#include "core/solve/state_plan.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

int StepsOfLoss::of(const Scene& scene) const {
  if (scene.missing() <= 1) return kStepsOfLoss;
  const bool needs_many =
      std::ranges::any_of(scene.removed, [&](BlockId block) { return needing_many_.contains(block); });
  return needs_many ? kStepsOfSeveral : 1;
}

std::vector<ControlPoint> deciding_points(const Structure& structure) {
  const auto points_of = [&](const ControlPointDescription& kinds) {
    return find_control_points(structure.layout, structure.mesh, kinds);
  };
  std::vector<ControlPoint> points = points_of({.top = true, .arch = false, .face = false});
  if (points.empty()) points = points_of({.top = false, .arch = true, .face = true});
  return points;
}

bool differ_in_signal(const Field& one_step, const Field& many_steps, const Field& intact,
                      const std::vector<ControlPoint>& points) {
  const Eigen::VectorXd one = readings_at(points, one_step);
  const Eigen::VectorXd many = readings_at(points, many_steps);
  const Eigen::VectorXd unmoved = readings_at(points, intact);
  const auto l1 = [](const auto& values) {
    return values.array().isNaN().select(0.0, values.array()).abs().sum();
  };
  return l1(Eigen::VectorXd(one - many)) > kSameSignal * l1(Eigen::VectorXd(many - unmoved));
}

}  // namespace voussoir
