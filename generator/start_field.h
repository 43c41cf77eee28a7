#pragma once
/// @file Where the search for a scene's equilibrium starts.

#include <map>
#include <optional>

#include "core/statics/solution.h"
#include "core/structure/scene.h"

namespace voussoir {

/// Solved fields, in storage precision, that other scenes start from.
class StartingFields {
 public:
  /// Takes in the intact bridge or a single if it stands; anything else is ignored. Not thread-safe.
  void add(const Scene& scene, Outcome outcome, const Field& displacement);

  /// The start for a scene: nothing (zero) for the intact bridge, the intact field for a single, and for a
  /// scene with more missing blocks the sum of what each of its blocks changes when it alone is missing,
  ///     d = d_intact + sum_i (d_i - d_intact)   over the singles i that stand,
  /// with zero wherever a field has no displacement, and nothing for any scene if the intact bridge does not
  /// stand. It depends on these fields only, so every build of a scene starts from the same numbers whatever
  /// was computed before it.
  std::optional<Field> start_for(const Scene& scene) const;

 private:
  std::optional<Field> intact_;
  std::map<Scene, Field> standing_singles_;
};

}  // namespace voussoir
