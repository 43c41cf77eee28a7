#pragma once
/// @file How precisely noise levels are gone through.

namespace voussoir {

enum class LevelRule {
  fine,   ///< to 1e-7 of a likelihood that is a bell over the levels
  coarse  ///< to 1e-3: for scenes that hold less than a thousandth of the probability together
};

}  // namespace voussoir
