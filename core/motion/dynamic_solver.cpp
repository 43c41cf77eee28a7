#include "core/motion/dynamic_solver.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/motion/early_motion.h"
#include "core/motion/motion_step.h"
#include "core/motion/softening.h"

namespace voussoir {
namespace {

constexpr double kOfCritical = 0.9;         ///< default step; the power iteration comes from below
constexpr double kDampingShare = 0.5;       ///< of the critical damping
constexpr double kTimeBetweenLooks = 0.01;  ///< [s] between two looks at a scene
/// Of the ramp, for which motions add up: a quarter of gravity acts then. Until half of it, fields of
/// collapses would be three times as far off (docs/numerics.md).
constexpr double kEarlyShare = 1.0 / 3.0;
constexpr std::size_t kMostEarlyMemory = std::size_t{1} << 26U;  ///< [bytes] a solver

/// A shorter step, if need be, of which a whole number lies between two looks.
double step_between_looks(double step) {
  return step < kTimeBetweenLooks ? kTimeBetweenLooks / std::ceil(kTimeBetweenLooks / step) : step;
}

Pace acting_pace(const Model& model, const std::vector<BlockBody>& bodies, const DynamicSettings& settings,
                 double critical) {
  if (settings.step) {
    if (!(*settings.step > 0.0) || *settings.step > critical)
      throw InputError(
          fmt::format("a time step of {} s is not stable: the joints' stiffness against the blocks' masses "
                      "allows steps up to {:.3g} s",
                      *settings.step, critical));
    return {.step = *settings.step};
  }
  Pace pace{.step = kOfCritical * critical};
  if (settings.integrator == Integrator::implicit_blocks)
    pace = best_pace(model, bodies, settings.contact_damping, critical, kOfCritical, settings.most_parts);
  pace.step = step_between_looks(pace.step);
  return pace;
}

/// For each block the share of its joints' stiffness that steps of the settings can follow; empty if all can
/// be followed as they are.
std::vector<double> softened_shares(const Model& bridge, const std::vector<BlockBody>& bodies,
                                    const DynamicSettings& settings) {
  if (settings.integrator != Integrator::implicit_blocks || settings.least_step == 0.0) return {};
  std::vector<double> shares = softening(bridge, bodies, settings.contact_damping, settings.least_step);
  const bool as_it_is = std::ranges::all_of(shares, [](double share) { return share == 1.0; });
  return as_it_is ? std::vector<double>{} : shares;
}

/// The bridge with such joints; nothing if its own are.
std::unique_ptr<Model> softened_bridge(const Model& bridge, const std::vector<BlockBody>& bodies,
                                       const DynamicSettings& settings) {
  const std::vector<double> shares = softened_shares(bridge, bodies, settings);
  return shares.empty() ? nullptr : std::make_unique<Model>(softened(bridge, shares));
}

}  // namespace

struct DynamicSolver::Workspace {
  Workspace(const Model& bridge, const EquilibriumSystem& system, const DynamicSettings& settings_)
      : Workspace(bridge, make_block_bodies(bridge, settings_.inertia), system, settings_) {}

  Workspace(const Model& bridge, const std::vector<BlockBody>& bodies, const EquilibriumSystem& system,
            const DynamicSettings& settings_)
      : settings(settings_),
        softer(softened_bridge(bridge, bodies, settings)),
        natural(natural_motion(followed(bridge), system)),
        critical(
            voussoir::critical_step(followed(bridge), bodies, settings.integrator, settings.contact_damping)),
        model(followed(bridge), bodies, acting_pace(followed(bridge), bodies, settings, critical),
              settings.damping.value_or(2.0 * kDampingShare * natural.frequency), settings.contact_damping),
        margin(search_margin(bridge)),
        block_size(mean_block_size(bridge)) {}

  const Model& followed(const Model& bridge) const { return softer ? *softer : bridge; }
  /// Steps until a time has come, but for round-off.
  long steps_until(double time) const { return std::lround(std::ceil(time / model.step() - 1e-6)); }

  /// After so many steps a scene is followed on its own, if it starts from its singles. 0: none does, as
  /// bonds remember more than a snapshot has, or there are too many snapshots.
  long early_steps() const {
    const bool adds_up = settings.skips.early_motions && model.bonds.empty() &&
                         settings.integrator == Integrator::implicit_blocks &&
                         memory_of_early_motions(model) <= kMostEarlyMemory;
    return adds_up ? static_cast<long>(kEarlyShare * settings.ramp / model.step()) : 0;
  }

