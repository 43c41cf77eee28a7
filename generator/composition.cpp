#include "generator/composition.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/statics/lane_factorisation.h"
#include "core/statics/sensitivity.h"
#include "database/format/field_codec.h"

namespace voussoir {
namespace {

/// Solves K^T z = b for each column b of the right-hand sides, several side by side; false if K is singular.
bool solve_transposed(const Eigen::SparseMatrix<double>& tangent, Eigen::MatrixXd& columns) {
  const Eigen::SparseMatrix<double> transposed = tangent.transpose();  // of the same, symmetric pattern
  LaneFactorisation linear(transposed);
  LaneVector values(static_cast<std::size_t>(transposed.nonZeros()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i].value = DoubleLanes{} + transposed.valuePtr()[i];
  if (!std::ranges::all_of(linear.factorise(values), std::identity{})) return false;
  LaneVector right(static_cast<std::size_t>(columns.rows()));
  for (Eigen::Index first = 0; first < columns.cols(); first += kLanes) {
    const Eigen::Index count = std::min<Eigen::Index>(kLanes, columns.cols() - first);
    for (Eigen::Index row = 0; row < columns.rows(); ++row)
      for (Eigen::Index lane = 0; lane < count; ++lane)
        right[static_cast<std::size_t>(row)].value[static_cast<std::size_t>(lane)] =
            columns(row, first + lane);
    linear.solve(right);
    for (Eigen::Index row = 0; row < columns.rows(); ++row)
      for (Eigen::Index lane = 0; lane < count; ++lane)
        columns(row, first + lane) =
            right[static_cast<std::size_t>(row)].value[static_cast<std::size_t>(lane)];
  }
  return true;
}

/// Of a signal whose sum over so many points is this.
double allowed_error(double signal, double points) {
  return std::max(kComposedShare * signal, kComposedError * points);
}

bool all_stand(const std::vector<Scene>& scenes, const StartingFields& starts) {
  return std::ranges::all_of(scenes,
                             [&](const Scene& scene) { return starts.find(scene, kBuilt) != nullptr; });
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
  return error / allowed_error(signal, points);
}

Composition::Composition(const StageEquations& intact, const Field& displacement) {
  const EquilibriumSystem& system = *intact.system;
  const Structure& structure = *system.structure;
  Eigen::SparseMatrix<double> tangent = system.pattern;
  assemble(intact, displacement, 0.0, {tangent.valuePtr()});
  const Eigen::MatrixXd readings = vertical_readings(structure, structure.control_points);
  Eigen::MatrixXd columns = readings(system.component, Eigen::all);
  if (!solve_transposed(tangent, columns)) return;
  influence_ = Eigen::MatrixXd::Zero(readings.rows(), readings.cols());
  influence_(system.component, Eigen::all) = columns;
}

std::optional<Solution> Composition::of(const Scene& scene, const StartingFields& starts,
                                        const StageEquations& equations) const {
  if (influence_.size() == 0 || scene.missing() != 3 || !all_stand(starting_subsets(scene), starts))
    return std::nullopt;
  const Structure& structure = *equations.system->structure;
  const Field composed = to_storage_precision(*starts.start_for(scene, kBuilt));
  const Field unbalanced = unbalanced_forces(equations, composed);
  const Eigen::VectorXd error = influence_.transpose() * unbalanced.reshaped();
  const Field signal = composed - *starts.intact(kBuilt);
  double error_sum = 0.0, signal_sum = 0.0, points = 0.0;
  for (std::size_t i = 0; i < structure.control_points.size(); ++i) {
    const ControlPoint& point = structure.control_points[i];
    if (scene.lacks(point.block)) continue;
    error_sum += std::abs(error[static_cast<Eigen::Index>(i)]);
    signal_sum += std::abs(signal(1, value(point.node)));
    points += 1.0;
  }
  if (!(kComposedMargin * error_sum <= allowed_error(signal_sum, points))) return std::nullopt;
  Solution solution;
  solution.outcome = Outcome::standing;
  solution.origin = Origin::composed;
  solution.residual = unbalanced.cwiseAbs().maxCoeff() / equations.largest_load;
  solution.displacement = composed;
  for (const BlockId block : scene.removed) {
    const IndexRange gone = structure.mesh.block_nodes[static_cast<std::size_t>(value(block))];
    solution.displacement.middleCols(gone.begin, gone.size())
        .setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return solution;
}

}  // namespace voussoir
