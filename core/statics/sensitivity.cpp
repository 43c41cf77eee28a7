#include "core/statics/sensitivity.h"

#include <algorithm>

#include "core/statics/parameter_derivatives.h"

namespace voussoir {
namespace {

Field without_nan(const Field& field) {
  return field.array().isNaN().select(0.0, field);
}

std::vector<int> transposed_slots(const Eigen::SparseMatrix<double>& pattern) {
  const int* begin = pattern.outerIndexPtr();
  const int* row = pattern.innerIndexPtr();
  std::vector<int> slots(static_cast<std::size_t>(pattern.nonZeros()));
  for (int column = 0; column < pattern.outerSize(); ++column)
    for (int slot = begin[column]; slot < begin[column + 1]; ++slot) {
      const int* mirror = std::lower_bound(row + begin[row[slot]], row + begin[row[slot] + 1], column);
      slots[static_cast<std::size_t>(slot)] = static_cast<int>(mirror - row);
    }
  return slots;
}

/// Per standard deviation: components x parameters of an epoch.
Eigen::MatrixXd movements_of(const EquilibriumSystem& system, const UncertainParameters& uncertain) {
  Eigen::MatrixXd movements(static_cast<Eigen::Index>(system.unknown.size()),
                            static_cast<Eigen::Index>(uncertain.of_epoch.size()));
  for (std::size_t i = 0; i < uncertain.of_epoch.size(); ++i) {
    const UncertainAction& action = uncertain.of_epoch[i];
    movements.col(static_cast<Eigen::Index>(i)) =
        movement_of(*system.structure, action, action.parameter.sigma).reshaped();
  }
  return movements;
}

}  // namespace

/// Derivatives of the readings, on the way from the last step to the first.
struct SensitivitySolver::Adjoint {
  Eigen::MatrixXd by_displacement;  ///< of the step's end: components x readings
  Eigen::MatrixXd by_memory;        ///< of the step's end: (2 joints) x readings
  Eigen::MatrixXd by_parameters;    ///< so far: parameters x readings

