/// @file Random bridges' files say what was drawn.

#include "tools/validation/random_bridge.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"

using namespace voussoir;

TEST_CASE("A random bridge's file is read as the bridge that was drawn", "[random_bridge]") {
  for (const std::uint64_t seed : {1U, 3U, 1059U}) {
    const BridgeDescription drawn = random_bridge(seed);
    const BridgeDescription read = parse_bridge_file(bridge_file_text(drawn), "random.toml").description;
    INFO("seed " << seed);
    CHECK(read.name == drawn.name);
    CHECK(read.collapse_fields == drawn.collapse_fields);
    CHECK(read.wall.length == drawn.wall.length);
    CHECK(read.wall.courses == drawn.wall.courses);
    CHECK(read.wall.course_height == drawn.wall.course_height);
    CHECK(read.wall.block_length == drawn.wall.block_length);
    CHECK(read.wall.bond == drawn.wall.bond);
    CHECK(read.wall.smallest_block == drawn.wall.smallest_block);
    CHECK(read.material.young_modulus == drawn.material.young_modulus);
    CHECK(read.joints.normal_stiffness == drawn.joints.normal_stiffness);
    CHECK(read.joints.tangential_stiffness == drawn.joints.tangential_stiffness);
    CHECK(read.joints.friction_angle == Approx(drawn.joints.friction_angle).epsilon(1e-15));  // via degrees
    REQUIRE(read.spans.size() == drawn.spans.size());
    for (std::size_t i = 0; i < drawn.spans.size(); ++i) {
      CHECK(read.spans[i].centre_x == drawn.spans[i].centre_x);
      CHECK(read.spans[i].centre_y == drawn.spans[i].centre_y);
      CHECK(read.spans[i].intrados_radius == drawn.spans[i].intrados_radius);
      CHECK(read.spans[i].ring_thickness == drawn.spans[i].ring_thickness);
      CHECK(read.spans[i].voussoirs == drawn.spans[i].voussoirs);
    }
  }
}
