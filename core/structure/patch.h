#pragma once
/// @file The part of a bridge near some blocks, as a bridge of its own.

#include <vector>

#include "core/structure/model.h"
#include "core/structure/scene.h"

namespace voussoir {

/// Some blocks of a bridge with what lies between them. Those that touch what was left out are its rim, which
/// a support holds, so that it can be moved as in the bridge.
struct Patch {
  Model model;                  ///< without control points and symmetry
  std::vector<BlockId> blocks;  ///< in the bridge, ascending: block k of the patch is blocks[k]
  std::vector<NodeId> nodes;    ///< likewise
  std::vector<BlockId> rim;     ///< in the patch, ascending
  int blocks_of_bridge = 0;

  double share_of_blocks() const { return static_cast<double>(blocks.size()) / blocks_of_bridge; }

  Scene scene_of(const Scene& bridge) const;  ///< without missing blocks outside the patch
  Field field_of(const Field& bridge) const;
};

/// The blocks within so many neighbours of a scene's missing blocks, and a rim beside them.
Patch patch_around(const Scene& scene, int neighbours, const Model& bridge);

}  // namespace voussoir
