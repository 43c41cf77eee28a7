#include "core/structure/scene.h"

#include <catch2/catch.hpp>

#include "core/error.h"

using namespace voussoir;
using Catch::Matchers::Contains;

TEST_CASE("Scenes read back what they write", "[scene]") {
  const BlockLayout layout = lay_blocks({});
  for (const Scene& scene : all_scenes(layout.size(), 1))
    CHECK(parse_scene(to_string(scene, layout), layout) == scene);
  CHECK(to_string(parse_scene(" 10,4 + 6,4 ", layout), layout) == "6,4+10,4");
  CHECK(to_string(parse_scene("intact", layout), layout) == "intact");
}

TEST_CASE("The number of scenes is the sum of binomial coefficients", "[scene]") {
  CHECK(all_scenes(212, 2).size() == 1 + 212 + 212 * 211 / 2);
  CHECK(all_scenes(5, 3).size() == 1 + 5 + 10 + 10);
}

TEST_CASE("A scene that names no block, an unknown one or one twice is refused with the reason", "[scene]") {
  const BlockLayout layout = lay_blocks({});
  CHECK_THROWS_WITH(parse_scene("ten", layout), Contains("'ten'") && Contains("expected COURSE,POSITION"));
  CHECK_THROWS_WITH(parse_scene("10,40", layout),
                    Contains("no block 10,40: course 10 has positions 1 to 20"));
  CHECK_THROWS_WITH(parse_scene("13,1", layout), Contains("no course 13"));
  CHECK_THROWS_WITH(parse_scene("10,4+10,4", layout), Contains("twice"));
  for (const char* text : {"", "+", "10,4+", "10,4,1", "-1,2", "10;4", "1e1,4", "99999999999,1"})
    CHECK_THROWS_AS(parse_scene(text, layout), InputError);
}
