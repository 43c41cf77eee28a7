#pragma once
/// @file Scenes of a followed bridge set in motion, several side by side, until something decides what
/// becomes of each.

#include <algorithm>
#include <array>

#include "core/motion/followed_bridge.h"
#include "core/motion/motion_step.h"

namespace voussoir {

/// Takes one step; only the implicit one knows several lanes.
inline void take_step(Integrator integrator, const MotionModel& model, Motion<double>& motion) {
  if (integrator == Integrator::implicit_blocks)
    take_implicit_step(model, motion);
  else
    take_explicit_step(model, motion);
}

inline void take_step(Integrator, const MotionModel& model, Motion<DoubleLanes>& motion) {
  take_implicit_step(model, motion);
}

/// A scene under way in a lane.
struct LaneRun {
  std::size_t scene = 0;
  bool busy = false;
  long steps = 0;
  bool freer = false;  ///< damped less
  DynamicSolution solution;
};

/// Follows a list of scenes with as many lanes as T has.
template <class T>
class MotionRun {
 public:
  MotionRun(const FollowedBridge& shared, const DecisionRules& rules, std::span<const Scene> scenes,
            std::span<const MotionStart> starts)
      : shared_(shared),
        rules_(rules),
        model_(shared.model),
        scenes_(scenes),
        starts_(starts),
        solutions_(scenes.size()),
        motion_(at_rest<T>(model_)) {}

  std::vector<DynamicSolution> run() {
    go([&](int lane) { follow(lane); });
    return std::move(solutions_);
  }

  /// Where the scenes are after so many steps.
  std::vector<MotionSnapshot> snapshots_after(long steps) {
    std::vector<MotionSnapshot> snapshots(scenes_.size());
    go([&](int lane) {
      LaneRun& run = runs_[static_cast<std::size_t>(lane)];
      if (++run.steps < steps) return;
      snapshots[run.scene] = take_snapshot(motion_, lane);
      clear(lane);
    });
    return snapshots;
  }

 private:
  /// Steps until all scenes are done; follow_lane looks at a busy lane after each.
  template <class FollowLane>
  void go(const FollowLane& follow_lane) {
    for (int lane = 0; lane < kLaneCount<T>; ++lane) clear(lane);
    start_in_idle_lanes();
    while (any_busy()) {
      prepare_step();
      take_step(shared_.settings.integrator, model_, motion_);
      for (int lane = 0; lane < kLaneCount<T>; ++lane)
        if (runs_[lane].busy) follow_lane(lane);
      if (shared_.settings.skips.lane_refill || !any_busy()) start_in_idle_lanes();
    }
  }

  bool any_busy() const {
    return std::any_of(runs_.begin(), runs_.end(), [](const LaneRun& run) { return run.busy; });
  }

  void start_in_idle_lanes() {
    for (int lane = 0; lane < kLaneCount<T> && next_ < scenes_.size(); ++lane) {
      LaneRun& run = runs_[static_cast<std::size_t>(lane)];
      if (run.busy) continue;
      run = LaneRun{};
      run.busy = true;
      run.scene = next_++;
      const Scene& scene = scenes_[run.scene];
      const std::vector<bool> removed = removal_mask(scene, model_.bodies.size());
      if (starts_[run.scene] == MotionStart::from_singles) run.steps = shared_.early_steps();
      if (run.steps > 0)
        place_snapshot(model_, removed, shared_.early.of(scene), shared_.margin, lane, motion_);
      else
        place_scene(model_, removed, lane, motion_);
    }
  }

  /// An idle lane holds no blocks.
  void clear(int lane_index) {
    runs_[static_cast<std::size_t>(lane_index)].busy = false;
    place_scene(model_, std::vector<bool>(model_.bodies.size(), true), lane_index, motion_);
  }

