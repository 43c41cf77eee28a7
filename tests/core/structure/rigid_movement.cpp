/// @file Supports that move. Oracle: rigid motion, by hand.

#include "core/structure/rigid_movement.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("Supports that all move alike move what they hold as a rigid body (by hand)", "[supports]") {
  BridgeDescription description = test::small_description();
  const SupportKind sides = GENERATE(SupportKind::roller, SupportKind::clamped);
  const SupportKind base = GENERATE(SupportKind::roller, SupportKind::clamped);
  description.supports.sides = sides;
  description.supports.base = base;
  const Model bridge = make_model(description);
  Field moved = Field::Zero(2, bridge.mesh.node_count());
  for (std::size_t s = 0; s < bridge.supports.size(); ++s)
    moved += rigid_movement(bridge, s, {1e-3, -2e-3}, 0.0);
  const std::vector<bool> held = held_components(bridge.supports, bridge.mesh);
  int twice_held = 0;
  for (int node = 0; node < bridge.mesh.node_count(); ++node) {
    const auto component = static_cast<std::size_t>(2 * node);
    CHECK(moved(0, node) == (held[component] ? 1e-3 : 0.0));
    CHECK(moved(1, node) == (held[component + 1] ? -2e-3 : 0.0));
    twice_held +=
        std::ranges::count_if(bridge.supports,
                              [&](const Support& support) {
                                return std::ranges::find(support.nodes, NodeId{node}) != support.nodes.end();
                              }) == 2
            ? 1
            : 0;
  }
  CHECK(twice_held >= 2);  // both corners
}
