#include "generator/plan_run.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/structure/mirror_symmetry.h"
#include "generator/parallel.h"
#include "generator/reused_records.h"
#include "generator/start_field.h"

namespace voussoir {
namespace {

using Tasks = std::span<const SolvingTask>;

/// A thread's solver, of the variant that it worked on last: tasks are ordered by variant.
struct VariantSolver {
  std::int32_t variant = -1;
  SceneSolver solver;

  const SceneSolver& of(std::int32_t wanted, const PlanRun& run) {
    if (variant != wanted) {
      solver = nullptr;  // the old one's memory goes before the new one's comes
      solver = run.solver.make_solver(run.bridges[static_cast<std::size_t>(wanted)], run.settings);
    }
    variant = wanted;
    return solver;
  }
};

/// Keeps the records that a task's solution gives.
void keep_records(const PlanRun& run, const SolvingTask& task, const Solution& solution,
                  KnownRecords& known) {
  const Model& bridge = run.bridges[static_cast<std::size_t>(task.variant)];
  const auto keep = [&](const Scene& scene, const Solution& answer) {
    const KeepField field = starts_others(scene) ? KeepField::yes : run.fields;
    known.journal().append(
        make_record({task.variant, scene}, std::span(&answer, 1), bridge.control_points, field, run.fields));
    run.progress.advance(1);
  };
  if (task.records_solved) keep(task.solved, solution);
  if (task.image) keep(*task.image, mirrored_solution(solution, *bridge.symmetry));
}

/// Solves some tasks of one variant side by side and keeps their records.
void run_batch(const PlanRun& run, Tasks batch, const SceneSolver& solver, const StartingFields& starts,
               KnownRecords& known) {
  std::vector<std::optional<Field>> fields;
  for (const SolvingTask& task : batch) fields.push_back(starts.start_for(task.solved));
  std::vector<StageTask> scenes;
  for (std::size_t i = 0; i < batch.size(); ++i)
    scenes.push_back({.stage = {.scene = batch[i].solved}, .start = fields[i] ? &*fields[i] : nullptr});
  const std::vector<Solution> solutions = solve_for_storage(solver, scenes);
  for (std::size_t i = 0; i < batch.size(); ++i) keep_records(run, batch[i], solutions[i], known);
}

/// The fields that tasks start from, by variant. They come out of the records, whether these were made just
/// now or long ago.
std::map<std::int32_t, StartingFields> read_starts(const PlanRun& run, Tasks tasks,
                                                   const KnownRecords& known) {
  std::set<RecordKey> keys;
  for (const SolvingTask& task : tasks)
    for (const Scene& start : starting_scenes(task.solved, run.rules)) keys.insert({task.variant, start});
  std::map<std::int32_t, StartingFields> starts;
  for (const SolvingTask& task : tasks) starts[task.variant];
  for (const RecordKey& key : keys) {
    const Solution solution = known.read_solution(key, run.bridges.front().mesh.node_count());
    starts[key.variant].add(key.scene, solution.outcome, solution.displacement);
  }
  return starts;
}

/// Large enough to keep the solver's lanes busy, small enough to share a stage among the threads, and never
/// so large that much is lost when the program is killed.
std::size_t batch_size(std::size_t tasks, int threads) {
  constexpr std::size_t kBatchesPerThread = 4;
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

}  // namespace

void run_plan(const BuildPlan& plan, const PlanRun& run, KnownRecords& known) {
  Crew crew(run.threads);
  oneapi::tbb::enumerable_thread_specific<VariantSolver> solvers;
  for (const auto& stage : plan.stages)
    for (Tasks left = stage; !left.empty();) {
      const Tasks tasks = first_variants(left);
      const auto starts = read_starts(run, tasks, known);
      const auto batches = split_into_batches(tasks, batch_size(tasks.size(), crew.size()));
      crew.for_each_index(batches.size(), [&](std::size_t i) {
        const std::int32_t variant = batches[i].front().variant;
        run_batch(run, batches[i], solvers.local().of(variant, run), starts.at(variant), known);
      });
      left = left.subspan(tasks.size());
    }
}

}  // namespace voussoir
