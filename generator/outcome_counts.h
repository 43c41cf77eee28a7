#pragma once
/// @file How many scenes of a database stand, collapse, or have no outcome, and which these last are: of all
/// variants, in the first state.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

struct UnresolvedScene {
  std::string scene;
  double residual = 0.0;  ///< as in Solution
};

struct OutcomeCounts {
  std::size_t scenes = 0;
  std::size_t standing = 0;
  std::size_t collapsed = 0;
  std::size_t arch_collapses = 0;   ///< of the collapsed: blocks of the arch move away
  std::size_t local_collapses = 0;  ///< of the collapsed: wall blocks only move away
  std::vector<UnresolvedScene> unresolved;

  void add(const Record& record, const BlockLayout& layout);
};

OutcomeCounts count_outcomes(const Database& database);

/// Lines for people, indented by two blanks; at most twenty unresolved scenes are listed.
std::string to_text(const OutcomeCounts& counts);

/// {"scenes", "standing", "collapsed", "arch_collapses", "local_collapses", "unresolved",
/// "unresolved_scenes": [{"scene", "residual"}]}
nlohmann::ordered_json to_json(const OutcomeCounts& counts);

}  // namespace voussoir
