#pragma once
/// @file Making the true bridges of trials: drawn at random, solved nonlinearly.

#include <filesystem>

#include "core/bridge_file/bridge_file.h"
#include "core/structure/uncertainty.h"
#include "tools/trials/study.h"

namespace voussoir {

/// Bridges to draw.
struct SampledTruth {
  std::string name;
  Uncertainty uncertainty;  ///< that they are drawn from
  int bridges = 20;
  std::uint64_t seed = 1;
  std::string load{};  ///< a stage of a load case whose effect is solved for, too; none if empty
};

/// Nothing is uncertain but every joint's own stiffness, with these coefficients of variation: of the joint
/// alone, and alike in joints that are near each other.
Uncertainty scattered_joints(double scatter, double regional = 0.0);

/// Solves scenes of the bridges (as parse_scene_list reads them) into a database of that name in the folder,
/// unless it is there and up to date; as built and as lost, without fields.
DamagedTruth solve_damaged(const BridgeFile& bridge, const SampledTruth& truth, const std::string& scenes,
                           const std::filesystem::path& folder);

/// What happens to an intact bridge between two epochs.
struct Between {
  double warmer = 0.0;           ///< [K] the blocks
  double warmer_part = 1.0;      ///< in this share of the bridge's length, from the left
  double settlement = 0.0;       ///< [m] of the first foot
  double joint_stiffness = 1.0;  ///< share of it that joints keep,
  double softened_part = 1.0;    ///< those in this share of the bridge's length, from the left
  bool at_random = false;        ///< instead, each epoch has its own temperature, movements and stiffness of
                                 ///< joints, as uncertain and as uneven as they are
};

/// Solves the intact bridges at two times, the second from the state of the first. Bridges that do not bear
/// the load are left out. Throws Failure if one does not stand.
IntactTruth solve_intact(const BridgeDescription& bridge, const SampledTruth& truth, const Between& between);

/// Solves bridges that lose each of these blocks, or one of `every` so many, between the two times: in the
/// first epoch, which the intact bridge has entered, the block goes, and what is left enters the second. As
/// built it was missing from the start, and the second epoch alone was entered. Losses after which something
/// falls, and bridges and scenes that do not bear the load, are left out. Throws Failure if an intact bridge
/// does not stand.
DamagedTruth solve_lost_between(const BridgeDescription& bridge, const SampledTruth& truth,
                                const Between& between, const std::vector<BlockId>& blocks,
                                std::size_t every = 1);

/// All blocks of the wall: losses of the arch's make it collapse.
std::vector<BlockId> wall_blocks(const BlockLayout& layout);

/// The intact bridge and all singles of the wall, as parse_scene_list reads them.
std::string wall_singles(const BlockLayout& layout);

/// The same with so many random pairs of wall blocks in the place of singles. Throws InputError if there are
/// fewer.
std::string random_pairs(const BlockLayout& layout, int count, std::uint64_t seed);

}  // namespace voussoir
