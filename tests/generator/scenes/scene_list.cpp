#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "generator/scenes/scene_list.h"

namespace voussoir {
namespace {

BlockLayout reference_layout() {
  static const BlockLayout layout = lay_blocks(BridgeDescription{});
  return layout;
}

std::vector<std::string> names(std::string_view list) {
  std::vector<std::string> texts;
  for (const Scene& scene : parse_scene_list(list, reference_layout()))
    texts.push_back(to_string(scene, reference_layout()));
  return texts;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("The lists all, singles and pairs have the counts of combinatorics", "[many-solutions]") {
  CHECK(names("intact").size() == 1);
  CHECK(names("singles").size() == 1 + 212);
  CHECK(names("pairs").size() == 212 * 211 / 2);
  CHECK(names("all").size() == 1 + 212 + 212 * 211 / 2);
  CHECK(parse_scene_list("all", reference_layout()) == all_scenes(212, 2));
  CHECK(parse_scene_list("pairs;singles", reference_layout()) == all_scenes(212, 2));
}

TEST_CASE("Scenes come in the order of the database and each once") {
  CHECK(names("10,4+6,4; 10,4 ;intact;10,4;6,4+10,4") == Names{"intact", "10,4", "6,4+10,4"});
}

TEST_CASE("A range stands for each of its scenes") {
  CHECK(names("10,1..3") == Names{"10,1", "10,2", "10,3"});
  CHECK(names("0,*").size() == 19);
  CHECK(names("*,*").size() == 212);
  CHECK(names("11..12,2") == Names{"11,2", "12,2"});
  CHECK(names("10,4+2..4,1") == Names{"2,1+10,4", "3,1+10,4", "4,1+10,4"});
}

TEST_CASE("A range with itself gives each pair once and no block twice") {
  CHECK(names("10,1..3+10,1..3") == Names{"10,1+10,2", "10,1+10,3", "10,2+10,3"});
}

TEST_CASE("A list without any scene is refused") {
  BlockLayout one;
  one.blocks.resize(1);
  one.blocks.front().label = "a";
  CHECK(parse_scene_list("all", one).size() == 2);
  CHECK_THROWS_WITH(parse_scene_list("pairs", one),
                    Catch::Matchers::Contains("'pairs' names no scene of this bridge"));
}

TEST_CASE("A bad list is refused with the item and what was expected") {
  for (const char* bad : {"", ";", "intact;;10,4", "many", "10", "10,4,2", "10,x", "10,1..", "10,..3",
                          "10,1...3", "-1,2..3", "10,1..3+", "10,9999999999999..3", "*"})
    CHECK_THROWS_AS(parse_scene_list(bad, reference_layout()), InputError);
  CHECK_THROWS_WITH(parse_scene_list("10,4;13,1..9", reference_layout()),
                    Catch::Contains("'13,1..9' names no block"));
  CHECK_THROWS_WITH(parse_scene_list("10,5..4", reference_layout()), Catch::Contains("names no block"));
  CHECK_THROWS_WITH(parse_scene_list("*,*+*,*+*,*+*,*", reference_layout()),
                    Catch::Contains("more than 1000000"));
}

}  // namespace voussoir
