#pragma once
/// @file Which scenes of which variants are solved, in which order.

#include <functional>
#include <set>
#include <span>
#include <vector>

#include "core/solve/state_plan.h"
#include "core/structure/model.h"
#include "database/records/record_key.h"
#include "database/records/shard.h"

namespace voussoir {

/// One equilibrium search and the scenes that it answers for: the scene itself, its mirror image or both.
struct SolvingTask {
  std::int32_t variant = kNominalVariant;
  Scene solved;
  bool records_solved = false;
  std::optional<Scene> image;  ///< the mirror image, if it is wanted and is another scene
};

struct BuildPlan {
  /// Stages follow each other: intact, then singles, then pairs, then everything else, each of which starts
  /// from the fields of those before.
  /// Tasks of a stage do not depend on each other and are ordered by variant.
  std::vector<std::vector<SolvingTask>> stages;

  std::size_t records() const;  ///< that the tasks of all stages give
};

/// What a build makes use of so that it solves less and starts nearer.
struct PlanRules {
  bool mirror_images = true;  ///< of a scene and its mirror image one is solved
  bool warm_starts = true;    ///< searches start from the fields of scenes with fewer missing blocks
  bool inherited = true;      ///< collapses of scenes with fewer missing blocks are passed on (Origin), and
                              ///< what is proved to fall so is not searched for after a loss
  bool composed = true;       ///< triples are composed of pairs where a check allows it (Composition)
  /// False: of scenes that fall only that and what falls is found, not their fields, and what a single's
  /// collapse proves to fall is not set in motion (core/statics/mechanism.h).
  bool collapse_fields = true;
};

/// The scene that is solved to answer for this one: the lexicographically smaller of the scene and its mirror
/// image, or the scene itself if mirror images are not used or the bridge has no symmetry.
Scene representative(const Scene& scene, const Model& bridge, const PlanRules& rules);

/// What a plan is made by.
struct PlanBasis {
  std::span<const Model> bridges;  ///< the variants
  PlanRules rules;
  const StatePlan& states;
};

/// The scenes whose states the solving of this one, and of its mirror image if that is wanted, needs: those
/// that its searches start from (see StartingFields), those that prove that it falls (see ProvedFalls), and
/// if blocks are lost those that say in how many steps (see StepsOfLoss).
std::set<Scene> starting_scenes(const Scene& solved, const std::optional<Scene>& image,
                                const PlanRules& rules, const StatePlan& states);

/// What need not be computed.
struct KnownKeys {
  std::function<bool(const RecordKey&)> has_record;  ///< all that the database keeps of it
  std::function<bool(const RecordKey&)> can_start;   ///< all states of it, so that others can start from them
};

/// A task for every wanted record and for the intact bridge, singles and pairs that wanted scenes start from,
/// in the same variant, except for those known already. With a mirror symmetry of the variant the
/// lexicographically smaller of a scene and its image is solved, whatever records are wanted, so that a
/// record does not depend on the rest of the list.
BuildPlan plan_build(const std::vector<RecordKey>& wanted, const PlanBasis& basis, const KnownKeys& known);

/// The most missing blocks of scenes that any of these starts from. Their fields are needed even if the
/// database is to hold none.
int most_missing_of_starts(const std::vector<RecordKey>& wanted);

/// Those of the keys that this part of the whole holds, in their order. Tasks of the whole are dealt out one
/// after the other, so every part has its share of what is hard; the intact bridge is in every part.
std::vector<RecordKey> keys_of_shard(const std::vector<RecordKey>& wanted, const PlanBasis& basis,
                                     const Shard& shard);

/// Which of so many shards has a record of the whole; the first of them if none is to solve it.
Shard shard_with(const RecordKey& key, const std::vector<RecordKey>& wanted, const PlanBasis& basis,
                 int count);

}  // namespace voussoir
