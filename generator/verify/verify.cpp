#include "generator/verify/verify.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <numeric>
#include <ranges>

#include "core/error.h"
#include "core/solve/state_name.h"
#include "database/records/content_digest.h"
#include "database/records/schema.h"
#include "database/records/stored_bridge.h"
#include "database/search/stored_index.h"
#include "generator/records/build_settings.h"
#include "generator/running/parallel.h"
#include "generator/scenes/variants.h"
#include "generator/verify/field_difference.h"
#include "generator/verify/origin_check.h"
#include "generator/verify/recompute.h"
#include "generator/verify/scene_check.h"
#include "generator/verify/sensitivity_check.h"

namespace voussoir {
namespace {

/// Of these some need to be solved again: enough to fill a solver's lanes.
constexpr std::size_t kCheckedTogether = 64;

void check_digest(const Database& database, const std::vector<DatasetValue>& expected, VerifyReport& report) {
  std::vector<DigestPart> parts;
  for (const DatasetValue& value : expected)
    parts.push_back({value.path, database.dataset_bytes(value.path.c_str())});
  parts.push_back({dataset::kChecksum, database.dataset_bytes(dataset::kChecksum)});
  if (to_hexadecimal(content_digest(parts)) != database.digest())
    report.problems.push_back("content digest: the content does not have the digest that the file states");
}

bool stands_in(const Database& database, const DatasetValue& value) {
  const ByteView stored = database.dataset_bytes(value.path.c_str()), expected = value.content();
  return expected.data() == stored.data() || std::ranges::equal(expected, stored);
}

/// What all records share, as it should be: geometry, control points and the nominal variant as the bridge
/// text gives them, but only if the same program made them: another version may mesh blocks in another way.
std::vector<DatasetValue> expected_datasets(const Database& database, const Model& stored) {
  const Provenance provenance = database.provenance();
  const BridgeDescription description = description_of(database);
  const Provenance own = make_provenance({provenance.bridge_name, provenance.bridge_text, description, {}},
                                         provenance.solver_settings, provenance.results_key);
  const bool same_program = differences(own, provenance).empty();
  const Model bridge = same_program ? make_model(description) : stored;
  std::vector<VariantParameters> variants = database.variants();
  // Of the others nothing else says what they should be.
  variants.front() = variant_parameters(bridge.parameters);
  return shared_datasets(provenance, bridge, variants, database.states(), database.model_errors(),
                         database.sensitivities());
}

void check_shared(const Database& database, const std::vector<DatasetValue>& expected, VerifyReport& report) {
  for (const DatasetValue& value : expected)
    if (!stands_in(database, value))
      report.problems.push_back(fmt::format("dataset '{}': is not what the bridge text gives", value.path));
}

/// A solver of the variant for each thread.
using ThreadSolvers = oneapi::tbb::enumerable_thread_specific<StageSolver>;

/// They are made when something is solved: most checks need none.
ThreadSolvers thread_solvers(const Database& database, const Model& bridge) {
  return ThreadSolvers([&bridge, settings = database.provenance().solver_settings] {
    return StageSolver([&bridge, settings, solver = StageSolver()](std::span<const StageTask> tasks) mutable {
      if (!solver) solver = stated_solver(bridge, settings);
      return solver(tasks);
    });
  });
}

void check_scenes(const CheckedVariant& checked, const SceneTable& table, int threads, VerifyReport& report) {
  std::vector<std::size_t> rows(table.rows);
  std::iota(rows.begin(), rows.end(), table.first_record);
  std::vector<std::vector<SceneCheck>> checks((rows.size() + kCheckedTogether - 1) / kCheckedTogether);
  ThreadSolvers solvers = thread_solvers(checked.database, checked.bridge);
  Crew(threads).for_each_index(checks.size(), [&](std::size_t i) {
    const std::size_t first = i * kCheckedTogether;
    checks[i] =
        check_scenes(checked, std::span(rows).subspan(first, std::min(kCheckedTogether, rows.size() - first)),
                     solvers.local());
  });
  for (const SceneCheck& check : checks | std::views::join) {
    report.fields += check.fields;
    report.mirror_pairs += check.mirror_compared ? 1 : 0;
    report.largest_unbalance = std::max(report.largest_unbalance, check.unbalance);
    report.problems.insert(report.problems.end(), check.problems.begin(), check.problems.end());
  }
}

/// What searches look at first follows from the control displacements.
void check_search(const Database& database, VerifyReport& report) {
  for (std::size_t state = 0; state < database.states().size(); ++state) {
    const std::string& name = database.states()[state];
    const SceneTable table = database.table(kNominalVariant, state);
    if (!is_history(name)) continue;
    for (const DatasetValue& value : search_datasets(name, table.vertical, table.points))
      if (!stands_in(database, value))
        report.problems.push_back(
            fmt::format("dataset '{}': is not what the control displacements give", value.path));
  }
}

/// Of factors, which may be many, one scene after the other is looked at.
void check_factors(const Sensitivities& sensitivities, VerifyReport& report) {
  if (!are_factors_sound(sensitivities))
    report.problems.push_back(
        fmt::format("datasets '{}', '{}' and '{}': a scene without sensitivities has some",
                    dataset::kBridgeFactors, dataset::kEpochFactors, dataset::kSignalLeft));
  else if (sensitivities.signals && !are_signals_right(sensitivities))
    report.problems.push_back(fmt::format("group '{}': is not what '{}' and '{}' give", dataset::kSignals,
                                          dataset::kBridgeFactors, dataset::kEpochFactors));
}

struct Recomputed {
  double difference = 0.0;
  std::size_t composed = 0;
  double composed_error = 0.0;
  std::size_t inherited = 0;
  std::vector<std::string> problems{};
};

/// Control displacements of the intact bridge as built: stored, or solved.
std::vector<double> intact_displacements(const RecomputedVariant& variant, std::int32_t number,
                                         const StageSolver& solver) {
  const RecordKey intact{number, Scene{}};
  const SceneTable table = variant.database.table(number, kBuilt);
  if (const auto row = table.find(intact.scene)) {
    const auto stored = table.row(*row);
    return {stored.begin(), stored.end()};
  }
  const std::vector<Solution> states = recompute_start(intact, variant, solver);
  const Eigen::VectorXd vertical = readings_at(variant.bridge.control_points, states[kBuilt].displacement);
  return {vertical.begin(), vertical.end()};
}

/// Of a composed state against its solution: composed_error.
double error_of_composed(const RecomputedVariant& variant, const RecordKey& key, const RecordedState& stored,
                         const Solution& anew, const StageSolver& solver) {
  const Eigen::VectorXd solved = readings_at(variant.bridge.control_points, anew.displacement);
  return composed_error(stored.vertical, {solved.data(), static_cast<std::size_t>(solved.size())},
                        intact_displacements(variant, key.variant, solver));
}

/// Compares a stored state with its solution; what is wrong.
std::optional<std::string> compare(const RecomputedVariant& variant, const RecordKey& key,
                                   const RecordedState& stored, const Solution& anew,
                                   const StageSolver& solver, Recomputed& result) {
  if (stored.origin == Origin::inherited) ++result.inherited;
  if (anew.outcome != stored.outcome)
    return fmt::format("it is {}, not {}", to_string(anew.outcome), to_string(stored.outcome));
  if (stored.origin == Origin::inherited) return std::nullopt;
  if (stored.origin == Origin::composed) {
    ++result.composed;
    const double error = error_of_composed(variant, key, stored, anew, solver);
    result.composed_error = std::max(result.composed_error, error);
    return error <= 1.0
               ? std::nullopt
               : std::optional(fmt::format("the composed signal is off by {:.2f} of what is allowed", error));
  }
  const double difference = largest_difference(anew, stored, variant.bridge);
  result.difference = std::max(result.difference, difference);
  return stored.outcome == Outcome::standing && !(difference <= kSameDisplacement)
             ? std::optional(fmt::format("it differs by {:.1e} m", difference))
             : std::nullopt;
}

Recomputed recompute_row(const RecomputedVariant& variant, std::size_t row, const StageSolver& solver) {
  const RecordKey key = variant.database.key(row);
  const Record stored = variant.database.record(row);
  const std::vector<Solution> solutions = recompute(key, variant, solver);
  const std::vector<std::size_t> kept = kept_states(variant.plan);
  Recomputed result;
  for (std::size_t state = 0; state < kept.size(); ++state)
    if (const auto problem =
            compare(variant, key, stored.states[state], solutions[kept[state]], solver, result))
      result.problems.push_back(fmt::format("scene {}: solved anew {} {}",
                                            to_string(key, variant.bridge.layout),
                                            variant.database.states()[state], *problem));
  return result;
}

/// Solves those of the rows anew that are of the variant whose bridge this is.
void check_recomputed(const VerifyRequest& request, const RecomputedVariant& variant,
                      std::span<const std::size_t> rows, VerifyReport& report) {
  std::vector<Recomputed> results(rows.size());
  ThreadSolvers solvers = thread_solvers(variant.database, variant.bridge);
  Crew(request.threads).for_each_index(rows.size(), [&](std::size_t i) {
    results[i] = recompute_row(variant, rows[i], solvers.local());
  });
  report.recomputed += rows.size();
  for (const Recomputed& result : results) {
    report.largest_recomputed_difference = std::max(report.largest_recomputed_difference, result.difference);
    report.recomputed_composed += result.composed;
    report.largest_composed_error = std::max(report.largest_composed_error, result.composed_error);
    report.recomputed_inherited += result.inherited;
    report.problems.insert(report.problems.end(), result.problems.begin(), result.problems.end());
  }
}

/// Those of the rows that a table holds; rows are in ascending order.
std::span<const std::size_t> rows_in(const SceneTable& table, std::span<const std::size_t> rows) {
  const auto begin = std::ranges::lower_bound(rows, table.first_record);
  const auto end = std::ranges::lower_bound(rows, table.first_record + table.rows);
  return {begin, end};
}

/// What searches of any of the variant's scenes as lost begin with.
SearchBasis basis_of_all(const RecomputedVariant& variant, std::int32_t number) {
  if (!place_of_lost(variant.plan) || !variant.database.has_fields()) return {};
  std::set<Scene> starting;
  const SceneTable table = variant.database.table(number, 0);
  for (std::size_t row = 0; row < table.rows; ++row)
    starting.merge(starting_scenes(table.scene(row), std::nullopt, variant.rules, variant.plan));
  return basis_of(starting, number, variant,
                  stated_solver(variant.bridge, variant.database.provenance().solver_settings));
}

void check_variant(const VerifyRequest& request, const Database& database, const Model& bridge,
                   std::int32_t number, const StatePlan& plan, VerifyReport& report) {
  const std::string settings = database.provenance().solver_settings;
  const SceneTable table = database.table(number, 0);
  const StateSolving equations(bridge, plan);
  const RecomputedVariant variant{database, bridge, plan, equations, rules_in(settings)};
  report.collapse_fields = variant.rules.collapse_fields;
  const CheckedVariant checked{database,
                               bridge,
                               plan,
                               equations,
                               basis_of_all(variant, number),
                               most_stored_unbalance(bridge, settings),
                               variant.rules};
  report.most_unbalance = std::max(report.most_unbalance, checked.most_unbalance);
  check_scenes(checked, table, request.threads, report);
  const auto recomputed = choose_rows(database.rows(), request.recompute, request.seed);
  const auto rows = rows_in(table, recomputed);
  RecomputedVariant in_full{database, bridge, plan, equations, variant.rules};
  in_full.rules.composed = in_full.rules.inherited = false;
  if (!rows.empty()) check_recomputed(request, in_full, rows, report);
}

/// What the database's states are. Throws InputError naming the dataset if they are none that there can be.
StatePlan plan_of(const Database& database, const Model& nominal) {
  try {
    return plan_states(database.states(), nominal, description_of(database));
  } catch (const InputError& error) {
    throw InputError(fmt::format("dataset '{}': {}", dataset::kStates, error.what()));
  }
}

/// A variant of the bridge. Throws InputError for parameters that variant_of does not take.
Model variant_in(const Database& database, const Model& nominal, std::int32_t variant) {
  if (variant == kNominalVariant) return nominal;
  try {
    return variant_of(nominal, database.variants().at(static_cast<std::size_t>(variant)));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: variant {}: {}", database.path().string(), variant, error.what()));
  }
}

/// The bridge that the records are of, and all that they share. Nothing can be said of scenes, and nothing
/// should be solved, if that is wrong.
std::optional<Model> check_bridge(const Database& database, VerifyReport& report) {
  report.problems = origin_problems(database);
  if (!report.ok()) return std::nullopt;
  Model nominal = bridge_of(database);
  const std::vector<DatasetValue> expected = expected_datasets(database, nominal);
  check_shared(database, expected, report);
  if (!report.ok()) return std::nullopt;
  check_digest(database, expected, report);
  return nominal;
}

void check_content(const VerifyRequest& request, VerifyReport& report) {
  const Database database = Database::open(request.database);
  report.digest = database.digest();
  if (const auto& part = database.shard()) report.part = part->shard;
  report.outcomes = count_outcomes(database);
  const std::optional<Model> nominal = check_bridge(database, report);
  if (!nominal) return;
  check_search(database, report);
  if (const Sensitivities* const sensitivities = database.sensitivities())
    check_factors(*sensitivities, report);
  const StatePlan plan = plan_of(database, *nominal);
  for (std::int32_t variant = 0; static_cast<std::size_t>(variant) < database.variant_count(); ++variant)
    check_variant(request, database, variant_in(database, *nominal, variant), variant, plan, report);
  if (!report.ok()) return;  // of damaged fields nothing can be said
  const SensitivityCheck sensitivities =
      check_sensitivities(database, *nominal, description_of(database), plan);
  std::ranges::copy(sensitivities.problems, std::back_inserter(report.problems));
}

}  // namespace

VerifyReport verify_database(const VerifyRequest& request) {
  VerifyReport report;
  try {
    check_content(request, report);
  } catch (const InputError& error) {
    report.problems.push_back(error.what());
  }
  return report;
}

}  // namespace voussoir
