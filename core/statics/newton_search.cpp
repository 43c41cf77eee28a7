#include "core/statics/newton_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/statics/elements.h"

namespace voussoir {
namespace {

constexpr double kLeastBonding = 1e-3;   ///< of the joints' stiffness: first help for loose blocks
constexpr double kBondingFactor = 10.0;  ///< more help for a step out of bounds, less after a step
/// Of a step. Chosen, not tuned: a search that stalls takes all of them in vain (docs/speed.md).
constexpr int kMostHalvings = 4;
/// Of a step along which the unbalance does not fall however short it is: what joints do at their kinks stops
/// a descent at places that are no equilibria, and from beside them it goes on. Of fourteen scenes it
/// finds ten, and eight without (docs/speed.md). How long it is is chosen, not tuned.
constexpr double kEscape = 0.25;
/// A scene falls that moves further than this many times the sag of the bonded one and the way of its start.
constexpr double kFallingSags = 10.0;
/// Of the unbalance at most so much may be left after a step if its matrix is to serve the next one, too; a
/// new matrix costs as much as four steps with an old one (docs/numerics.md).
constexpr double kLittleProgress = 0.3;
constexpr std::size_t kMostSecants = 9;
/// A search is given up after so many steps at the earliest if it makes no progress. With kProgress and
/// PhaseRules::most_stalled no outcome of the reference bridge differs from that without a limit, and of 209
/// singles of 32 stiff bridges that stand 11 are left to later searches (docs/speed.md).
constexpr int kFewestSteps = 8;
/// Progress is an unbalance that falls to this share of what it was at the last; measured with kFewestSteps.
constexpr double kProgress = 0.9;
/// Of the way of the block that has fallen: what has moved further moves away, too. Chosen, not tuned.
constexpr double kMovingShare = 0.1;

}  // namespace

NewtonSearch::NewtonSearch(StageEquations equations, const QuasiStaticSettings& settings, const Field* start,
                           TangentTarget tangent, bool patient_phase, bool has_matrix)
    : equations_(std::move(equations)),
      settings_(&settings),
      tangent_(tangent),
      displacement_(Field::Zero(2, system().structure->mesh.node_count())) {
  matrix_is_new_ = !has_matrix;
  const SearchPhase first = patient_phase            ? SearchPhase::patient
                            : settings.patient_first ? SearchPhase::descending
                            : start != nullptr       ? SearchPhase::warm
                                                     : SearchPhase::quick;
  begin(first, start != nullptr ? *start : at_rest(), start != nullptr ? 0.0 : 1.0);
  start_sag_ = largest_displacement();
}

void NewtonSearch::begin(SearchPhase phase, const Field& start, double bonding) {
  phase_ = phase;
  displacement_ = admissible(equations_, start);
  bonding_ = bonding;
  recent_.fill(std::numeric_limits<double>::infinity());
  steps_ = 0;
  first_step_ = 0.0;
  phase_iterations_ = 0;
  least_norm_ = std::numeric_limits<double>::infinity();
  stalled_ = 0;
  if (matrix_is_new_ || !may_keep_matrix())
    evaluate();
  else
    evaluate_forces();
}

void NewtonSearch::begin_from_rest(SearchPhase phase) {
  if (most_iterations(phase, *settings_) > 0)
    begin(phase, at_rest(), 1.0);
  else
    phase_ = SearchPhase::done;
}

void NewtonSearch::begin_next_phase() {
  switch (phase_) {
    case SearchPhase::warm:
      if (settings_->descends_near && !fallen())
        begin(SearchPhase::descending, displacement_, 0.0);
      else
        begin_from_rest(SearchPhase::quick);
      break;
    case SearchPhase::quick:
      go_on_boldly(settings_->follow_falls ? SearchPhase::falling : SearchPhase::bold);
      break;
    case SearchPhase::falling:
      begin_from_rest(SearchPhase::patient);
      break;
    case SearchPhase::descending:
      if (settings_->patient_first)
        go_on_boldly(SearchPhase::bold);
      else
        begin_from_rest(SearchPhase::quick);
      break;
    case SearchPhase::bold:
      displacement_ = before_bold_;
      evaluate_forces();
      [[fallthrough]];
    case SearchPhase::patient:
    case SearchPhase::done:
      phase_ = SearchPhase::done;
  }
}

void NewtonSearch::go_on_boldly(SearchPhase phase) {
  phase_ = most_iterations(phase, *settings_) > 0 ? phase : SearchPhase::done;
  phase_iterations_ = 0;
  before_bold_ = displacement_;
}

void NewtonSearch::evaluate() {
  unbalanced_ = assemble(equations_, displacement_, bonding_, tangent_,
                         may_keep_matrix() ? ElasticPart::at_rest : ElasticPart::exact);
  matrix_is_new_ = true;
  secants_.clear();
  note_norm();
}

void NewtonSearch::evaluate_forces() {
  unbalanced_ = unbalanced_forces(equations_, displacement_);
  note_norm();
}

void NewtonSearch::note_norm() {
  norm_ = (unbalanced_ / equations_.largest_load).norm();  // squares of tiny loads would vanish
}

/// Near the answer only. Mortar softens, which an old matrix knows nothing of; a bonded one is far from the
/// tangent.
bool NewtonSearch::may_keep_matrix() const {
  return settings_->skips.kept_factors && phase_ == SearchPhase::warm && bonding_ == 0.0 &&
         equations_.coefficients->mortar.empty();
}

void NewtonSearch::advance(bool regular, const Eigen::VectorXd& solution) {
  ++iterations_;
  if (!std::exchange(matrix_is_new_, false)) {
    try_step_with_old_matrix(secants_.step(solution));
  } else if (++phase_iterations_; within_bounds(regular, solution)) {
    take_step(solution);
  } else if (bonding_ < 1.0) {
    bonding_ = std::clamp(bonding_ * kBondingFactor, kLeastBonding, 1.0);
    evaluate();
    if (exhausted()) begin_next_phase();
    return;
  } else {
    begin_next_phase();  // singular even with all joints bonded
    return;
  }
  note_progress();
  const bool goes_on = phase_ == SearchPhase::warm || phase_ == SearchPhase::bold;
  if (in_equilibrium() || (fallen() && !goes_on))
    phase_ = SearchPhase::done;
  else if (exhausted())
    begin_next_phase();
}

bool NewtonSearch::within_bounds(bool regular, const Eigen::VectorXd& step) const {
  if (!regular || !step.allFinite()) return false;
  const double so_far = largest_displacement();
  return bonding_ >= 1.0 || so_far == 0.0 ||
         step.cwiseAbs().maxCoeff() <= rules_of(phase_).largest_step * so_far;
}

void NewtonSearch::move(const Field& from, double factor, const Eigen::VectorXd& step) {
  displacement_ = from;
  for (int i = 0; i < system().unknown_count(); ++i)
    displacement_.data()[system().component[static_cast<std::size_t>(i)]] += factor * step[i];
}

void NewtonSearch::note_step(double length) {
  last_step_ = length;
  if (first_step_ == 0.0) first_step_ = length;
  std::rotate(recent_.begin(), recent_.begin() + 1, recent_.end());
  recent_.back() = norm_;
}

void NewtonSearch::note_progress() {
  const double now = norm_;
  const bool progresses = now < kProgress * least_norm_;
  if (progresses) least_norm_ = now;
  stalled_ = progresses ? 0 : stalled_ + 1;
}

/// Halves the step while the unbalance rises too far. Where it rises however short the step is, a descent
/// tries again with joints bonded a little; where that fails, too, it leaves the kink by a short step.
void NewtonSearch::take_step(const Eigen::VectorXd& step) {
  const PhaseRules& rules = rules_of(phase_);
  const double norm_before = norm_;
  const bool descends = rules.descends && steps_ > 0;
  const double bound =
      descends ? norm_before : rules.rise * *std::max_element(recent_.begin(), recent_.end());
  const double bonding_before = bonding_;
  const Field before = displacement_;
  const bool may_keep = may_keep_matrix();
  const bool bonded_from_rest = steps_ == 0 && bonding_ >= 1.0;
  bonding_ = bonding_ > kLeastBonding ? bonding_ / kBondingFactor : 0.0;
  double factor = 1.0;
  for (int halving = 0; halving <= kMostHalvings; ++halving, factor *= 0.5) {
    move(before, factor, step);
    may_keep || halving > 0 ? evaluate_forces() : evaluate();  // a tangent costs as much as five tries
    if (norm_ < bound) break;
  }
  if (descends && !(norm_ < bound)) {
    const bool may_bond = bonding_before == 0.0;
    if (may_bond) bonding_ = kLeastBonding;
    factor = may_bond ? 0.0 : kEscape;
    move(before, factor, step);
    evaluate();
    if (may_bond) return;
  } else if (factor < 1.0 && !may_keep) {
    evaluate();
  }
  note_step(factor * step.cwiseAbs().maxCoeff());
  if (bonded_from_rest) bonded_sag_ = last_step_;
  if (steps_++ == 0) first_norm_ = recent_.back();
  if (!may_keep || in_equilibrium()) return;
  if (factor == 1.0 && norm_ <= kLittleProgress * norm_before)
    secants_.add(step);
  else
    evaluate();
}

/// Takes the step if it leaves less unbalance than there is.
void NewtonSearch::try_step_with_old_matrix(const Eigen::VectorXd& step) {
  const double norm_before = norm_;
  const Field before = displacement_;
  const bool within = within_bounds(true, step);
  if (within) {
    move(before, 1.0, step);
    evaluate_forces();
  }
  if (!within || !(norm_ < norm_before)) {
    displacement_ = before;
    evaluate();
    return;
  }
  note_step(step.cwiseAbs().maxCoeff());
  if (in_equilibrium()) return;
  if (norm_ <= kLittleProgress * norm_before && secants_.size() < kMostSecants)
    secants_.add(step);
  else
    evaluate();
}

bool NewtonSearch::exhausted() const {
  const PhaseRules& rules = rules_of(phase_);
  const bool unpromising = steps_ >= rules.given_up_after && recent_.back() > rules.promising * first_norm_;
  const bool stalls = phase_iterations_ >= kFewestSteps && stalled_ >= rules.most_stalled;
  return (settings_->skips.early_outcome && (unpromising || stalls)) || fallen() ||
         phase_iterations_ >= most_iterations(phase_, *settings_);
}

double NewtonSearch::residual() const {
  return unbalanced_.cwiseAbs().maxCoeff() / equations_.largest_load;
}

bool NewtonSearch::in_equilibrium() const {
  const double r = residual();
  const bool at_round_off =
      steps_ > 0 && bonding_ == 0.0 && last_step_ <= settings_->round_off * largest_displacement();
  return r <= settings_->tolerance || (at_round_off && r <= settings_->loose_tolerance);
}

/// Soft joints let a standing bridge move further than the setting says; not further than many bonded sags.
double NewtonSearch::falling_displacement() const {
  return std::max(settings_->collapse_displacement, kFallingSags * std::max(bonded_sag_, start_sag_));
}

bool NewtonSearch::fallen() const {
  return !(largest_displacement() <= falling_displacement());  // not a number, too
}

Solution NewtonSearch::solution() const {
  Solution solution;
  solution.displacement = displacement_;
  solution.residual = residual();
  solution.iterations = iterations_;
  if (fallen()) {
    const Structure& structure = *system().structure;
    solution.outcome = Outcome::collapsed;
    solution.moving =
        blocks_moved_beyond(kMovingShare * falling_displacement(), structure.mesh, displacement_);
    solution.extent = collapse_extent(structure.layout, solution.moving);
  } else if (in_equilibrium()) {
    solution.outcome = Outcome::standing;
    solution.memory = updated_memory(equations_, displacement_);
  }
  fill_removed(equations_, std::numeric_limits<double>::quiet_NaN(), solution.displacement);
  return solution;
}

}  // namespace voussoir
