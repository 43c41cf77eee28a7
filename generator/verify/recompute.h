#pragma once
/// @file Solving scenes of a database anew.

#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "database/records/database.h"
#include "generator/scenes/build_plan.h"
#include "generator/scenes/state_solving.h"

namespace voussoir {

/// `count` different rows of a table of `rows`, in ascending order; the same for the same seed everywhere.
std::vector<std::size_t> choose_rows(std::size_t rows, std::size_t count, std::uint64_t seed);

/// Solutions of the intact bridge and singles, from which many scenes start. Thread-safe.
class SolvedStarts {
 public:
  std::optional<std::vector<Solution>> find(const RecordKey& key) const;
  void add(const RecordKey& key, const std::vector<Solution>& states);

 private:
  mutable std::mutex mutex_;
  std::map<RecordKey, std::vector<Solution>> solved_;
};

/// A database's variant, and what its scenes are solved by.
struct RecomputedVariant {
  const Database& database;
  const Model& bridge;            ///< of the variant
  const StatePlan& plan;          ///< of the database's states
  const StateSolving& equations;  ///< of this bridge and this plan
  PlanRules rules;
  std::shared_ptr<SolvedStarts> starts = std::make_shared<SolvedStarts>();  ///< with these rules
};

/// All states of the intact bridge or of a single, from which others start: solved once.
std::vector<Solution> recompute_start(const RecordKey& key, const RecomputedVariant& variant,
                                      const StageSolver& solver);

/// What searches of a variant begin with whose scenes start from these: the stored fields of the intact
/// bridge and singles, or those solved anew where the database has not all of them. `solver` is the
/// variant's.
SearchBasis basis_of(const std::set<Scene>& starting, std::int32_t number, const RecomputedVariant& variant,
                     const StageSolver& solver);

/// Solves all states of the plan by the rule that build-database follows: those of the scene's mirror image
/// if that is the one solved, with the basis of its own starting scenes.
std::vector<Solution> recompute(const RecordKey& key, const RecomputedVariant& variant,
                                const StageSolver& solver);

/// Largest difference [m] between stored and recomputed displacements: of all nodes, or of the control points
/// if no field is stored. Infinite if a displacement is there in only one of them, or the field unreadable.
double largest_difference(const Solution& recomputed, const RecordedState& stored, const Structure& bridge);

}  // namespace voussoir
