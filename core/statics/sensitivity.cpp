#include "core/statics/sensitivity.h"

#include "core/statics/elements.h"
#include "core/statics/parameter_derivatives.h"

namespace voussoir {
namespace {

/// Per standard deviation: components x parameters of an epoch.
ColumnMatrix movements_of(const EquilibriumSystem& system, const UncertainParameters& uncertain) {
  Eigen::MatrixXd movements(static_cast<Eigen::Index>(system.unknown.size()),
                            static_cast<Eigen::Index>(uncertain.of_epoch.size()));
  for (std::size_t i = 0; i < uncertain.of_epoch.size(); ++i) {
    const UncertainAction& action = uncertain.of_epoch[i];
    movements.col(static_cast<Eigen::Index>(i)) =
        movement_of(*system.structure, action, action.parameter.sigma).reshaped();
  }
  return movements.sparseView();
}

/// What the share of the forces that is still held back does to the readings, by a step's place.
ComponentRows held_back_by_place(const SolvedStep& step, const ComponentRows& lambda) {
  const EquilibriumSystem& system = *step.equations.system;
  Eigen::SparseMatrix<double> tangent = system.pattern;
  assemble(step.equations, step.place, 0.0, {tangent.valuePtr()});
  const ComponentRows by_free = tangent.transpose() * ComponentRows(lambda(system.component, Eigen::all));
  ComponentRows by_place = ComponentRows::Zero(lambda.rows(), lambda.cols());
  by_place(system.component, Eigen::all) = step.held_share * by_free;
  return by_place;
}

}  // namespace

/// Derivatives of the readings, on the way from the last step to the first.
struct SensitivitySolver::Adjoint {
  ComponentRows by_displacement;  ///< of the step's end: components x readings
  ComponentRows by_memory;        ///< of the step's end: (2 joints) x readings; empty: zero
  ComponentRows by_parameters;    ///< so far: parameters x readings

  bool is_zero() const { return by_displacement.isZero(0.0) && by_memory.isZero(0.0); }
};

void append_stage(const EquilibriumSystem& system, const Coefficients& coefficients, const Stage& stage,
                  const Solution& solution, int steps, SolvedHistory& history) {
  for (int step = 1; step <= steps; ++step) {
    std::vector<JointMemory> memory = memory_of_slip(solution.slipped);
    Field place = Field::Zero(2, system.structure->mesh.node_count());
    if (!history.empty()) {
      if (!has_slipped(solution))
        memory = updated_memory(history.back().equations, history.back().displacement);
      place = history.back().displacement;
    }
    const int left = steps - step;
    const Field& end =
        left == 0 ? solution.displacement : solution.steps[static_cast<std::size_t>(step - 1)].displacement;
    history.push_back({StageEquations(system, coefficients, stage, std::move(memory)), without_nan(end),
                       std::move(place), static_cast<double>(left) / (left + 1), has_slipped(solution)});
  }
}

Eigen::MatrixXd reading_columns(const Structure& structure, const std::vector<ControlPoint>& points) {
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(2 * structure.mesh.node_count(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto column = columns.col(static_cast<Eigen::Index>(i));
    if (points[i].weights.empty()) column[2 * value(points[i].node) + 1] = 1.0;
    for (const NodeWeight& part : points[i].weights) column.segment<2>(2 * value(part.node)) += part.weight;
  }
  return columns;
}

SensitivitySolver::SensitivitySolver(const EquilibriumSystem& system, const UncertainParameters& uncertain)
    : system_(system),
      uncertain_(uncertain),
      movements_(movements_of(system, uncertain)),
      transposed_(system) {}

/// From the derivatives by what a step ends with to those by what it begins with; adds what it does to the
/// parameters' own. The first step begins with nothing that depends on anything.
bool SensitivitySolver::step_back(const SolvedStep& step, bool is_first, Adjoint& adjoint) {
  if (!adjoint.by_memory.isZero(0.0)) {
    const MemoryJacobian jacobian = memory_jacobian(step.equations, step.displacement, uncertain_);
    adjoint.by_displacement.noalias() += jacobian.by_displacement.transpose() * adjoint.by_memory;
    adjoint.by_parameters.noalias() += jacobian.by_parameters.transpose() * adjoint.by_memory;
    const ComponentRows by_memory = jacobian.by_memory.transpose() * adjoint.by_memory;
    adjoint.by_memory = by_memory;
  }
  adjoint.by_parameters.bottomRows(movements_.cols()).noalias() +=
      movements_.transpose() * adjoint.by_displacement;
  for (std::size_t block = 0; block < step.equations.removed.size(); ++block) {
    const IndexRange& nodes = system_.structure->mesh.block_nodes[block];
    if (step.equations.removed[block])
      adjoint.by_displacement.middleRows(2 * nodes.begin, 2 * nodes.size()).setZero();
  }
  if (adjoint.by_displacement.isZero(0.0)) return true;
  ComponentRows lambda = std::move(adjoint.by_displacement);
  if (!transposed_.solve(step.equations, step.displacement, lambda)) return false;
  ColumnMatrix by_parameters =
      forces_by_parameters(step.equations, step.displacement, uncertain_, movements_);
  if (step.held_share > 0.0)
    by_parameters -=
        step.held_share * forces_by_parameters(step.equations, step.place, uncertain_, movements_);
  adjoint.by_parameters.noalias() += by_parameters.transpose() * lambda;
  if (is_first) return true;
  ColumnMatrix by_memory = forces_by_memory(step.equations, step.displacement);
  if (step.held_share > 0.0) {
    by_memory -= step.held_share * forces_by_memory(step.equations, step.place);
    adjoint.by_displacement = held_back_by_place(step, lambda);
  } else {
    adjoint.by_displacement.setZero(lambda.rows(), lambda.cols());
  }
  if (adjoint.by_memory.size() == 0) adjoint.by_memory.setZero(by_memory.cols(), lambda.cols());
  adjoint.by_memory.noalias() += by_memory.transpose() * lambda;
  return true;
}

std::optional<Eigen::MatrixXd> SensitivitySolver::solve(const SolvedHistory& history,
                                                        const Eigen::MatrixXd& readings) {
  const auto parameters = static_cast<Eigen::Index>(uncertain_.of_bridge.size() + uncertain_.of_epoch.size());
  Adjoint adjoint{readings, {}, Eigen::MatrixXd::Zero(parameters, readings.cols())};
  for (auto step = history.rbegin(); step != history.rend() && !adjoint.is_zero(); ++step) {
    const bool is_first = step->has_slipped || std::next(step) == history.rend();
    if (!step_back(*step, is_first, adjoint)) return std::nullopt;
    if (is_first) break;
  }
  return adjoint.by_parameters.transpose();
}

}  // namespace voussoir
