#pragma once
/// @file Checking that a database is whole and right.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "database/records/shard.h"
#include "generator/records/outcome_counts.h"
#include "generator/scenes/solvers.h"

namespace voussoir {

struct VerifyRequest {
  std::filesystem::path database;
  std::size_t recompute = 0;  ///< how many scenes to solve anew
  std::uint64_t seed = 1;     ///< of their choice
  int threads = 0;            ///< 0: one for each core
};

struct VerifyReport {
  std::string digest;           ///< as the file states it
  std::optional<Shard> part{};  ///< nothing: it is whole, or cannot be read
  OutcomeCounts outcomes;
  std::size_t fields = 0;          ///< stored fields that were checked
  bool collapse_fields = true;     ///< does it keep fields of what falls? (PlanRules)
  double largest_unbalance = 0.0;  ///< of the standing scenes' stored fields, over the largest nodal weight
  double most_unbalance = 0.0;     ///< that rounding and the solver's tolerance explain
  std::size_t mirror_pairs = 0;    ///< pairs of scenes that were compared
  std::size_t recomputed = 0;
  double largest_recomputed_difference = 0.0;  ///< [m] between stored and recomputed displacements that were
                                               ///< solved
  std::size_t recomputed_composed = 0;         ///< of the recomputed: states that are stored as composed
  double largest_composed_error = 0.0;         ///< of these: composed_error
  std::size_t recomputed_inherited = 0;        ///< of the recomputed: states that are stored as inherited
  std::vector<std::string> problems;           ///< each names the scene or dataset; empty if all is well
  bool ok() const { return problems.empty(); }
};

/// Checks the schema, what is stated of the origin (origin_check.h), the content digest, that geometry,
/// control points and the nominal variant are those of the bridge text (when this very program built the
/// file), and for every scene of every variant: checksums, that the field is decodable and missing just where
/// blocks are, that the control table repeats the field, equilibrium of standing scenes from the stored field
/// alone, and that mirror images have mirrored fields. Where origin or geometry are wrong nothing is solved
/// or said of scenes. Solves some scenes anew if asked for: in full, whatever is stored as composed or
/// inherited. Throws Failure if the file cannot be read at all; whatever is wrong with its content is a
/// problem in the report.
VerifyReport verify_database(const VerifyRequest& request);

/// Lines for people; at most twenty problems.
std::string to_text(const VerifyReport& report, const std::filesystem::path& database);

/// One line: {"ok", "digest", what OutcomeCounts has, "collapses", "fields", "largest_unbalance",
/// "most_unbalance", "mirror_pairs", "recomputed", "largest_recomputed_difference_m", "recomputed_composed",
/// "largest_composed_error", "recomputed_inherited", "problems"}.
std::string to_json(const VerifyReport& report);

}  // namespace voussoir
