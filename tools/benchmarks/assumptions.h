#pragma once
/// @file What databases say of an intact bridge that is built otherwise than their files say.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace voussoir {

struct AssumptionOptions {
  std::vector<std::string> bridges;              ///< files: the bridge as it may be in truth
  std::vector<std::filesystem::path> databases;  ///< asked one by one and, if several, together
  double sigma = 1e-5;                           ///< [m] of a change, or of an absolute reading
  int questions = 4;                             ///< of each kind, each with errors of its own
  std::uint64_t seed = 1;                        ///< of the errors
  double shift = 0.0;  ///< [m] by which the bridges lie further right than the databases'
};

/// What came of some questions. Nothing is missing, so every block that is named is there.
struct AssumptionCounts {
  int asked = 0;
  int damaged = 0;  ///< called so: located or damaged-unlocated
  int named = 0;    ///< located
  int cannot_tell = 0;
  int unexplained = 0;
};

/// One bridge, asked of a database or of all together.
struct AssumptionRow {
  std::string bridge;      ///< file
  std::string database;    ///< file, or "together"
  std::size_t points = 0;  ///< that were read
  AssumptionCounts changes{}, absolute{};
  std::vector<std::string> alarms{};  ///< what happened to the bridge where changes were called damage
};

using AssumptionRowsDone = std::function<void(const std::vector<AssumptionRow>&)>;

/// The bridges are solved nonlinearly with their own joints and stone: at rest, and after they became warmer
/// or cooler, a foot settled or joints softened. Readings are of those control
/// points of the bridge that are where the databases have theirs. `done` is told of each bridge. Throws
/// InputError for bridges without such points, Failure for one that does not stand.
std::vector<AssumptionRow> measure_assumptions(const AssumptionOptions& options,
                                               const AssumptionRowsDone& done);

/// A table (Markdown) of them.
std::string to_markdown(const std::vector<AssumptionRow>& rows);

}  // namespace voussoir
