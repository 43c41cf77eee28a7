#pragma once
/// @file Building a database.

#include <filesystem>

#include "core/bridge_file/bridge_file.h"
#include "database/records/database.h"
#include "generator/records/outcome_counts.h"
#include "generator/scenes/plan_run.h"

namespace voussoir {

struct BuildRequest {
  BridgeFile bridge;
  std::filesystem::path output = "bridge.h5";  ///< links are followed, not replaced
  std::string scenes = "all";                  ///< as parse_scene_list reads it
  std::string scenes_of_variants;              ///< of variants 1, 2..; empty: the same as of variant 0
  std::string histories = "built";             ///< as state_names reads it
  std::string loads = "none";                  ///< as state_names reads it
  /// Variants 1, 2..: the bridge with other parameters (see variant_of). Variant 0 is the bridge as it is.
  std::vector<VariantParameters> other_variants;
  int threads = 0;  ///< 0: one for each core
  KeepField fields = KeepField::yes;
  PlanRules rules;
  std::string xdmf_scenes;     ///< scenes of the XDMF index beside the database; empty: no index
  std::optional<Shard> shard;  ///< compute this part only, for merge_databases (generator/merge.h)
  bool known_bridge = false;   ///< leave out the sensitivities to what is uncertain of the bridge
  bool force = false;          ///< build anew even if the file is up to date
  bool drop = false;           ///< valid scenes and states of an existing file that are not wanted may go
};

struct BuildSummary {
  std::filesystem::path output;
  bool up_to_date = false;   ///< nothing had to be done
  std::size_t blocks = 0;    ///< of the bridge
  SmallPieces small_pieces;  ///< what the wall's smallest block made of them
  OutcomeCounts outcomes;
  bool collapse_fields = true;       ///< does it keep fields of what falls? (PlanRules)
  std::size_t computed = 0;          ///< records made by this run (with those that only start others)
  std::size_t resumed = 0;           ///< records kept from an interrupted build
  std::size_t reused = 0;            ///< records taken over from the file that was replaced
  std::size_t merged = 0;            ///< records taken from parts
  std::vector<std::string> changes;  ///< what differs from the file that was replaced
  double seconds = 0.0;
  std::uintmax_t bytes = 0;
  std::string digest;
};

/// What the database of this request will state of its origin.
Provenance provenance_of(const BuildRequest& request, const SolverChoice& solver);

/// Builds the database of a bridge. The content does not depend on threads, interruptions or what the file
/// held before. Throws InputError for a bad list of scenes, states or variants and Failure if files cannot be
/// written; every scene computed until then is kept in the journal and the same call goes on from there.
BuildSummary build_database(const BuildRequest& request, const SolverChoice& solver, Progress& progress);

/// The same with all records from the parts, which have the request's results key, variants and states.
/// Throws Failure naming a scene that no part has or of which the record is damaged.
BuildSummary build_from_parts(const BuildRequest& request, const SolverChoice& solver,
                              std::vector<Database> parts, Progress& progress);

}  // namespace voussoir