  void prepare_step() {
    for (int i = 0; i < kLaneCount<T>; ++i) {
      const LaneRun& run = runs_[static_cast<std::size_t>(i)];
      set_lane(motion_.load, i,  // at the time of the places that forces are of
               grown_share(static_cast<double>(run.steps) * model_.step(), shared_.settings.ramp));
      set_lane(motion_.damping, i, (run.freer ? rules_.freer_damping : 1.0) * model_.damping);
      const bool settled = shared_.settings.skips.settled_contacts;
      if (!settled || lane(motion_.travel, i) > 0.5 * shared_.margin)
        search_contacts(model_, shared_.margin, i, motion_);
    }
  }

  void follow(int lane_index) {
    LaneRun& run = runs_[static_cast<std::size_t>(lane_index)];
    const DynamicSettings& settings = shared_.settings;
    ++run.steps;
    if (run.steps == shared_.steps_until(rules_.freer_from))
      run.freer = lane(motion_.unbalanced, lane_index) <= rules_.freer_unbalance * model_.weight;
    if (run.steps == shared_.steps_until(rules_.freer_until)) run.freer = false;
    const double time = static_cast<double>(run.steps) * model_.step();
    if (run.steps == shared_.steps_until(settings.moment)) {
      run.solution.solution.displacement = displacement(model_, motion_, lane_index);
      run.solution.time = time;
    }
    const long between = std::max(1L, shared_.steps_until(kTimeBetweenLooks));
    if (run.steps % between != 0 || run.steps < shared_.steps_until(settings.moment)) return;
    if (!decided(lane_index, run.steps, run.solution)) return;
    run.solution.solution.iterations = static_cast<int>(run.steps);
    solutions_[run.scene] = std::move(run.solution);
    clear(lane_index);
  }

  /// Fills in the outcome, if there is one by now.
  bool decided(int i, long steps, DynamicSolution& result) const {
    const double unbalanced = lane(motion_.unbalanced, i) / model_.weight;
    result.kinetic_energy = kinetic_energy(model_, motion_, i);
    const double largest = lane(motion_.largest_unbalanced, i);
    const bool early = steps < shared_.steps_until(rules_.earliest_decision);
    if (early && !shared_.settings.skips.early_outcome) return false;
    const bool quiet = !early && unbalanced <= rules_.standing_unbalance &&
                       result.kinetic_energy <= unbalanced * shared_.natural.work &&
                       largest <= rules_.largest_standing_unbalance;
    const Field now = displacement(model_, motion_, i);
    result.solution.moving = blocks_moved_beyond(shared_.moved_away(rules_), model_.structure->mesh, now);
    result.solution.extent = collapse_extent(model_.structure->layout, result.solution.moving);
    const bool plain = early ? unbalanced >= rules_.plain_unbalance : largest >= rules_.collapsing_unbalance;
    const bool falling = !quiet && !result.solution.moving.empty() && plain;
    if (!quiet && !falling && steps < shared_.steps_until(rules_.latest_decision)) return false;
    result.solution.residual = unbalanced;
    result.solution.outcome = quiet ? Outcome::standing : falling ? Outcome::collapsed : Outcome::unresolved;
    if (falling) return true;
    result.solution.displacement = now;
    result.solution.slipped = plastic_slip(model_, motion_, i);
    result.time = static_cast<double>(steps) * model_.step();
    return true;
  }

  const FollowedBridge& shared_;
  const DecisionRules& rules_;
  const MotionModel& model_;
  std::span<const Scene> scenes_;
  std::span<const MotionStart> starts_;
  std::vector<DynamicSolution> solutions_;
  Motion<T> motion_;
  std::array<LaneRun, kLaneCount<T>> runs_;
  std::size_t next_ = 0;
};

/// What work(run) gives for a run of the scenes, side by side if there are several.
template <class Work>
auto on_lanes(const FollowedBridge& shared, const DecisionRules& rules, std::span<const Scene> scenes,
              std::span<const MotionStart> starts, const Work& work) {
  const bool several = shared.settings.side_by_side > 1 && scenes.size() > 1 &&
                       shared.settings.integrator == Integrator::implicit_blocks;
  return several ? work(MotionRun<DoubleLanes>(shared, rules, scenes, starts))
                 : work(MotionRun<double>(shared, rules, scenes, starts));
}

}  // namespace voussoir
