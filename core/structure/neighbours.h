#pragma once
/// @file Which blocks touch which.

#include <vector>

#include "core/structure/scene.h"
#include "core/structure/structure.h"

namespace voussoir {

/// The blocks that touch one of the scene's missing blocks and are not missing themselves, ascending.
std::vector<BlockId> blocks_beside(const Scene& scene, const Structure& structure);

/// True if the missing blocks are one group: each touches another of the group, or the same block as another
/// does. So it is of a single; what several groups do is known of scenes with fewer missing blocks.
bool is_one_group(const Scene& scene, const Structure& structure);

}  // namespace voussoir
