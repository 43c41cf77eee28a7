#include "tools/validation/movements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/structure/rigid_movement.h"

namespace voussoir::validation {
namespace {

constexpr int kMostTrials = 50;
constexpr double kPressureTolerance = 1e-6;

std::size_t support_called(const Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.supports, name, &Support::name);
  if (found != model.supports.end()) return static_cast<std::size_t>(found - model.supports.begin());
  std::string names;
  for (const Support& support : model.supports) names += (names.empty() ? "" : ", ") + support.name;
  throw InputError(
      fmt::format("support in [[movements]]: '{}' does not exist: expected one of {}", name, names));
}

Point force_of_support(std::size_t support, const Model& model, const Field& forces) {
  Point sum = Point::Zero();
  for (const NodeId node : model.supports[support].nodes)
    for (const int axis : {0, 1})
      if (goes_with(model.supports, support, node, axis)) sum[axis] += forces(axis, value(node));
  return sum;
}

/// Of the blocks under the support, each cut across between its nodes there [m2].
double area_under(const Support& support, const Model& model) {
  double area = 0.0;
  for (std::size_t b = 0; b < model.mesh.block_nodes.size(); ++b) {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const NodeId node : support.nodes) {
      if (!model.mesh.block_nodes[b].contains(value(node))) continue;
      left = std::min(left, model.mesh.position(node).x());
      right = std::max(right, model.mesh.position(node).x());
    }
    if (right > left) area += (right - left) * model.parameters.blocks[b].thickness;
  }
  return area;
}

class Mover {
 public:
  Mover(const Model& model, const PathSettings& settings)
      : model_(model),
        settings_(settings),
        system_(model),
        coefficients_(system_, model.parameters),
        moved_(Field::Zero(2, model.mesh.node_count())),
        state_{moved_, {}} {
    const Path path = go({.gravity_share = 0.0, .support_movement = moved_}, moved_, 1);
    if (!path.complete)
      throw InputError("the structure does not stand under its weight before supports move");
    state_ = path.points.back().state;
  }

  void follow(const MovementDescription& movement, std::size_t number, MovedStructure& result) {
    const std::size_t support = support_called(model_, movement.support);
    const Stage from{.support_movement = moved_};
    const Point way = movement.pressure ? way_to_pressure(support, *movement.pressure, from)
                                        : Point(movement.x, movement.y);
    const Field target = moved_ + rigid_movement(model_, support, way, 0.0);
    const Path path = go(from, target, movement.steps);
    Point& so_far = ways_.try_emplace(movement.support, Point::Zero()).first->second;
    for (const PathPoint& point : path.points)
      result.points.push_back({number, so_far + point.share * way,
                               force_of_support(support, model_, point.support_forces), point});
    result.complete = path.complete;
    if (!path.complete) return;
    so_far += way;
    moved_ = target;
    state_ = path.points.back().state;
  }

 private:
  Path go(const Stage& from, const Field& target, int steps) const {
    PathSettings settings = settings_;
    settings.steps = steps;
    return follow_path(system_, coefficients_,
                       {.from = from, .to = {.support_movement = target}, .start = state_}, settings);
  }

  /// Down until the mean pressure is met.
  Point way_to_pressure(std::size_t support, double pressure, const Stage& from) const {
    const double goal = pressure * area_under(model_.supports[support], model_);
    double softest = model_.parameters.contact.normal_stiffness * mean_block_size(model_);
    for (const Material& material : model_.parameters.blocks)
      softest = std::min(softest, material.young_modulus);
    double way = pressure / softest * mean_block_size(model_);
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const Field target = moved_ + rigid_movement(model_, support, {0.0, -way}, 0.0);
      const Path path = go(from, target, 1);
      const double reached =
          path.complete ? -force_of_support(support, model_, path.points.back().support_forces).y() : 0.0;
      if (!(reached > 0.0)) break;
      if (std::abs(reached / goal - 1.0) <= kPressureTolerance) return {0.0, -way};
      way *= goal / reached;
    }
    throw InputError(fmt::format("pressure_Pa in [[movements]]: {:g} is not reached by moving '{}'", pressure,
                                 model_.supports[support].name));
  }

  const Model& model_;
  const PathSettings& settings_;
  EquilibriumSystem system_;
  Coefficients coefficients_;
  Field moved_;
  State state_;
  std::map<std::string, Point> ways_;
};

}  // namespace

MovedStructure follow_movements(const Model& model, const std::vector<MovementDescription>& movements,
                                const PathSettings& settings) {
  MovedStructure result;
  Mover mover(model, settings);
  for (std::size_t i = 0; i < movements.size(); ++i) {
    mover.follow(movements[i], i, result);
    if (!result.complete) break;
  }
  return result;
}

}  // namespace voussoir::validation
