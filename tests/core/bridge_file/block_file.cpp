/// @file Files of blocks. Oracle: files written here, and damaged ones.

#include "core/bridge_file/block_file.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/bridge_file/bridge_file.h"
#include "core/bridge_file/dxf_blocks.h"
#include "core/error.h"
#include "core/structure/assembly_check.h"
#include "core/structure/model.h"
#include "core/text_file.h"
#include "tests/support/bridges.h"
#include "tests/support/dxf_drawing.h"
#include "tests/support/fuzzing.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

/// A bridge as JSON, with every digit.
std::string to_json(const BlockLayout& layout) {
  std::string text = "{\"blocks\": [";
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const Block& block = layout.blocks[i];
    text += fmt::format("{}{{\"label\": \"{}\", \"role\": \"{}\", ", i > 0 ? ",\n" : "", block.label,
                        name_of(block.role));
    if (block.role == BlockRole::ring) text += fmt::format("\"ring\": {}, ", block.ring);
    text += "\"vertices\": [";
    for (std::size_t c = 0; c < block.polygon.size(); ++c)
      text += fmt::format("{}[{}, {}]", c > 0 ? ", " : "", block.polygon[c].x(), block.polygon[c].y());
    text += "]}";
  }
  return text + "]}";
}

std::string to_dxf(const BlockLayout& layout) {
  std::string entities;
  for (const Block& block : layout.blocks) {
    const std::string layer = block.role == BlockRole::ring ? fmt::format("Ring {}", block.ring + 1) : "WALL";
    entities += test::lwpolyline(layer, block.polygon);
    const Point p = centroid(block.polygon);
    entities += fmt::format("0\nTEXT\n8\nlabels\n10\n{}\n20\n{}\n1\n{}\n", p.x(), p.y(), block.label);
  }
  return test::dxf_drawing(entities);
}

/// Read and checked, or refused in words.
test::Verdict read_and_check(const std::string& text) {
  try {
    BlockFile file = text.front() == '{' ? parse_json_blocks(text, "f") : parse_dxf_blocks(text, "f");
    heal_and_check(file.blocks, {});
    for (const Block& block : file.blocks)
      if (!(area(block.polygon) > 0.0 && std::isfinite(area(block.polygon))))
        FAIL("accepted an unsound block");
    return test::Verdict::accepted;
  } catch (const InputError& error) {
    if (std::string(error.what()).empty()) FAIL("refused without a word");
    return test::Verdict::refused;
  }
}

double length_of_joints(const Model& model) {
  double sum = 0.0;
  for (const Joint& joint : model.joints) sum += joint.length;
  return sum;
}

std::vector<std::string> good_files() {
  const BlockLayout layout = lay_blocks(test::small_description());
  return {to_json(layout), to_dxf(layout),
          test::dxf_drawing(test::lwpolyline("ring", test::kSquare), "9\n$INSUNITS\n70\n4\n")};
}

}  // namespace

TEST_CASE("Of a JSON survey every key is known: a unit beside the blocks is none", "[block-file]") {
  const std::string blocks = "\"blocks\": [{\"vertices\": [[0, 0], [1, 0], [1, 1]]}]";
  CHECK(parse_json_blocks("{" + blocks + "}", "s.json").blocks.size() == 1);
  CHECK_THROWS_WITH(parse_json_blocks("{" + blocks + ", \"unit\": \"mm\"}", "s.json"),
                    Catch::Contains("s.json: unknown key 'unit'") && Catch::Contains("in metres"));
}

TEST_CASE("Bad JSON of blocks is refused with file, place and what was expected", "[block-file]") {
  const auto json = [](const std::string& text) {
    return test::refusal_of([&] { parse_json_blocks(text, "a.json"); });
  };
  CHECK_THAT(json("{"), Contains("a.json") && Contains("is no JSON"));
  CHECK_THAT(json("{\"blocks\": []}"), Contains("expected {\"blocks\""));
  CHECK_THAT(json("{\"blocks\": [{}]}"), Contains("a.json: block 1: expected \"vertices\""));
  CHECK_THAT(json("{\"blocks\": [{\"vertices\": [[0, 0], [1]]}]}"), Contains("block 1: vertex 2"));
  CHECK_THAT(json("{\"blocks\": [{\"vertices\": [[0, 1e9]]}]}"), Contains("at most 100000 m"));
  CHECK_THAT(json("{\"blocks\": [{\"role\": \"roof\"}]}"), Contains("role: expected one of wall, ring"));
  CHECK_THAT(json("{\"blocks\": [{\"colour\": 1}]}"), Contains("unknown key 'colour'"));
  CHECK_THAT(json("{\"blocks\": [{\"role\": \"ring\", \"ring\": -1}]}"),
             Contains("ring: expected a whole number"));
  CHECK_THAT(json(std::string(1'000'000, '[')), Contains("is no JSON"));
}

