#pragma once
/// @file In how many implicit steps a scene loses its blocks.

#include <set>

#include "core/structure/control_point.h"
#include "core/structure/scene.h"
#include "core/structure/structure.h"

namespace voussoir {

/// Steps of a scene with several missing blocks, one of which needs many when it goes alone: of 60 random
/// pairs of the reference bridge 12 are off by more than 1 % of the signal in one step, all with such a
/// block, and none in eight (docs/numerics.md). A single takes kStepsOfLoss.
inline constexpr int kStepsOfSeveral = 8;

/// Signals that differ by less, L1 over some points over the better signal's, are taken for one [-].
inline constexpr double kSameSignal = 0.01;

/// Many steps are needed where a joint slips while the blocks go and stops. Blocks for which that is so when
/// they go alone are known by solving their singles in one step, too: by their signals along the top, so that
/// records are the same whatever is measured.
class StepsOfLoss {
 public:
  /// This block's signal in one step is another than in kStepsOfLoss, or it needs a jump.
  void add(BlockId block) { needing_many_.insert(block); }

  /// Implicit steps in which the scene's blocks go.
  int of(const Scene& scene) const;

 private:
  std::set<BlockId> needing_many_;
};

/// The upper corners of the top course's blocks, without one all other usual points: signals there decide.
std::vector<ControlPoint> deciding_points(const Structure& structure);

/// Do the signals of these fields, less that of the intact bridge, differ by more than kSameSignal?
bool differ_in_signal(const Field& one_step, const Field& many_steps, const Field& intact,
                      const std::vector<ControlPoint>& points);

}  // namespace voussoir
