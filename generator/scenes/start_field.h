#pragma once
/// @file Where the search for a scene's equilibrium starts.

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/statics/solution.h"
#include "core/structure/scene.h"

namespace voussoir {

/// What the starts of a scene are made of: the intact bridge; of a scene with several missing blocks the
/// singles within it, too, and of one with more than two also the pairs within it. In the order of rows.
std::vector<Scene> starting_subsets(const Scene& scene);

/// Solved fields of the intact bridge, singles and pairs, in storage precision, that other scenes start from.
/// Starts depend on these fields and the scene's own only, so every build of a scene starts from the same
/// numbers whatever was computed before it. They are zero wherever a field has no displacement.
class StartingFields {
 public:
  /// Takes in a state of the intact bridge, a single or a pair; scenes with more missing blocks are ignored.
  /// Not thread-safe.
  void add(const Scene& scene, std::size_t state, const Solution& solution);

  /// The start for a state of a scene of which nothing is known: nothing (zero) for the intact bridge, the
  /// intact field for a single, and for a scene with more missing blocks the sum of what each of its blocks
  /// changes when it alone is missing,
  ///     d = d_intact + sum_i (d_i - d_intact)   over the singles i that stand,
  /// with more than two and what each two change beyond that,
  ///     + sum_ij (d_ij - d_i - d_j + d_intact)   over the pairs ij that stand with both of their singles,
  /// and nothing for any scene if the intact bridge does not stand.
  std::optional<Field> start_for(const Scene& scene, std::size_t state = 0) const;

  /// The plastic slip that a scene's search as built begins with, 2 x joints: what the intact bridge, the
  /// singles and the pairs within it began with (Solution::slipped), summed up as in start_for. Empty: none.
  Eigen::Matrix2Xd slipped_for(const Scene& scene) const;

  /// The start for state `after` of a scene that stands in state `before` with the field `own`: with c the
  /// change from `before` to `after`,
  ///     d = own + c_intact + sum_i (c_i - c_intact)   over the singles i, other than the scene, that stand
  ///     in
  /// both. Where the intact bridge does not stand in both: `own`.
  Field start_after(const Scene& scene, const Field& own, std::size_t before, std::size_t after) const;

  /// Does the intact bridge, one of the singles, or with more than two missing blocks one of the pairs,
  /// within the scene let blocks fall that this scene has?
  bool falls_likely(const Scene& scene, std::size_t state) const;

  /// Of a pair that falls_likely: does only one of its blocks, missing alone, let anything fall, while the
  /// bridge stands intact and without the other?
  bool falls_by_one(const Scene& scene, std::size_t state) const;

  /// Has the intact bridge, one of the singles, or with more than two missing blocks one of the pairs, within
  /// the scene no answer?
  bool open_likely(const Scene& scene, std::size_t state) const;

  /// The singles and pairs that fall in a state, in the order of rows, and which of their blocks move.
  std::vector<std::pair<Scene, std::vector<BlockId>>> falling(std::size_t state) const;

  /// Is a pair among the scenes, so that scenes with more missing blocks start here?
  bool has_pairs() const;

  /// The field of the intact bridge in a state, if it stands.
  const Field* intact(std::size_t state) const { return find(Scene{}, state); }

  /// The field of the intact bridge, a single or a pair in a state, if it is there and stands.
  const Field* find(const Scene& scene, std::size_t state) const;

  /// What had slipped before the intact bridge, a single or a pair stood as built; empty: nothing, or it does
  /// not stand.
  Eigen::Matrix2Xd slipped(const Scene& scene) const;

  /// The singles that stand in a state, in ascending order.
  std::vector<Scene> standing_singles(std::size_t state) const;

 private:
  /// The blocks that move in a single or pair that falls in a state; null for others.
  const std::vector<BlockId>* find_falling(const Scene& scene, std::size_t state) const;
  std::optional<Field> change(const Scene& scene, std::size_t before, std::size_t after) const;

  using Place = std::pair<Scene, std::size_t>;     ///< scene and state
  std::map<Place, Field> standing_;                ///< fields
  std::map<Scene, Eigen::Matrix2Xd> slipped_;      ///< of those as built that began with some
  std::map<Place, std::vector<BlockId>> falling_;  ///< which blocks move
  std::set<Place> open_;                           ///< no answer
};

}  // namespace voussoir
