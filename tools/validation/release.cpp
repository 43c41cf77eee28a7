#include "tools/validation/release.h"

#include <limits>

#include "core/motion/motion_kernels.h"
#include "core/motion/motion_step.h"
#include "core/statics/equilibrium.h"

namespace voussoir::validation {
namespace {

using Forces = std::vector<Pair<double>>;

/// Forces of the joints with these blocks on the nodes of all others [N].
Forces forces_of_blocks(const MotionModel& model, const std::vector<bool>& removed, Motion<double> motion) {
  const Mesh& mesh = model.structure->mesh;
  std::vector<bool> gone(motion.places.size(), false);
  for (std::size_t b = 0; b < removed.size(); ++b)
    for (int i = mesh.block_nodes[b].begin; i < mesh.block_nodes[b].end; ++i)
      gone[static_cast<std::size_t>(i)] = removed[b];
  const auto is_gone = [&](int node) { return gone[static_cast<std::size_t>(node)]; };
  for (std::size_t c = 0; c < motion.contacts.size(); ++c)
    if (is_gone(motion.contacts[c].nodes[0]) == is_gone(motion.contacts[c].nodes[2]))
      motion.found[c].value = 0.0;
  for (EdgeContact& contact : motion.contacts) contact.quick = {};  // all at this moment
  for (std::size_t k = 0; k < model.bonds.size(); ++k)
    if (removed[model.bonds[k].blocks[0]] == removed[model.bonds[k].blocks[1]])
      motion.bonds[0][k].holds = false;
  follow_bonds(model, motion);
  start_forces(model, view_of(motion));
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (gone[i]) motion.forces[i] = {0.0, 0.0};
  return motion.forces;
}

/// Takes blocks out of a bridge in motion; the others go on as they are.
void remove_blocks(const MotionModel& model, const std::vector<bool>& removed, Motion<double>& motion) {
  for (std::size_t b = 0; b < removed.size(); ++b) {
    if (!removed[b]) continue;
    motion.present[b].value = 0.0;
    motion.frames[b].velocity = {0.0, 0.0};
    motion.frames[b].spin = 0.0;
    for (int i = model.bodies[b].nodes.begin; i < model.bodies[b].nodes.end; ++i)
      motion.rates[static_cast<std::size_t>(i)] = motion.moved[static_cast<std::size_t>(i)] = {0.0, 0.0};
  }
  motion.travel = std::numeric_limits<double>::infinity();
}

}  // namespace

struct LoadedBridge::Workspace {
  Workspace(const Model& bridge, const LoadingSettings& settings_, const DynamicSolver& solver)
      : settings(settings_),
        model(bridge, make_block_bodies(bridge, settings.motion.inertia), solver.pace(), solver.damping(),
              settings.motion.contact_damping),
        margin(search_margin(bridge)),
        far(solver.moved_away(settings.motion.decision)),
        motion(at_rest<double>(model)) {}

  /// Steps until the bridge rests, not before `earliest` [s]. `prepare` sets the loads of a step that ends at
  /// a time.
  template <class Prepare>
  DynamicSolution follow(const MotionModel& with, double earliest, Motion<double>& moving,
                         const Prepare& prepare) const {
    DynamicSolution result;
    double restless = 0.0;  // the last time at which it did not rest
    long steps = 0;
    while (result.time < settings.longest &&
           result.time < std::max(earliest, restless) + settings.rest_time) {
      result.time = static_cast<double>(++steps) * with.step();
      prepare(result.time);
      if (moving.travel > 0.5 * margin) search_contacts(with, margin, 0, moving);
      take_implicit_step(with, moving);
      result.solution.residual = moving.unbalanced / with.weight;
      if (!(result.solution.residual <= settings.rest)) restless = result.time;
    }
    Solution& solution = result.solution;
    solution.displacement = displacement(with, moving, 0);
    solution.iterations = static_cast<int>(steps);
    solution.moving = blocks_moved_beyond(far, with.structure->mesh, solution.displacement);
    solution.extent = collapse_extent(with.structure->layout, solution.moving);
    const bool rests =
        result.time - restless >= settings.rest_time || solution.residual <= settings.trembling;
    solution.outcome = rests                     ? Outcome::standing
                       : solution.moving.empty() ? Outcome::unresolved
                                                 : Outcome::collapsed;
    result.kinetic_energy = kinetic_energy(with, moving, 0);
    return result;
  }

  LoadingSettings settings;
  MotionModel model;
  double margin;
  double far;  ///< blocks that moved further have moved away [m]
  Motion<double> motion;
  DynamicSolution intact;
};

LoadedBridge::LoadedBridge(const Model& model, const LoadingSettings& settings)
    : workspace_(std::make_unique<Workspace>(model, settings, DynamicSolver(model, settings.motion))) {
  Workspace& w = *workspace_;
  const double ramp = settings.ramp;
  w.intact = w.follow(w.model, ramp, w.motion, [&](double time) { w.motion.load = grown_share(time, ramp); });
}
LoadedBridge::~LoadedBridge() = default;
LoadedBridge::LoadedBridge(LoadedBridge&&) noexcept = default;
LoadedBridge& LoadedBridge::operator=(LoadedBridge&&) noexcept = default;

const DynamicSolution& LoadedBridge::intact() const {
  return workspace_->intact;
}

DynamicSolution LoadedBridge::without(const Scene& scene, const Release& release) const {
  const Workspace& w = *workspace_;
  const MotionModel& model = w.model;
  Motion<double> motion = w.motion;
  motion.damping *= release.damping;
  const std::vector<bool> removed = removal_mask(scene, model.bodies.size());
  const Forces carried = forces_of_blocks(model, removed, motion);
  remove_blocks(model, removed, motion);
  return w.follow(model, release.duration, motion, [&](double time) {
    const double left = 1.0 - grown_share(time, release.duration);
    motion.pushes = carried;
    for (Pair<double>& push : motion.pushes) push = push * left;
  });
}

}  // namespace voussoir::validation