  /// From so far on blocks have moved away [m].
  double moved_away(const DecisionRules& rules) const {
    return std::min(rules.moving_sags * natural.sag, kGoneShare * block_size);
  }

  DynamicSettings settings;
  std::unique_ptr<Model> softer;  ///< what is followed if it is not the bridge
  NaturalMotion natural;
  double critical;
  MotionModel model;
  double margin;
  double block_size;  ///< [m]
  EarlyMotions early;
};

namespace {

/// Takes one step; only the implicit one knows several lanes.
void take_step(Integrator integrator, const MotionModel& model, Motion<double>& motion) {
  if (integrator == Integrator::implicit_blocks)
    take_implicit_step(model, motion);
  else
    take_explicit_step(model, motion);
}

void take_step(Integrator, const MotionModel& model, Motion<DoubleLanes>& motion) {
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
template <class T, class Shared>
class MotionRun {
 public:
  MotionRun(const Shared& shared, const DecisionRules& rules, std::span<const Scene> scenes,
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

  const Shared& shared_;
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
template <class Shared, class Work>
auto on_lanes(const Shared& shared, const DecisionRules& rules, std::span<const Scene> scenes,
              std::span<const MotionStart> starts, const Work& work) {
  const bool several = shared.settings.side_by_side > 1 && scenes.size() > 1 &&
                       shared.settings.integrator == Integrator::implicit_blocks;
  return several ? work(MotionRun<DoubleLanes, Shared>(shared, rules, scenes, starts))
                 : work(MotionRun<double, Shared>(shared, rules, scenes, starts));
}

}  // namespace

DynamicSettings acting_settings(DynamicSettings settings, const Model& model) {
  if (!has_mortar(model.parameters)) return settings;
  settings.most_parts = 1;
  settings.least_step = 0.0;
  return settings;
}

bool softens_joints(const DynamicSettings& settings, const Model& model) {
  const DynamicSettings acting = acting_settings(settings, model);
  return !softened_shares(model, make_block_bodies(model, acting.inertia), acting).empty();
}

DynamicSolver::DynamicSolver(const Model& model, DynamicSettings settings)
    : DynamicSolver(model, EquilibriumSystem(model), settings) {}

DynamicSolver::DynamicSolver(const Model& model, const EquilibriumSystem& system, DynamicSettings settings)
    : workspace_(std::make_unique<Workspace>(model, system, acting_settings(settings, model))) {}
DynamicSolver::~DynamicSolver() = default;
DynamicSolver::DynamicSolver(DynamicSolver&&) noexcept = default;
DynamicSolver& DynamicSolver::operator=(DynamicSolver&&) noexcept = default;

std::vector<DynamicSolution> DynamicSolver::solve(std::span<const Scene> scenes, const DecisionRules& rules,
                                                  std::span<const MotionStart> starts) {
  Workspace& shared = *workspace_;
  const std::vector<MotionStart> all_at_rest(starts.empty() ? scenes.size() : 0, MotionStart::at_rest);
  if (starts.empty()) starts = all_at_rest;
  const long early_steps = shared.early_steps();
  std::vector<Scene> early;
  for (std::size_t i = 0; i < scenes.size() && early_steps > 0; ++i)
    if (starts[i] == MotionStart::from_singles) early.push_back(scenes[i]);
  if (const std::vector<Scene> lacking = shared.early.lacking(early); !lacking.empty()) {
    const std::vector<MotionStart> at_rest(lacking.size(), MotionStart::at_rest);
    shared.early.add(lacking, on_lanes(shared, rules, lacking, at_rest,
                                       [&](auto&& run) { return run.snapshots_after(early_steps); }));
  }
  return on_lanes(shared, rules, scenes, starts, [](auto&& run) { return run.run(); });
}

std::vector<DynamicSolution> DynamicSolver::solve(std::span<const Scene> scenes) {
  return solve(scenes, workspace_->settings.decision);
}

DynamicSolution DynamicSolver::solve(const Scene& scene) {
  return std::move(solve(std::span(&scene, 1)).front());
}

const Pace& DynamicSolver::pace() const {
  return workspace_->model.pace;
}
double DynamicSolver::step() const {
  return pace().step;
}
double DynamicSolver::critical_step() const {
  return workspace_->critical;
}
double DynamicSolver::frequency() const {
  return workspace_->natural.frequency;
}
double DynamicSolver::damping() const {
  return workspace_->model.damping;
}
double DynamicSolver::sag() const {
  return workspace_->natural.sag;
}

}  // namespace voussoir
