#include "generator/scenes/composition.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statics/elements.h"
#include "core/statics/sensitivity.h"
#include "core/statics/transposed_solver.h"
#include "database/format/field_codec.h"

namespace voussoir {
namespace {

/// Of a signal whose sum over so many points is this.
double allowed_error(double signal, double points) {
  return std::max(kComposedShare * signal, kComposedError * points);
}

/// What reads of a field what the point reads of the field's mirror image.
ControlPoint image_of(const ControlPoint& point, const MirrorSymmetry& symmetry) {
  const auto node_image = [&](NodeId node) {
    return symmetry.node_image[static_cast<std::size_t>(value(node))];
  };
  const auto block_image = [&](BlockId block) {
    return symmetry.block_image[static_cast<std::size_t>(value(block))];
  };
  ControlPoint image = point;
  image.node = node_image(point.node);
  image.block = block_image(point.block);
  for (NodeWeight& one : image.weights) one = {node_image(one.node), Point(-one.weight.x(), one.weight.y())};
  if (point.other_block) image.other_block = block_image(*point.other_block);
  return image;
}

bool read_the_same(const ControlPoint& a, const ControlPoint& b) {
  const auto is_same = [](const NodeWeight& first, const NodeWeight& second) {
    return first.node == second.node && first.weight == second.weight;
  };
  return a.node == b.node && std::ranges::equal(a.weights, b.weights, is_same);
}

bool read_the_same(const std::vector<ControlPoint>& first, const std::vector<ControlPoint>& second) {
  return first.size() == second.size() && std::ranges::all_of(first, [&](const ControlPoint& a) {
           return std::ranges::any_of(second, [&](const ControlPoint& b) { return read_the_same(a, b); });
         });
}

/// The points that every bridge has, whatever is measured.
std::vector<ControlPoint> usual_points(const Structure& structure) {
  const auto points_of = [&](const ControlPointDescription& kinds) {
    return find_control_points(structure.layout, structure.mesh, kinds);
  };
  std::vector<ControlPoint> points = points_of({.top = true, .arch = true, .face = false});
  return points.empty() ? points_of({.top = false, .arch = false, .face = true}) : points;
}

/// By which a composed scene is judged; first the usual points.
std::vector<std::vector<ControlPoint>> families_of(const Structure& structure) {
  std::vector<std::vector<ControlPoint>> families = {usual_points(structure)};
  if (families.front().empty()) return {};
  const auto add = [&](std::vector<ControlPoint> points) {
    const bool is_there = std::ranges::any_of(
        families, [&](const std::vector<ControlPoint>& other) { return read_the_same(points, other); });
    if (!is_there) families.push_back(std::move(points));
  };
  add(structure.control_points);
  if (!structure.symmetry) return families;
  std::vector<ControlPoint> images;
  for (const ControlPoint& point : structure.control_points)
    images.push_back(image_of(point, *structure.symmetry));
  add(std::move(images));
  return families;
}

}  // namespace

double composed_error(std::span<const double> composed, std::span<const double> solved,
                      std::span<const double> intact) {
  double error = 0.0, signal = 0.0, points = 0.0;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    if (std::isnan(solved[i])) continue;
    error += std::abs(composed[i] - solved[i]);
    signal += std::abs(solved[i] - intact[i]);
    points += 1.0;
  }
  return error == 0.0 ? 0.0 : error / allowed_error(signal, points);
}

Composition::Composition(const StageEquations& intact, const Field& displacement) {
  const EquilibriumSystem& system = *intact.system;
  TransposedSolver transposed(system);
  for (std::vector<ControlPoint>& points : families_of(*system.structure)) {
    ComponentRows influence = reading_columns(*system.structure, points);
    if (!transposed.solve(intact, displacement, influence)) {
      families_.clear();
      return;
    }
    families_.push_back({std::move(points), std::move(influence)});
  }
}

bool Composition::has_parts(const Scene& scene, const StartingFields& starts) const {
  return !families_.empty() && scene.missing() == 3 &&
         std::ranges::all_of(starting_subsets(scene),
                             [&](const Scene& part) { return starts.find(part, kBuilt) != nullptr; });
}

bool Composition::Family::allows(const Scene& scene, const Field& signal, const Field& unbalanced) const {
  const Eigen::VectorXd error = influence.transpose() * unbalanced.reshaped();
  double error_sum = 0.0, signal_sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (lacks(scene, points[i])) continue;
    error_sum += std::abs(error[static_cast<Eigen::Index>(i)]);
    signal_sum += std::abs(reading_at(points[i], signal));
    count += 1.0;
  }
  return kComposedMargin * error_sum <= allowed_error(signal_sum, count);
}

std::optional<Solution> Composition::of(const Scene& scene, const StartingFields& starts,
                                        const StageEquations& equations) const {
  const auto is_gone = [&](const ControlPoint& point) { return lacks(scene, point); };
  if (std::ranges::all_of(families_.front().points, is_gone)) return std::nullopt;
  const Field composed = to_storage_precision(*starts.start_for(scene, kBuilt));
  const Field unbalanced = unbalanced_forces(equations, composed);
  const Field signal = composed - *starts.intact(kBuilt);
  for (const Family& family : families_)
    if (!family.allows(scene, signal, unbalanced)) return std::nullopt;
  Solution solution;
  solution.outcome = Outcome::standing;
  solution.origin = Origin::composed;
  solution.residual = unbalanced.cwiseAbs().maxCoeff() / equations.largest_load;
  solution.displacement = composed;
  fill_removed(equations, std::numeric_limits<double>::quiet_NaN(), solution.displacement);
  return solution;
}

}  // namespace voussoir
