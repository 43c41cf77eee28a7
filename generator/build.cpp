#include "generator/build.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "core/error.h"
#include "database/records/writer.h"
#include "database/records/xdmf.h"
#include "generator/build_settings.h"
#include "generator/existing_database.h"
#include "generator/known_records.h"
#include "generator/parallel.h"
#include "generator/results_key.h"
#include "generator/scene_list.h"
#include "generator/start_field.h"

namespace voussoir {
namespace {

/// What all steps of one build share.
struct Build {
  const BuildRequest& request;
  const SolverChoice& solver;
  Progress& progress;
  Model bridge;
  std::vector<Scene> wanted;
  Provenance provenance;
};

Provenance provenance_of(const BuildRequest& request, const SolverChoice& solver, const Model& bridge) {
  const std::string settings = build_settings(solver, bridge, request.rules);
  return make_provenance(request.bridge, settings, results_key(request.bridge.description, settings));
}

Build prepare(const BuildRequest& request, const SolverChoice& solver, Progress& progress) {
  Model bridge = make_model(request.bridge.description);
  auto wanted = parse_scene_list(request.scenes, bridge.layout);
  Provenance provenance = provenance_of(request, solver, bridge);
  return {request, solver, progress, std::move(bridge), std::move(wanted), std::move(provenance)};
}

/// Records fit into the same journal if results, control points and the choice of fields are the same.
std::string journal_key(const Build& build) {
  std::string key = build.provenance.results_key;
  for (const ControlPoint& point : build.bridge.control_points) key += fmt::format(" {}", value(point.node));
  return key + (build.request.fields == KeepField::yes ? " with fields" : " without fields");
}

KnownRecords open_records(const Build& build) {
  KnownRecords known(Journal::open(build.request.output, build.provenance, journal_key(build)), build.bridge,
                     build.request.fields);
  if (const auto& discarded = known.journal().discarded()) {
    const auto changes = differences(build.provenance, *discarded);
    build.progress.say(fmt::format(
        "{}: its records are of another build and are dropped ({})", known.journal().path().string(),
        changes.empty() ? "other control points or --fields" : fmt::format("{}", fmt::join(changes, "; "))));
  }
  return known;
}

/// Keeps the records that a task's solution gives.
void keep_records(const Build& build, const SolvingTask& task, const Solution& solution,
                  KnownRecords& known) {
  const auto keep = [&](const Scene& scene, const Solution& answer) {
    const KeepField field = starts_others(scene) ? KeepField::yes : build.request.fields;
    known.journal().append(
        make_record(scene, answer, build.bridge.control_points, field, build.request.fields));
    build.progress.advance(1);
  };
  if (task.records_solved) keep(task.solved, solution);
  if (task.image) keep(*task.image, mirrored_solution(solution, *build.bridge.symmetry));
}

/// Solves some tasks side by side and keeps their records.
void run_batch(const Build& build, std::span<const SolvingTask> batch, const SceneSolver& solver,
               const StartingFields& starts, KnownRecords& known) {
  std::vector<std::optional<Field>> fields;
  for (const SolvingTask& task : batch) fields.push_back(starts.start_for(task.solved));
  std::vector<StageTask> scenes;
  for (std::size_t i = 0; i < batch.size(); ++i)
    scenes.push_back({.stage = {.scene = batch[i].solved}, .start = fields[i] ? &*fields[i] : nullptr});
  const std::vector<Solution> solutions = solve_for_storage(solver, scenes);
  for (std::size_t i = 0; i < batch.size(); ++i) keep_records(build, batch[i], solutions[i], known);
}

/// The fields that a stage starts from. They come out of the records, whether these were made just now or
/// long ago.
StartingFields read_starts(const std::vector<SolvingTask>& stage, const PlanRules& rules,
                           const KnownRecords& known) {
  std::set<Scene> scenes;
  for (const SolvingTask& task : stage)
    for (const Scene& start : starting_scenes(task.solved, rules)) scenes.insert(start);
  StartingFields starts;
  for (const Scene& scene : scenes) {
    const Solution solution = known.read_solution(scene);
    starts.add(scene, solution.outcome, solution.displacement);
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

void run_plan(const Build& build, const BuildPlan& plan, KnownRecords& known) {
  Crew crew(build.request.threads);
  oneapi::tbb::enumerable_thread_specific<SceneSolver> solvers(
      [&] { return build.solver.make_solver(build.bridge); });
  for (const auto& stage : plan.stages) {
    const StartingFields starts = read_starts(stage, build.request.rules, known);
    const std::size_t size = batch_size(stage.size(), crew.size());
    crew.for_each_index((stage.size() + size - 1) / size, [&](std::size_t i) {
      const std::span batch = std::span(stage).subspan(i * size, std::min(size, stage.size() - i * size));
      run_batch(build, batch, solvers.local(), starts, known);
    });
  }
}

void write(const Build& build, const KnownRecords& known, BuildSummary& summary) {
  const DatabaseContent content{build.provenance, build.bridge, build.wanted, build.request.fields};
  const WrittenDatabase written = write_database(build.request.output, content, [&](std::size_t row) {
    Record record = known.read(build.wanted[row]);
    if (build.request.fields == KeepField::no) record.packed_field.clear();
    summary.outcomes.add(record, build.bridge.layout);
    return record;
  });
  summary.digest = written.digest;
  summary.bytes = written.bytes;
}

/// Computes what is not known and writes the file.
void run(const Build& build, std::optional<Database> old, BuildSummary& summary) {
  KnownRecords known = open_records(build);
  summary.resumed = known.journal().size();
  if (summary.resumed > 0)
    build.progress.say(
        fmt::format("going on with an interrupted build: {} scenes are done", summary.resumed));
  if (old) summary.reused = known.reuse(std::move(*old), build.wanted);
  if (summary.reused > 0)
    build.progress.say(fmt::format("{} scenes of the old file are still valid and are kept", summary.reused));
  const BuildPlan plan = plan_build(build.wanted, build.bridge, build.request.rules,
                                    [&](const Scene& scene) { return known.contains(scene); });
  summary.computed = plan.records();
  build.progress.start(summary.resumed + summary.reused + summary.computed, summary.resumed + summary.reused);
  run_plan(build, plan, known);
  build.progress.finish();
  try {
    write(build, known, summary);
  } catch (const Failure& failure) {
    throw Failure(
        fmt::format("{}; all scenes are kept in {}: put things right and run the same command again",
                    failure.what(), known.journal().path().string()));
  }
  known.journal().remove();
}

void write_index(const Build& build) {
  if (build.request.xdmf_scenes.empty()) return;
  write_index(Database::open(build.request.output),
              parse_scene_list(build.request.xdmf_scenes, build.bridge.layout));
}

}  // namespace

Provenance provenance_of(const BuildRequest& request, const SolverChoice& solver) {
  return provenance_of(request, solver, make_model(request.bridge.description));
}

BuildSummary build_database(const BuildRequest& request, const SolverChoice& solver, Progress& progress) {
  const auto started = std::chrono::steady_clock::now();
  const Build build = prepare(request, solver, progress);
  BuildSummary summary;
  summary.output = request.output;
  ExistingDatabase existing =
      examine_existing(request.output, build.provenance, build.wanted, request.fields, request.force);
  summary.changes = existing.changes;
  if (existing.up_to_date) {
    summary.up_to_date = true;
    summarise_existing(*existing.database, summary);
  } else {
    for (const std::string& change : existing.changes)
      progress.say(fmt::format("{} is built anew: {}", request.output.string(), change));
    run(build, existing.reusable ? std::move(existing.database) : std::nullopt, summary);
  }
  write_index(build);
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return summary;
}

}  // namespace voussoir