TEST_CASE("A bridge written as JSON or DXF and read again is the same bridge", "[block-file]") {
  const Model laid = make_model(test::small_description());
  const test::TemporaryFolder folder;
  for (const auto& [name, text] :
       {std::pair("b.json", to_json(laid.layout)), std::pair("b.dxf", to_dxf(laid.layout))}) {
    write_file(folder / name, text);
    write_file(folder / "b.toml",
               fmt::format("name = \"read\"\nblocks = \"{}\"  # the survey\ngravity_m_s2 = 9.81\n", name));
    const BridgeFile file = read_bridge_file(folder / "b.toml");
    INFO(name);
    const Model read = make_model(file.description);
    REQUIRE(read.block_count() == laid.block_count());
    for (std::size_t b = 0; b < laid.layout.size(); ++b) {
      CHECK(read.layout.blocks[b].label == laid.layout.blocks[b].label);
      CHECK(read.layout.blocks[b].role == laid.layout.blocks[b].role);
      const Polygon &found = read.layout.blocks[b].polygon, &expected = laid.layout.blocks[b].polygon;
      REQUIRE(found.size() == expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) CHECK((found[i] - expected[i]).norm() < 1e-12);
    }
    CHECK(length_of_joints(read) == Approx(length_of_joints(laid)).epsilon(1e-9));
    CHECK(read.symmetry.has_value());
    CHECK(read.supports.size() == laid.supports.size());
    CHECK(read.control_points.size() == laid.control_points.size());
    // The text stands by itself: what a database keeps needs no other file.
    const Model stored = make_model(parse_bridge_file(file.text, "database").description);
    CHECK(stored.mesh.nodes == read.mesh.nodes);
    CHECK_THAT(file.text, Contains("gravity_m_s2") && Contains("the blocks of \"" + std::string(name)));
  }
}

TEST_CASE("A file of blocks in millimetres is refused by its name (the small bridge, scaled)",
          "[block-file]") {
  BlockLayout layout = lay_blocks(test::small_description());
  for (Block& block : layout.blocks)
    for (Point& p : block.polygon) p *= 1000.0;
  const test::TemporaryFolder folder;
  for (const auto& [name, text] :
       {std::pair("b.json", to_json(layout)), std::pair("b.dxf", to_dxf(layout))}) {
    write_file(folder / name, text);
    CHECK_THROWS_WITH(read_block_file(folder / name),
                      Contains((folder / name).string() + ": the bridge is 6000 m long") &&
                          Contains("are these millimetres? expected metres"));
  }
}

TEST_CASE("Messages name the lines of the bridge file, however many its file of blocks has (written out)",
          "[block-file]") {
  const test::TemporaryFolder folder;
  write_file(folder / "b.json", to_json(lay_blocks(test::small_description())));
  const auto refusal = [&](const std::string& text) {
    write_file(folder / "b.toml", text);
    try {
      read_bridge_file(folder / "b.toml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string file = (folder / "b.toml").string();
  CHECK_THAT(refusal("blocks = \"b.json\"\n[wall]\ncourses = 3\n"),
             Contains(file + ":2: wall: expected it, or blocks, not both"));
  CHECK_THAT(refusal("name = \"b\"\nblocks = \"b.json\"\ncolour = 1\n"),
             Contains(file + ":3: unknown key 'colour'"));
  CHECK_THAT(refusal("\nblocks = \"b.json\"\n[material]\n\npoisson_ratio = 1\n"),
             Contains(file + ":5: poisson_ratio in [material]"));
  write_file(folder / "b.json",
             "{\"blocks\": [{\"label\": \"a b\", \"vertices\": [[0, 0], [1, 0], [1, 1]]}]}");
  CHECK_THAT(refusal("\nblocks = \"b.json\"\n"), Contains(file + ":2: blocks: label 'a b'"));
  write_file(folder / "b.json", "{\"blocks\": [{\"vertices\": [[0, 0], [1, 0]]}]}");
  CHECK_THAT(refusal("\nblocks = \"b.json\"\n"), Contains("b.json: block 1: 2 vertices: expected 3 to 200"));
}

TEST_CASE("The name of a file of blocks stands on one line", "[block-file]") {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "b.toml") << "name = \"x\"\nblocks = \"\"\"\nb.json\"\"\"\n";
  CHECK_THROWS_WITH(read_bridge_file(folder / "b.toml"),
                    Catch::Matchers::Contains("b.toml:2: blocks: stands on several lines"));
}

TEST_CASE("A text that names a file of blocks opens none: it may come out of a stranger's database",
          "[block-file]") {
  CHECK_THROWS_WITH(parse_bridge_file("blocks = \"/etc/passwd\"\n", "stored"), Contains("stored:1:"));
  CHECK_THROWS_WITH(
      parse_bridge_file(
          "blocks = [{label = \"a\", vertices = [[0, 0], [1, 0], [1, 1]]}]\n[wall]\ncourses = 3\n", "b.toml"),
      Contains("b.toml:") && Contains("not both"));
}

TEST_CASE("Four thousand damaged files of blocks are read or refused", "[block-file][fuzz]") {
  const std::vector<std::string> nasty = {"nan",
                                          "1e308",
                                          "-1",
                                          "2147483648",
                                          "0\nLWPOLYLINE\n",
                                          "0\nVERTEX\n",
                                          "42\n1e300\n",
                                          "[",
                                          "]",
                                          "{",
                                          "}",
                                          "\"",
                                          ",",
                                          "70\n-1\n",
                                          "\xFF",
                                          "\r\n",
                                          "null",
                                          "1e-320",
                                          "90\n99999999\n",
                                          "\\u0000",
                                          "true"};
  const std::vector<std::string> good = good_files();
  test::Chance chance(5);
  const test::Tally tally =
      test::feed(4'000, [&] { return read_and_check(test::damaged_text(good, nasty, chance)); });
  CHECK(tally.accepted > 200);
  CHECK(tally.refused > 500);
}
