#pragma once
/// @file How many scenes of a database, of all variants, stand, collapse, or have no outcome in each state,
/// and which these last are.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

struct UnresolvedScene {
  std::string scene;
  double residual = 0.0;  ///< as in Solution
};

/// Of one state.
struct StateOutcomes {
  std::string state;  ///< its name
  std::size_t standing = 0;
  std::size_t collapsed = 0;
  std::size_t arch_collapses = 0;   ///< of the collapsed: blocks of the arch move away
  std::size_t local_collapses = 0;  ///< of the collapsed: wall blocks only move away
  std::size_t composed = 0;         ///< of all: with this origin
  std::size_t inherited = 0;        ///< and with this one
  std::vector<UnresolvedScene> unresolved;
  std::optional<Outcome> intact;  ///< of the intact nominal bridge, if it is among the scenes
  bool by_slip = false;           ///< that one stands only by what its joints have slid
};

struct OutcomeCounts {
  OutcomeCounts() = default;
  explicit OutcomeCounts(const std::vector<std::string>& state_names);

  std::size_t scenes = 0;
  std::vector<StateOutcomes> states;  ///< as in the database

  /// Precondition: the record has these states.
  void add(const Record& record, const BlockLayout& layout);
};

OutcomeCounts count_outcomes(const Database& database);

/// Lines for people, indented by two blanks; at most twenty unresolved scenes of a history are listed.
/// States are named if there are several; those with loads have a line each. An intact bridge that does not
/// stand is said, as a bridge file is more often wrong than a bridge, and so is one that stands only by what
/// its joints have slid.
std::string to_text(const OutcomeCounts& counts);

/// A line more for a database without fields of what falls; nothing otherwise.
std::string collapses_text(bool keeps_fields);

/// {"scenes", "standing", "collapsed", "arch_collapses", "local_collapses", "composed",
/// "inherited", "unresolved", "unresolved_scenes": [{"scene", "residual"}], "intact": its outcome or null,
/// "stands_by_slip"} of the first state, and "states":
/// [{"state", the same}] of all.
nlohmann::ordered_json to_json(const OutcomeCounts& counts);

}  // namespace voussoir
