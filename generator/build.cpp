#include "generator/build.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "core/bridge_file/bridge_model.h"
#include "core/error.h"
#include "core/structure/uncertain_parameters.h"
#include "database/format/durable_file.h"
#include "database/records/writer.h"
#include "database/records/xdmf.h"
#include "generator/records/build_settings.h"
#include "generator/records/existing_database.h"
#include "generator/scenes/results_key.h"
#include "generator/scenes/reused_records.h"
#include "generator/scenes/scene_list.h"
#include "generator/scenes/variants.h"
#include "generator/shown_scenes.h"
#include "generator/uncertainty/model_error.h"
#include "generator/uncertainty/sensitivities.h"

namespace voussoir {
namespace {

/// What all steps of one build share.
struct Build {
  const BuildRequest& request;
  const SolverChoice& solver;
  Progress& progress;
  std::vector<Model> bridges;  ///< the variants
  std::vector<VariantParameters> variants;
  std::vector<RecordKey> wanted;
  KeepField fields;  ///< of its file
  StatePlan states;
  Provenance provenance;

  const Model& bridge() const { return bridges.front(); }
};

Provenance provenance_of(const BuildRequest& request, const SolverChoice& solver, const Model& bridge) {
  const std::string settings = build_settings(solver, bridge, request.rules);
  Provenance made = make_provenance(request.bridge, settings, "");
  made.results_key = results_key(request.bridge.description, made);
  return made;
}

/// What the file of a part says, as it gives it back: without blanks around lists. Nothing for a whole
/// database.
std::optional<ShardStatement> shard_statement(const BuildRequest& request) {
  if (!request.shard) return std::nullopt;
  return parse_shard_statement(
      to_text(ShardStatement{*request.shard, request.scenes, request.scenes_of_variants, request.histories,
                             request.loads, request.fields == KeepField::yes, request.known_bridge}));
}

/// The keys of all scenes that are asked for, in the order of rows.
std::vector<RecordKey> wanted_keys(const BuildRequest& request, std::size_t variants,
                                   const BlockLayout& layout) {
  const auto of_nominal = parse_scene_list(request.scenes, layout);
  const auto of_others =
      request.scenes_of_variants.empty() ? of_nominal : parse_scene_list(request.scenes_of_variants, layout);
  std::vector<RecordKey> wanted;
  for (std::size_t variant = 0; variant < variants; ++variant)
    std::ranges::move(keys_of(static_cast<std::int32_t>(variant), variant == 0 ? of_nominal : of_others),
                      std::back_inserter(wanted));
  return wanted;
}

/// Is anything that is uncertain a parameter of this bridge? Sides that are free have no movement.
bool wants_sensitivities(const BuildRequest& request, const Model& bridge) {
  return !request.known_bridge && has_uncertain_parameters(bridge, request.bridge.description.uncertainty);
}

/// Derivatives of the joints' law are those of dry joints. A database without them would be asked as if the
/// bridge were exactly known, which nobody shall do unknowingly.
void expect_dry_joints_or_known(const BuildRequest& request, const Model& bridge) {
  if (wants_sensitivities(request, bridge) && has_mortar(bridge.parameters))
    throw InputError(
        fmt::format("{}: has [[mortar]], and how displacements change with what is uncertain of a bridge is "
                    "known of dry joints only: expected --known-bridge, with which locate-damage takes the "
                    "bridge for exactly known",
                    request.bridge.name));
}

Build prepare(const BuildRequest& request, const SolverChoice& solver, Progress& progress) {
  std::vector<Model> bridges = {model_of(request.bridge)};
  expect_dry_joints_or_known(request, bridges.front());
  std::vector<VariantParameters> variants = {variant_parameters(bridges.front().parameters)};
  for (const VariantParameters& parameters : request.other_variants) {
    bridges.push_back(variant_of(bridges.front(), parameters));
    variants.push_back(parameters);
  }
  std::vector<RecordKey> wanted = wanted_keys(request, variants.size(), bridges.front().layout);
  const BridgeDescription& description = request.bridge.description;
  StatePlan states = plan_states(state_names(request.histories, request.loads, description.loads),
                                 bridges.front(), description);
  Provenance provenance = provenance_of(request, solver, bridges.front());
  // Parts keep the fields that the whole's sensitivities come from, unless there are as many as of triples.
  const KeepField fields =
      request.shard && most_missing_of_starts(wanted) == 1 ? KeepField::yes : request.fields;
  if (request.shard) wanted = keys_of_shard(wanted, {bridges, request.rules, states}, *request.shard);
  return {request,           solver, progress,          std::move(bridges),   std::move(variants),
          std::move(wanted), fields, std::move(states), std::move(provenance)};
}

/// Names of the states that the database keeps.
std::vector<std::string> kept_names(const StatePlan& plan) {
  std::vector<std::string> names;
  for (const std::size_t state : kept_states(plan)) names.push_back(plan[state].name);
  return names;
}

/// Records fit into the same journal if results, what is measured, variants, states and the choice of fields
/// are the same.
std::string journal_key(const Build& build) {
  Sha256Stream hash;
  for (const DatasetValue& dataset : parameter_datasets(build.variants)) hash.add(dataset.bytes);
  for (const PlannedState& state : build.states) {
    hash.add(view_bytes(state.name));
    hash.add(std::as_bytes(numbers_of(state.load)));
  }
  hash.add(view_bytes(points_key(build.request.bridge.description)));
  const std::string key = build.provenance.results_key + " " + to_hexadecimal(hash.finish());
  if (build.fields == KeepField::yes) return key + " with fields";
  return key + (most_missing_of_starts(build.wanted) > 1 ? " with fields of pairs" : " without fields");
}

KnownRecords open_records(const Build& build, OtherRecords others) {
  KnownRecords known(Journal::open(build.request.output, build.provenance, journal_key(build), others),
                     build.states, build.bridge().mesh.node_count());
  if (const auto& discarded = known.journal().discarded()) {
    const auto changes = differences(build.provenance, *discarded);
    build.progress.say(fmt::format("{}: its records are of another build and are dropped ({})",
                                   known.journal().path().string(),
                                   changes.empty() ? "other variants, states or --fields"
                                                   : fmt::format("{}", fmt::join(changes, "; "))));
  }
  return known;
}

/// Records that another file has.
std::unique_ptr<ReusedRecords> records_in(const Build& build, Database old, const KnownRecords& known) {
  return std::make_unique<ReusedRecords>(std::move(old),
                                         NewRecords{build.bridges, build.variants, build.wanted, build.fields,
                                                    build.states, build.request.bridge.description},
                                         known.journal());
}

/// Nothing of an old file that is too damaged to take records from, which is said.
std::unique_ptr<ReusedRecords> usable_records_in(const Build& build, Database old,
                                                 const KnownRecords& known) {
  try {
    return records_in(build, std::move(old), known);
  } catch (const InputError& error) {
    build.progress.say(fmt::format("no scene of the old file can be kept ({})", error.what()));
    return nullptr;
  }
}

/// How many records the old database gives.
std::size_t reuse(const Build& build, Database old, KnownRecords& known) {
  auto reused = usable_records_in(build, std::move(old), known);
  if (!reused) return 0;
  const std::size_t count = reused->size();
  if (count > 0)
    build.progress.say(fmt::format("{} scenes of the old file are still valid and are kept", count));
  else if (!reused->state_names().empty())
    build.progress.say(
        fmt::format("of the scenes of the old file these states are still valid and are kept: {}",
                    fmt::join(reused->state_names(), ", ")));
  known.add(std::move(reused));
  return count;
}

/// Of the nominal variant, unless the bridge is said to be known.
std::optional<Sensitivities> sensitivities_of(const Build& build, const KnownRecords& known) {
  if (!wants_sensitivities(build.request, build.bridge()) || build.request.shard) return std::nullopt;
  std::vector<Scene> scenes;
  for (const RecordKey& key : build.wanted)
    if (key.variant == kNominalVariant) scenes.push_back(key.scene);
  return find_sensitivities({build.request.bridge.description, build.bridge(), build.states, build.solver,
                             build.provenance.solver_settings, build.request.threads},
                            scenes, known, build.progress);
}

std::vector<ModelError> model_errors_of(const Build& build, const KnownRecords& known) {
  if (build.request.shard) return std::vector<ModelError>(kept_states(build.states).size());
  ErrorProbes probes{build.request.bridge.description, build.bridge(), build.states, build.solver};
  const RecordKey intact{kNominalVariant, {}};
  if (known.has_record(intact))
    for (const RecordedState& state : known.kept_record(intact, build.fields).states)
      probes.intact_stands.push_back(state.outcome == Outcome::standing);
  const std::vector<std::string> names = kept_names(build.states);
  for (std::size_t i = 0; i < probes.intact_stands.size(); ++i)
    if (!probes.intact_stands[i])
      build.progress.say(fmt::format(
          "the intact bridge does not stand as {}: readings of this state say nothing of losses", names[i]));
  return estimate_model_errors(probes, build.progress);
}

void write(const Build& build, const KnownRecords& known, BuildSummary& summary) {
  const DatabaseContent content{build.provenance,
                                build.bridge(),
                                build.variants,
                                build.wanted,
                                kept_names(build.states),
                                build.fields,
                                model_errors_of(build, known),
                                sensitivities_of(build, known),
                                shard_statement(build.request)};
  summary.outcomes = OutcomeCounts(content.states);
  const WrittenDatabase written = write_database(build.request.output, content, [&](std::size_t row) {
    Record record = known.kept_record(build.wanted[row], build.fields);
    summary.outcomes.add(record, build.bridge().layout);
    return record;
  });
  if (written.had_index && build.request.xdmf_scenes.empty())
    build.progress.say(index_removed_in_words(build.request.output));
  summary.digest = written.digest;
  summary.bytes = written.bytes;
}

BuildPlan plan_of(const Build& build, const KnownRecords& known) {
  return plan_build(build.wanted, {build.bridges, build.request.rules, build.states},
                    {[&](const RecordKey& key) { return known.has_record(key); },
                     [&](const RecordKey& key) { return known.can_start(key); }});
}

/// Writes the file of known records, which outlive a failure in the journal.
void finish(const Build& build, KnownRecords& known, BuildSummary& summary) {
  try {
    write(build, known, summary);
  } catch (const Failure& failure) {
    throw Failure(
        fmt::format("{}; all scenes are kept in {}: put things right and run the same command again",
                    failure.what(), known.journal().path().string()));
  }
  known.journal().remove();
}

/// Computes what is not known and writes the file.
void run(const Build& build, KnownRecords known, std::optional<Database> old, BuildSummary& summary) {
  summary.resumed = known.journal().size();
  if (const std::size_t done = summary.resumed; done > 0)
    build.progress.say(fmt::format("going on with an interrupted build: {} scenes are done", done));
  if (old) summary.reused = reuse(build, std::move(*old), known);
  BuildPlan plan = plan_of(build, known);
  summary.computed = plan.records();
  build.progress.start(summary.resumed + summary.reused + summary.computed, summary.resumed + summary.reused,
                       "scenes");
  run_plan(std::move(plan),
           {build.bridges, build.solver, build.provenance.solver_settings, build.request.rules, build.states,
            build.fields, most_missing_of_starts(build.wanted), build.request.threads, build.progress},
           known);
  build.progress.finish();
  finish(build, known, summary);
}

/// Takes all records from the parts, all of which are there, and writes the file.
void gather(const Build& build, KnownRecords known, std::vector<Database> parts, BuildSummary& summary) {
  const int count = static_cast<int>(parts.size());
  for (Database& part : parts) known.add(records_in(build, std::move(part), known));
  for (const RecordKey& key : build.wanted)
    if (!known.has_record(key)) {
      if (known.journal().size() == 0) known.journal().remove();  // else of an interrupted build of the whole
      const PlanBasis basis{build.bridges, build.request.rules, build.states};
      throw Failure(fmt::format("part {} lacks scene {}, or has it damaged: build this part anew",
                                to_string(shard_with(key, build.wanted, basis, count)),
                                to_string(key, build.bridge().layout)));
    }
  summary.merged = build.wanted.size();
  finish(build, known, summary);
}

ExistingDatabase examine(const Build& build) {
  const BuildRequest& request = build.request;
  return examine_existing(request.output,
                          {build.provenance, build.variants, build.wanted, kept_names(build.states),
                           build.fields, wants_sensitivities(request, build.bridge()) && !request.shard,
                           shard_statement(request), request.drop},
                          request.force);
}

/// Writes a file that is not up to date. Its journal keeps other builds away, so what stands there is
/// examined again: another one may have ended in between.
void renew(const Build& build, std::vector<Database> parts, ExistingDatabase& existing,
           BuildSummary& summary) {
  KnownRecords known = open_records(build, parts.empty() ? OtherRecords::drop : OtherRecords::refuse);
  existing = examine(build);
  summary.changes = existing.changes;
  if (existing.up_to_date) return known.journal().remove();
  for (const std::string& change : existing.changes)
    build.progress.say(fmt::format("{} is built anew: {}", build.request.output.string(), change));
  if (parts.empty())
    run(build, std::move(known), existing.reusable ? std::move(existing.database) : std::nullopt, summary);
  else
    gather(build, std::move(known), std::move(parts), summary);
}

/// From the parts, if there are any.
BuildSummary build(BuildRequest request, const SolverChoice& solver, Progress& progress,
                   std::vector<Database> parts) {
  const auto started = std::chrono::steady_clock::now();
  expect_file(request.output, request.bridge.name);
  request.output = behind_links(request.output);
  const Build build = prepare(request, solver, progress);
  const std::vector<Scene> shown =
      shown_scenes(request.xdmf_scenes, {request.output, build.wanted, build.fields, build.bridge().layout});
  BuildSummary summary;
  summary.output = request.output;
  summary.blocks = build.bridge().layout.size();
  summary.small_pieces = build.bridge().layout.small_pieces;
  summary.collapse_fields = request.rules.collapse_fields;
  ExistingDatabase existing = examine(build);
  if (!existing.up_to_date) renew(build, std::move(parts), existing, summary);
  if (existing.up_to_date) {
    summary.up_to_date = true;
    summary.outcomes = count_outcomes(*existing.database);
    summary.bytes = std::filesystem::file_size(existing.database->path());
    summary.digest = existing.database->digest();
  }
  if (!shown.empty()) write_index(Database::open(request.output), shown);
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return summary;
}

}  // namespace

Provenance provenance_of(const BuildRequest& request, const SolverChoice& solver) {
  return provenance_of(request, solver, model_of(request.bridge));
}

BuildSummary build_database(const BuildRequest& request, const SolverChoice& solver, Progress& progress) {
  return build(request, solver, progress, {});
}

BuildSummary build_from_parts(const BuildRequest& request, const SolverChoice& solver,
                              std::vector<Database> parts, Progress& progress) {
  return build(request, solver, progress, std::move(parts));
}

}  // namespace voussoir
