#pragma once
/// @file How fast random plausible bridges are solved beside the reference bridge.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace voussoir {

struct BridgeOptions {
  int bridges = 10;
  std::uint64_t seed = 1;
  int scenes = 40;        ///< singles drawn of each bridge, with the intact bridge; 0: all singles
  int most_followed = 0;  ///< blocks of bridges whose scenes are followed in plain explicit motion, too
};

/// What a bridge's scenes took, in processor time of one thread.
struct BridgeRow {
  std::string name;
  int blocks = 0;
  int scenes = 0;
  int standing = 0, collapsed = 0, unresolved = 0;
  double intact = 0.0;   ///< [s] of the intact bridge, without making the solver
  double singles = 0.0;  ///< [s] of the other scenes
  double beside = 0.0;   ///< [s] a scene and block of the reference bridge, measured last before
  double worst = 0.0;    ///< [s] of one scene, solved alone
  std::string worst_scene{};
  std::vector<std::string> unresolved_scenes{};
  int followed = 0;  ///< scenes in plain explicit motion: central differences of all nodes, until they rest
                     ///< or blocks are far away
  std::vector<std::string> otherwise{};  ///< those of them that end otherwise there

  /// [s] of a scene of a build with all singles, of which those drawn stand for all, and the intact bridge is
  /// one.
  double per_scene() const {
    const double of_singles = scenes > 1 ? singles / (scenes - 1) : 0.0;
    return (intact + blocks * of_singles) / (blocks + 1);
  }
  double per_scene_and_block() const { return per_scene() / blocks; }
  double times_the_reference() const { return per_scene_and_block() / beside; }
};

/// The reference bridge first, and again before every fifth bridge: processors are not always as fast. Scenes
/// are solved as build-database solves them, four side by side; `progress` is told each row.
std::vector<BridgeRow> measure_bridges(const BridgeOptions& options,
                                       const std::function<void(const BridgeRow&)>& progress);

/// A table (Markdown), times a scene and block as multiples of the reference's, and a line that sums it up.
std::string to_markdown(const std::vector<BridgeRow>& rows);

}  // namespace voussoir
