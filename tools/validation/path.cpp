#include "tools/validation/path.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/statics/elements.h"

namespace voussoir::validation {
namespace {

constexpr int kMostStepHalvings = 5;
constexpr std::size_t kRecent = 4;   ///< a Newton step may rise to the worst of so many residuals
constexpr double kProbe = 1e-3;      ///< share of a movement by which its forces are differentiated
constexpr double kFirstDrag = 1e-2;  ///< of the tangent's mean diagonal
constexpr double kLeastDrag = 1e-9;
constexpr double kMostDrag = 1e3;
constexpr double kDragFactor = 4.0;  ///< weaker after a step of a snap, stronger where one fails

double dissipated_by_mortar(const StageEquations& equations, const Field& displacement) {
  double sum = 0.0;
  for_present_joints(equations, [&](const Joint& joint, std::size_t j) {
    const CohesiveStiffness* mortar = equations.coefficients->mortar_of(j);
    if (mortar == nullptr) return;
    const JointPose pose = joint_pose(equations.system->joints[j], gathered(displacement, corners(joint)));
    sum += dissipated_energy(*mortar, equations.memory[j], pose.state);
  });
  return sum;
}

/// Forces that hold the structure near a place, proportional to the way from it.
struct UniformDrag {
  double stiffness = 0.0;  ///< [N/m]
  Field place;
};

class PathFollower {
 public:
  PathFollower(const EquilibriumSystem& system, const Coefficients& coefficients, const PathTask& task,
               const PathSettings& settings)
      : system_(system),
        coefficients_(coefficients),
        task_(task),
        settings_(settings),
        tangent_(system.pattern),
        state_(task.start),
        change_(Field::Zero(2, task.start.displacement.cols())) {}

  Path follow() {
    Path path;
    const double whole = 1.0 / settings_.steps;
    double step = whole;
    while (share_ < 1.0 - 1e-9) {
      const double next = std::min(1.0, share_ + step);
      iterations_ = 0;
      if (take_step(next)) {
        path.points.push_back(point(false));
        step = std::min(2.0 * step, whole);
      } else if (step > settings_.smallest_step * whole) {
        step *= 0.5;
      } else if (snap(next)) {
        path.points.push_back(point(true));
      } else {
        return path;
      }
    }
    path.complete = true;
    return path;
  }

 private:
  StageEquations equations_at(double share) const {
    return {system_, coefficients_, on_the_way(task_.from, task_.to, share), state_.memory};
  }

  /// From the last movement, or from the tangent.
  bool take_step(double next) {
    const StageEquations equations = equations_at(next);
    if (last_step_ > 0.0) {
      const Field guess = state_.displacement + (next - share_) / last_step_ * change_;
      if (const auto found = newton(equations, admissible(equations, guess), {}))
        return commit(equations, *found, next);
    }
    const auto guess = tangent_guess(equations);
    if (!guess) return false;
    const auto found = newton(equations, *guess, {});
    return found && commit(equations, *found, next);
  }

  bool commit(const StageEquations& equations, const Field& found, double next) {
    dissipated_ += dissipated_by_mortar(equations, found);
    largest_force_ = force_unit(equations, found);
    change_ = found - state_.displacement;
    last_step_ = next - share_;
    state_.memory = updated_memory(equations, found);
    state_.displacement = found;
    share_ = next;
    return true;
  }

  PathPoint point(bool snapped) const {
    const StageEquations equations = equations_at(share_);
    return {.share = share_,
            .state = state_,
            .support_forces = support_forces(equations, state_.displacement),
            .dissipated = dissipated_,
            .snapped = snapped,
            .iterations = iterations_};
  }

  /// What the movement and the new loads would do if nothing else changed than what the tangent says.
  std::optional<Field> tangent_guess(const StageEquations& equations) {
    const Field& here = state_.displacement;
    const Field moved = admissible(equations, here);
    const Field unbalanced = assemble(equations, here, 0.0, {tangent_.valuePtr()});
    const Field by_movement =
        (unbalanced_forces(equations, here + kProbe * (moved - here)) - unbalanced) / kProbe;
    const auto change = solve(unbalanced + by_movement);
    if (!change) return std::nullopt;
    return moved + *change;
  }

