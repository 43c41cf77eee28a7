#pragma once
/// @file What each skip of a build gains and changes.

#include <span>
#include <string>
#include <vector>

#include "core/bridge_file/bridge_file.h"

namespace voussoir {

struct SkipRow {
  std::string name;
  double seconds_with = 0.0;  ///< of processor time a scene
  double seconds_without = 0.0;
  double largest_change = 0.0;  ///< of a control displacement, over all scenes [m]
  double stated_change = 0.0;   ///< its bound [m]
  std::size_t other_outcomes = 0;
};

/// The largest change of a displacement. NaN (a block that is gone) has to be NaN in both: a number beside a
/// NaN is an infinite change.
double largest_change(std::span<const double> with, std::span<const double> without);

/// Builds the database of some scenes (as --scenes takes them), of a bridge taken as known, without each
/// skip, and with all of them before each: processors are not always as fast.
std::vector<SkipRow> measure_skips(const BridgeFile& bridge, const std::string& scenes);

/// As a table in Markdown.
std::string to_markdown(const std::vector<SkipRow>& rows);

}  // namespace voussoir
