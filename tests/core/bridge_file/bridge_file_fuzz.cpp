/// @file The reader of bridge files against damaged and made-up inputs. Oracle: it accepts or throws
/// InputError, and what it accepts makes a bridge of finite blocks or is refused with an InputError, too.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "core/structure/loads.h"
#include "core/structure/model.h"
#include "tests/support/fuzzing.h"

using namespace voussoir;

namespace {

constexpr std::size_t kMostBlocksMeshed = 300;  ///< keeps an input at milliseconds

const std::vector<std::string> kNasty = {"nan",
                                         "inf",
                                         "-inf",
                                         "1e308",
                                         "-1e308",
                                         "1e-308",
                                         "0",
                                         "-1",
                                         "1e15",
                                         "1e5",
                                         "0.001",
                                         "0.0010001",
                                         "1000",
                                         "9223372036854775807",
                                         "9223372036854775808",
                                         "-9223372036854775808",
                                         "0x7fffffff",
                                         "0b1",
                                         "1979-05-27T07:32:00Z",
                                         "true",
                                         "\"",
                                         "\"\"\"",
                                         "'",
                                         "[",
                                         "]",
                                         "[[",
                                         "]]",
                                         "[[[[[[[[[[[[[[[[",
                                         "{",
                                         "}",
                                         "{a={a={a=",
                                         "=",
                                         ".",
                                         "a.b.c.d.",
                                         ",",
                                         "#",
                                         "\n",
                                         "\r",
                                         "\\u0000",
                                         "\\UFFFFFFFF",
                                         "\xFF\xFE",
                                         "\xEF\xBB\xBF",
                                         std::string(1, '\0'),
                                         "wall",
                                         "[wall]\n",
                                         "[[spans]]\n",
                                         "[mesh]\n",
                                         "refinement = 5\n",
                                         "courses = 1000\n",
                                         "voussoirs = 1000\n",
                                         "length_m = ",
                                         "spans = []\n",
                                         "smallest_piece_m2 = 1e15\n",
                                         "tolerance_m = 0.1\n",
                                         "centre_y_m = 0\n",
                                         "bond = \"stack\"\n",
                                         "[[loads]]\n",
                                         "steps = 999\n",
                                         "place_m = ",
                                         "points = [{x_m = 1, force_N = 1}]\n"};

bool is_sound(const Model& bridge) {
  for (const Block& block : bridge.layout.blocks)
    if (!(area(block.polygon) > 0.0 && std::isfinite(area(block.polygon)))) return false;
  return bridge.mesh.nodes.allFinite() && bridge.mesh.block_nodes.size() == bridge.layout.size();
}

test::Verdict read(const std::string& text) {
  try {
    const BridgeDescription description = parse_bridge_file(text, "fuzz.toml").description;
    if (lay_blocks(description).size() > kMostBlocksMeshed || description.mesh.refinement > 1)
      return test::Verdict::set_aside;
    const Model bridge = make_model(description);
    if (!is_sound(bridge)) FAIL("accepted an unsound bridge: " << text);
    for (const LoadDescription& load : description.loads)
      for (const LoadStage& stage : load_stages(load, bridge, description.material.thickness))
        if (!stage.force.allFinite()) FAIL("accepted an unsound load: " << text);
    return test::Verdict::accepted;
  } catch (const InputError& error) {
    if (std::string(error.what()).empty()) FAIL("refused without a word: " << text);
    return test::Verdict::refused;
  }
}

test::Tally feed(int inputs, std::uint64_t seed) {
  const std::vector<std::string> good = test::corpus("bridges");
  test::Chance chance(seed);
  return test::feed(inputs, [&] {
    const std::string text = test::damaged_text(good, kNasty, chance);
    INFO(text);
    return read(text);
  });
}

}  // namespace

TEST_CASE("Every bridge file of the corpus makes a bridge", "[fuzz]") {
  for (const std::string& text : test::corpus("bridges"))
    CHECK(is_sound(make_model(parse_bridge_file(text, "corpus").description)));
}

TEST_CASE("Two thousand damaged bridge files make a bridge or are refused", "[fuzz]") {
  const test::Tally tally = feed(2'000, 1);
  CHECK(tally.accepted > 100);
  CHECK(tally.refused > 500);
}

TEST_CASE("Ten minutes or a million damaged bridge files make a bridge or are refused", "[.long][fuzz]") {
  const test::Tally tally = feed(1'000'000, 2);
  WARN(tally.accepted << " made, " << tally.refused << " refused");
  CHECK(tally.accepted > 0);
  CHECK(tally.refused > 0);
}

TEST_CASE("Bridge files that nest without end are refused") {
  const auto repeated = [](const std::string& piece, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += piece;
    return text;
  };
  for (const std::string& text :
       {"a = " + repeated("[", 300'000), "a = " + repeated("{a=", 200'000), repeated("a.", 300'000) + "a = 1",
        "[" + repeated("a.", 300'000) + "a]", "a = " + repeated("[", 2'000), repeated("a.", 2'000) + "a = 1"})
    CHECK_THROWS_AS(parse_bridge_file(text, "deep.toml"), InputError);
}

TEST_CASE(
    "A bridge file with more spans or courses than any bridge has is refused before anything is built") {
  std::string spans;
  for (int i = 0; i < 8'000; ++i)
    spans += "[[spans]]\ncentre_x_m = " + std::to_string(2 * i + 1) +
             "\nintrados_radius_m = 0.5\nring_thickness_m = 0.1\n";
  CHECK_THROWS_WITH(parse_bridge_file("[wall]\nlength_m = 20000\ncourses = 0\n" + spans, "many.toml"),
                    Catch::Contains("blocks: expected at most 20000"));
}
