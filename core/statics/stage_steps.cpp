#include "core/statics/stage_steps.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/statics/elements.h"
#include "core/structure/collapse.h"

namespace voussoir {
namespace {

/// A step ends near where it was expected if it is no further off than the whole sag in the step's share, or
/// this often what the tangent had said. Chosen, not tuned.
constexpr double kTangentSteps = 2.0;
/// Of the drag at first, in sags. A tenth takes 1.1 times as many systems (docs/tried.md).
constexpr double kFirstReach = 1e-2;
/// In sags; below it the structure is given up. Chosen, not tuned.
constexpr double kLeastReach = 1e-8;
/// By which the reach grows after each step; it shrinks by its square where one fails. Ten takes 1.8 times as
/// many systems (docs/tried.md).
constexpr double kReachFactor = 4.0;
/// Steps against drag after which the structure is given up. Chosen, not tuned: jumps that were seen take 100
/// to 250 linear systems in all (docs/numerics.md).
constexpr int kMostDrags = 200;

/// Where a structure is followed, a search ends near its start or not at all.
QuasiStaticSettings settings_of(const StageTask& task, bool follows, QuasiStaticSettings settings) {
  if (task.before == nullptr) settings.descends_near = false;
  if (task.before == nullptr && !task.starts_near) settings.skips.kept_factors = false;
  // What is not found from near falls where joints are soft, and later stages stay near.
  const bool ends_near = task.before != nullptr || (task.starts_near && !settings.patient_first);
  if (ends_near || task.has_slipped()) settings.most_bold_iterations = 0;
  if (task.has_slipped() && !task.patient_phase)
    settings.most_patient_iterations = settings.most_slipped_iterations;
  if (!follows) return settings;
  settings.most_iterations = 0;
  settings.collapse_displacement = std::numeric_limits<double>::infinity();
  return settings;
}

double largest(const Field& field) {
  return without_nan(field).cwiseAbs().maxCoeff();
}

}  // namespace

StageSteps::StageSteps(const EquilibriumSystem& system, const Coefficients& nominal,
                       const QuasiStaticSettings& settings, const StageTask& task, TangentTarget tangent)
    : system_(system),
      nominal_(nominal),
      task_(task),
      tangent_(tangent),
      follows_(task.before != nullptr && nominal.mortar.empty()),
      settings_(settings_of(task, follows_, settings)),
      tolerance_(settings.tolerance),
      left_(task.steps) {
  if (task.parameters != nullptr) own_.emplace(system, *task.parameters);
  if (task.stage.joint_stiffness.size() > 0)
    own_ = with_joint_stiffness(own_ ? *std::move(own_) : nominal, task.stage.joint_stiffness);
  if (task.before != nullptr)
    static_cast<State&>(reached_) = *task.before;
  else
    reached_.displacement = Field::Zero(2, system.structure->mesh.node_count());
  if (task.before == nullptr && task.has_slipped()) reached_.memory = memory_of_slip(*task.slipped);
  sag_ = largest(reached_.displacement);
  if (task.start != nullptr || follows_) start_ = task.start != nullptr ? *task.start : reached_.displacement;
  begin_step(false);
}

/// What is held back when a jump begins stays so until it has ended.
void StageSteps::begin_step(bool has_matrix) {
  StageEquations equations(system_, coefficients(), task_.stage, reached_.memory);
  if (reach_ == 0.0 && left_ > 1)
    held_ = static_cast<double>(left_ - 1) / left_ *
            unbalanced_forces(equations, without_nan(reached_.displacement));
  if (left_ > 1) equations.load -= held_;
  if (reach_ > 0.0) equations.drag = Drag{reach_, admissible(equations, reached_.displacement)};
  settings_.tolerance = left_ > 1 || reach_ > 0.0 ? settings_.step_tolerance : tolerance_;
  largest_load_ = equations.largest_load;
  search_.emplace(std::move(equations), settings_, start_.size() > 0 ? &start_ : nullptr, tangent_,
                  task_.patient_phase, has_matrix);
}

bool StageSteps::advance(bool regular, const Eigen::VectorXd& step) {
  search_->advance(regular, step);
  // A load may bend a bridge further than its weight does, by as much as the first tangent says.
  if (loaded_sag_ == 0.0 && task_.stage.load.size() > 0) loaded_sag_ = left_ * search_->first_step();
  if (!search_->finished()) return false;
  Solution found = search_->solution();
  found.iterations += std::exchange(reached_.iterations, 0);
  if (!follows_) return accept(std::move(found));
  if (reach_ > 0.0) return follow_jump(std::move(found));
  if (stands(found) && is_near(found.displacement)) return accept(std::move(found));
  return task_.may_jump && sag_ > 0.0 ? begin_jump(found) : give_up(found);
}

/// True if the task is done with what the step has found. Otherwise the next step begins where the structure
/// gets if it goes on as in this one.
bool StageSteps::accept(Solution&& found) {
  const bool goes_on = stands(found) && left_ > 1;
  const bool is_first = left_ == task_.steps;
  const Field from = move_to(std::move(found), task_.keeps_steps && !is_first);
  if (!goes_on) return end();
  --left_;
  start_ = reached_.displacement;
  if (!is_first || task_.before != nullptr) start_ += reached_.displacement - from;
  begin_step(true);
  return false;
}

bool StageSteps::give_up(const Solution& found) {
  reached_.iterations = found.iterations;
  reached_.residual = found.residual;
  reached_.outcome = Outcome::unresolved;
  return end();
}

bool StageSteps::begin_jump(const Solution& found) {
  reached_.iterations = found.iterations;
  reach_ = kFirstReach * sag_;
  start_ = reached_.displacement;
  begin_step(false);
  return false;
}

/// Lets go of the drag more and more, until it holds nothing any more.
bool StageSteps::follow_jump(Solution&& found) {
  if (++drags_ > kMostDrags || (!stands(found) && reach_ < kLeastReach * sag_)) return give_up(found);
  if (!stands(found)) {
    reached_.iterations = found.iterations;
    reach_ /= kReachFactor * kReachFactor;
  } else {
    const Field from = move_to(std::move(found), false);
    const Field way = without_nan(reached_.displacement - from);
    const Eigen::RowVectorXd stiffness = coefficients().weight.transpose() / reach_;
    const double drag = (way * stiffness.asDiagonal()).cwiseAbs().maxCoeff();
    if (falls()) return end();
    reach_ *= kReachFactor;
    if (drag <= settings_.tolerance * largest_load_) {
      reach_ = 0.0;
      left_ = std::max(left_ - 1, 1);  // what drag still holds is let go in a last step
    }
  }
  start_ = reached_.displacement;
  begin_step(false);
  return false;
}

/// Gives where it was before.
Field StageSteps::move_to(Solution&& found, bool keeps_last) {
  std::vector<State> passed = std::move(reached_.steps);
  if (keeps_last) passed.push_back(static_cast<State&>(reached_));
  memory_before_ = std::move(reached_.memory);
  Field from = std::exchange(reached_, std::move(found)).displacement;
  reached_.steps = std::move(passed);
  return from;
}

bool StageSteps::is_near(const Field& found) const {
  const double expected = std::max(sag_ / task_.steps, kTangentSteps * search_->first_step());
  return largest(found - start_) <= expected;
}

/// Has something moved away? Then the task is done.
bool StageSteps::falls() {
  const Structure& structure = *system_.structure;
  const double far =
      std::min(kGoneSags * std::max(sag_, loaded_sag_), kGoneShare * mean_block_size(structure));
  reached_.moving =
      blocks_moved_beyond(far, structure.mesh, reached_.displacement - task_.before->displacement);
  if (reached_.moving.empty()) return false;
  reached_.outcome = Outcome::collapsed;
  reached_.extent = collapse_extent(structure.layout, reached_.moving);
  return true;
}

/// Completes the solution.
bool StageSteps::end() {
  search_.reset();
  if (!stands(reached_)) {
    reached_.memory.clear();
    reached_.steps.clear();
  } else if (drags_ > 0) {
    reached_.slipped = slip_of(memory_before_);
    reached_.steps.clear();
  } else if (task_.before == nullptr && task_.slipped != nullptr) {
    reached_.slipped = *task_.slipped;
  }
  return true;
}

}  // namespace voussoir
