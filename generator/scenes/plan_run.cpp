#include "generator/scenes/plan_run.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/structure/mirror_symmetry.h"
#include "generator/running/parallel.h"

namespace voussoir {
namespace {

using Tasks = std::span<SolvingTask>;

/// A thread's solver, of the variant that it worked on last: tasks are ordered by variant.
struct VariantSolver {
  std::int32_t variant = -1;
  StageSolver solver;
  std::optional<StateSolving> states;

  void prepare(std::int32_t wanted, const PlanRun& run) {
    if (variant == wanted) return;
    const Model& bridge = run.bridges[static_cast<std::size_t>(wanted)];
    solver = nullptr;  // the old one's memory goes before the new one's comes
    solver = run.solver.make_solver(bridge, run.settings);
    states.emplace(bridge, run.states);
    variant = wanted;
  }
};

/// Keeps the records that a task's solutions give.
void keep_records(const PlanRun& run, const SolvingTask& task, const SceneGroup& group, KnownRecords& known) {
  const Model& bridge = run.bridges[static_cast<std::size_t>(task.variant)];
  const auto keep = [&](const Scene& scene, const SceneStates& states) {
    std::vector<Solution> solutions;
    for (const std::optional<Solution>& state : states) solutions.push_back(state.value());
    const KeepField field = scene.missing() <= run.most_starting ? KeepField::yes : run.fields;
    known.journal().append(
        make_record({task.variant, scene}, solutions, bridge.control_points, field, run.fields));
    run.progress.advance(1);
  };
  if (task.records_solved) keep(task.solved, group.states);
  if (task.image) keep(*task.image, group.image_states);
}

/// Solves some tasks of one variant side by side and keeps their records.
void run_batch(const PlanRun& run, Tasks batch, const VariantSolver& solver, const SearchBasis& basis,
               KnownRecords& known) {
  std::vector<SceneGroup> groups;
  for (const SolvingTask& task : batch)
    groups.push_back(
        {task.solved, known.old_states({task.variant, task.solved}), task.records_solved, task.image});
  solver.states->solve(solver.solver, basis, groups);
  for (std::size_t i = 0; i < batch.size(); ++i) keep_records(run, batch[i], groups[i], known);
}

/// The fields that tasks start from, by variant. They come out of the records, whether these were made just
/// now or long ago.
std::map<std::int32_t, StartingFields> read_starts(const PlanRun& run, Tasks tasks,
                                                   const KnownRecords& known) {
  std::set<RecordKey> keys;
  for (const SolvingTask& task : tasks)
    for (const Scene& start : starting_scenes(task.solved, task.image, run.rules, run.states))
      keys.insert({task.variant, start});
  std::map<std::int32_t, StartingFields> starts;
  for (const SolvingTask& task : tasks) starts[task.variant];
  for (const RecordKey& key : keys) {
    const SceneStates states = known.states(key);
    for (std::size_t state = 0; state < states.size(); ++state)
      starts[key.variant].add(key.scene, state, states[state].value());
  }
  return starts;
}

/// Large enough to keep the solver's lanes busy, small enough to share a stage among the threads, and never
/// so large that much is lost when the program is killed.
std::size_t batch_size(std::size_t tasks, int threads) {
  constexpr std::size_t kBatchesPerThread = 4, kLargestBatch = 512;
  return std::clamp<std::size_t>(tasks / (kBatchesPerThread * static_cast<std::size_t>(threads)), 1,
                                 kLargestBatch);
}

/// The first tasks, all of one variant.
Tasks first_variant(Tasks tasks) {
  const auto other = std::ranges::find_if(
      tasks, [&](const SolvingTask& task) { return task.variant != tasks.front().variant; });
  return tasks.first(static_cast<std::size_t>(other - tasks.begin()));
}

/// The first tasks up to the end of a variant, enough of them to keep all threads busy: what they start from
/// is in memory together.
Tasks first_variants(Tasks tasks) {
  constexpr std::size_t kEnough = 1000;
  std::size_t size = 0;
  while (size < tasks.size() && size < kEnough) size += first_variant(tasks.subspan(size)).size();
  return tasks.first(size);
}

/// Batches of one variant each.
std::vector<Tasks> split_into_batches(Tasks tasks, std::size_t size) {
  std::vector<Tasks> batches;
  while (!tasks.empty()) {
    const Tasks variant = first_variant(tasks);
    batches.push_back(variant.first(std::min(size, variant.size())));
    tasks = tasks.subspan(batches.back().size());
  }
  return batches;
}

/// Those first that will be set in motion, so that they fill the lanes of a motion together, and as they take
/// the longest.
void put_motions_first(const std::map<std::int32_t, SearchBasis>& bases, Tasks tasks) {
  while (!tasks.empty()) {
    const Tasks variant = first_variant(tasks);
    const SearchBasis& basis = bases.at(variant.front().variant);
    std::stable_partition(variant.begin(), variant.end(), [&](const SolvingTask& task) {
      return basis.starts.falls_likely(task.solved, kBuilt) && !basis.falls.apply_to(task.solved);
    });
    tasks = tasks.subspan(variant.size());
  }
}

}  // namespace

void run_plan(BuildPlan plan, const PlanRun& run, KnownRecords& known) {
  Crew crew(run.threads);
  oneapi::tbb::enumerable_thread_specific<VariantSolver> solvers;
  for (auto& stage : plan.stages)
    for (Tasks left = stage; !left.empty();) {
      const Tasks tasks = first_variants(left);
      std::map<std::int32_t, SearchBasis> bases;
      for (auto& [variant, starts] : read_starts(run, tasks, known)) {
        VariantSolver& solver = solvers.local();
        solver.prepare(variant, run);
        bases[variant] = solver.states->basis(solver.solver, std::move(starts), run.rules);
      }
      put_motions_first(bases, tasks);
      const auto batches = split_into_batches(tasks, batch_size(tasks.size(), crew.size()));
      crew.for_each_index(batches.size(), [&](std::size_t i) {
        const std::int32_t variant = batches[i].front().variant;
        VariantSolver& solver = solvers.local();
        solver.prepare(variant, run);
        run_batch(run, batches[i], solver, bases.at(variant), known);
      });
      left = left.subspan(tasks.size());
    }
}

}  // namespace voussoir