  bool is_zero() const { return by_displacement.isZero(0.0) && by_memory.isZero(0.0); }
};

void append_stage(const EquilibriumSystem& system, const Coefficients& coefficients, const Stage& stage,
                  const Solution& solution, int steps, SolvedHistory& history) {
  for (int step = 1; step <= steps; ++step) {
    std::vector<JointMemory> memory;
    Field place = Field::Zero(2, system.structure->mesh.node_count());
    if (!history.empty()) {
      memory = updated_memory(history.back().equations, history.back().displacement);
      place = history.back().displacement;
    }
    const int left = steps - step;
    const Field& end =
        left == 0 ? solution.displacement : solution.steps[static_cast<std::size_t>(step - 1)].displacement;
    history.push_back({StageEquations(system, coefficients, stage, std::move(memory)), without_nan(end),
                       std::move(place), static_cast<double>(left) / (left + 1)});
  }
}

Eigen::MatrixXd vertical_readings(const Structure& structure, const std::vector<ControlPoint>& points) {
  Eigen::MatrixXd readings =
      Eigen::MatrixXd::Zero(2 * structure.mesh.node_count(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    readings(2 * value(points[i].node) + 1, static_cast<Eigen::Index>(i)) = 1.0;
  return readings;
}

SensitivitySolver::SensitivitySolver(const EquilibriumSystem& system, const UncertainParameters& uncertain)
    : system_(system),
      uncertain_(uncertain),
      movements_(movements_of(system, uncertain)),
      transposed_slot_(transposed_slots(system.pattern)),
      linear_(system.pattern),
      tangent_(static_cast<std::size_t>(system.pattern.nonZeros())),
      lanes_(tangent_.size()),
      right_(static_cast<std::size_t>(system.unknown_count())) {}

/// Replaces right-hand sides, at all components, by solutions of the transposed tangent; zero at held ones.
bool SensitivitySolver::solve_transposed(const SolvedStep& step, Eigen::MatrixXd& right_hand_sides) {
  assemble(step.equations, step.displacement, 0.0, {tangent_.data()});
  for (std::size_t i = 0; i < tangent_.size(); ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes_[i].value[lane] = tangent_[static_cast<std::size_t>(transposed_slot_[i])];
  if (!linear_.factorise(lanes_).front()) return false;
  const Eigen::MatrixXd given = right_hand_sides;
  right_hand_sides.setZero();
  for (Eigen::Index first = 0; first < given.cols(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, static_cast<std::size_t>(given.cols() - first));
    for (std::size_t i = 0; i < right_.size(); ++i)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        right_[i].value[lane] =
            lane < count ? given(system_.component[i], first + static_cast<Eigen::Index>(lane)) : 0.0;
    linear_.solve(right_);
    for (std::size_t i = 0; i < right_.size(); ++i)
      for (std::size_t lane = 0; lane < count; ++lane)
        right_hand_sides(system_.component[i], first + static_cast<Eigen::Index>(lane)) =
            right_[i].value[lane];
  }
  return right_hand_sides.allFinite();
}

/// From the derivatives by what a step ends with to those by what it begins with; adds what it does to the
/// parameters' own.
bool SensitivitySolver::step_back(const SolvedStep& step, Adjoint& adjoint) {
  if (!adjoint.by_memory.isZero(0.0)) {
    const MemoryJacobian jacobian = memory_jacobian(step.equations, step.displacement, uncertain_);
    adjoint.by_displacement += jacobian.by_displacement.transpose() * adjoint.by_memory;
    adjoint.by_parameters += jacobian.by_parameters.transpose() * adjoint.by_memory;
    adjoint.by_memory = (jacobian.by_memory.transpose() * adjoint.by_memory).eval();
  }
  adjoint.by_parameters.bottomRows(movements_.cols()) += movements_.transpose() * adjoint.by_displacement;
  for (std::size_t block = 0; block < step.equations.removed.size(); ++block) {
    const IndexRange& nodes = system_.structure->mesh.block_nodes[block];
    if (step.equations.removed[block])
      adjoint.by_displacement.middleRows(2 * nodes.begin, 2 * nodes.size()).setZero();
  }
  if (adjoint.by_displacement.isZero(0.0)) return true;
  Eigen::MatrixXd lambda = std::move(adjoint.by_displacement);
  adjoint.by_displacement = Eigen::MatrixXd::Zero(lambda.rows(), lambda.cols());
  if (!solve_transposed(step, lambda)) return false;
  ColumnMatrix by_parameters =
      forces_by_parameters(step.equations, step.displacement, uncertain_, movements_);
  ColumnMatrix by_memory = forces_by_memory(step.equations, step.displacement);
  if (step.held_share > 0.0) {
    by_parameters -=
        step.held_share * forces_by_parameters(step.equations, step.place, uncertain_, movements_);
    by_memory -= step.held_share * forces_by_memory(step.equations, step.place);
    assemble(step.equations, step.place, 0.0, {tangent_.data()});
    Eigen::SparseMatrix<double> tangent = system_.pattern;
    std::ranges::copy(tangent_, tangent.valuePtr());
    Eigen::MatrixXd free(system_.unknown_count(), lambda.cols());
    for (Eigen::Index i = 0; i < free.rows(); ++i)
      free.row(i) = lambda.row(system_.component[static_cast<std::size_t>(i)]);
    const Eigen::MatrixXd held_back = step.held_share * (tangent.transpose() * free);
    for (Eigen::Index i = 0; i < free.rows(); ++i)
      adjoint.by_displacement.row(system_.component[static_cast<std::size_t>(i)]) = held_back.row(i);
  }
  adjoint.by_parameters += by_parameters.transpose() * lambda;
  adjoint.by_memory += by_memory.transpose() * lambda;
  return true;
}

std::optional<Eigen::MatrixXd> SensitivitySolver::solve(const SolvedHistory& history,
                                                        const Eigen::MatrixXd& readings) {
  const auto parameters = static_cast<Eigen::Index>(uncertain_.of_bridge.size() + uncertain_.of_epoch.size());
  Adjoint adjoint{
      readings, Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * system_.joints.size()), readings.cols()),
      Eigen::MatrixXd::Zero(parameters, readings.cols())};
  for (auto step = history.rbegin(); step != history.rend() && !adjoint.is_zero(); ++step)
    if (!step_back(*step, adjoint)) return std::nullopt;
  return adjoint.by_parameters.transpose();
}

}  // namespace voussoir
