#pragma once
/// @file A scene's motion early on, put together from those of its missing blocks, each missing alone: while
/// little of gravity acts, what two blocks' absence changes adds up.

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/motion/motion.h"
#include "core/structure/scene.h"

namespace voussoir {

/// What a lane holds of its scene's motion at one moment; contacts are looked for anew.
struct MotionSnapshot {
  std::vector<double> nodes;   ///< for each node deformation [m], its rate [m/s], last movement [m]: x and y
  std::vector<double> frames;  ///< for each block BlockFrame's numbers; the rotation of one that is put
                               ///< together is a vector near a unit one (no angles: libraries round their
                               ///< functions differently, and databases are the same whatever the processor)
  std::map<EdgePair, std::pair<double, double>> shear;  ///< ContactShear, where there is some [m]
};

template <class T>
MotionSnapshot take_snapshot(const Motion<T>& motion, int lane_index);

/// With s_0 of the intact bridge and s_i of its singles: s_0 + sum_i (s_i - s_0), number by number.
MotionSnapshot superposed(const MotionSnapshot& intact, std::span<const MotionSnapshot* const> singles);

/// Puts a scene as a snapshot has it into a lane; `margin` is search_margin.
template <class T>
void place_snapshot(const MotionModel& model, const std::vector<bool>& removed,
                    const MotionSnapshot& snapshot, double margin, int lane_index, Motion<T>& motion);

/// Snapshots of the intact bridge and its singles at one moment.
class EarlyMotions {
 public:
  /// Those scenes of which there is no snapshot yet, of all that the motions of these are put together from.
  std::vector<Scene> lacking(std::span<const Scene> scenes) const;
  void add(std::span<const Scene> scenes, std::vector<MotionSnapshot> snapshots);

  /// Precondition: nothing is lacking.
  MotionSnapshot of(const Scene& scene) const;

 private:
  std::map<Scene, MotionSnapshot> snapshots_;
};

/// About how much memory the snapshots of a bridge and all its singles take [bytes].
std::size_t memory_of_early_motions(const MotionModel& model);

}  // namespace voussoir