  /// Precondition: the tangent is assembled.
  std::optional<Field> solve(const Field& unbalanced) {
    ++iterations_;
    if (!analysed_) linear_.analyzePattern(tangent_);
    analysed_ = true;
    linear_.factorize(tangent_);
    if (linear_.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd right(system_.unknown_count());
    for (int i = 0; i < right.size(); ++i)
      right[i] = unbalanced.data()[system_.component[static_cast<std::size_t>(i)]];
    const Eigen::VectorXd answer = linear_.solve(right);
    if (!answer.allFinite()) return std::nullopt;
    Field change = Field::Zero(unbalanced.rows(), unbalanced.cols());
    for (int i = 0; i < answer.size(); ++i)
      change.data()[system_.component[static_cast<std::size_t>(i)]] = answer[i];
    return change;
  }

  Field unbalance(const StageEquations& equations, const Field& place, const UniformDrag& drag) {
    Field forces = assemble(equations, place, 0.0, {tangent_.valuePtr()});
    if (drag.stiffness == 0.0) return forces;
    for (int i = 0; i < system_.unknown_count(); ++i) {
      const int c = system_.component[static_cast<std::size_t>(i)];
      forces.data()[c] -= drag.stiffness * (place.data()[c] - drag.place.data()[c]);
      tangent_.valuePtr()[system_.diagonal_slots[static_cast<std::size_t>(i)]] += drag.stiffness;
    }
    return forces;
  }

  /// Largest force that a support or the load has exerted yet [N].
  double force_unit(const StageEquations& equations, const Field& place) const {
    return std::max({largest_force_, equations.load.cwiseAbs().maxCoeff(),
                     support_forces(equations, place).cwiseAbs().maxCoeff()});
  }

  std::optional<Field> newton(const StageEquations& equations, Field place, const UniformDrag& drag) {
    std::vector<double> recent;
    Field unbalanced = unbalance(equations, place, drag);
    recent.push_back(unbalanced.norm());
    for (int iteration = 0;; ++iteration) {
      if (!std::isfinite(recent.back())) return std::nullopt;
      if (unbalanced.cwiseAbs().maxCoeff() <= settings_.tolerance * force_unit(equations, place))
        return place;
      if (iteration == settings_.most_iterations) return std::nullopt;
      const auto change = solve(unbalanced);
      if (!change) return std::nullopt;
      const auto begin = recent.size() > kRecent ? recent.end() - kRecent : recent.begin();
      const double bound = *std::max_element(begin, recent.end());
      const Field before = place;
      double factor = 1.0;
      for (int halving = 0; halving <= kMostStepHalvings; ++halving, factor *= 0.5) {
        place = before + factor * *change;
        unbalanced = unbalance(equations, place, drag);
        if (unbalanced.norm() < bound) break;
      }
      recent.push_back(unbalanced.norm());
    }
  }

  /// Lets the structure go from where it is, held back less and less.
  bool snap(double next) {
    const double mean = mean_stiffness();
    double drag = kFirstDrag;
    for (int step = 0; step < settings_.most_snap_steps; ++step) {
      const StageEquations equations = equations_at(next);
      const Field start = admissible(equations, state_.displacement);
      const auto found = newton(equations, start, {drag * mean, start});
      if (!found) {
        drag *= kDragFactor * kDragFactor;
        if (drag > kMostDrag) return false;
        continue;
      }
      const double way = (*found - start).cwiseAbs().maxCoeff();
      const double unit = force_unit(equations, *found);
      commit(equations, *found, next);
      if (drag * mean * way <= settings_.tolerance * unit) {
        last_step_ = 0.0;
        return true;
      }
      drag = std::max(drag / kDragFactor, kLeastDrag);
    }
    return false;
  }

  double mean_stiffness() {
    const StageEquations equations = equations_at(share_);
    assemble(equations, state_.displacement, 0.0, {tangent_.valuePtr()});
    double sum = 0.0;
    for (const int slot : system_.diagonal_slots) sum += std::abs(tangent_.valuePtr()[slot]);
    return sum / static_cast<double>(system_.diagonal_slots.size());
  }

  const EquilibriumSystem& system_;
  const Coefficients& coefficients_;
  const PathTask& task_;
  const PathSettings& settings_;
  Eigen::SparseMatrix<double> tangent_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> linear_;
  bool analysed_ = false;
  State state_;
  Field change_;            ///< of the last step
  double last_step_ = 0.0;  ///< share; 0: the last step does not show the way
  double share_ = 0.0;
  double dissipated_ = 0.0;
  double largest_force_ = 0.0;
  int iterations_ = 0;
};

}  // namespace

Path follow_path(const EquilibriumSystem& system, const Coefficients& coefficients, const PathTask& task,
                 const PathSettings& settings) {
  return PathFollower(system, coefficients, task, settings).follow();
}

}  // namespace voussoir::validation
