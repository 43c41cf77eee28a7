/// Files of cases.

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <fstream>

#include "core/error.h"
#include "core/structure/scene.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"
#include "tools/trials/paper_cases.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

/// "SCENE NOISE %: what the paper found", with the blocks in the order of the database.
std::vector<std::string> texts(const std::vector<PaperCase>& cases) {
  const BlockLayout layout = lay_blocks({});
  std::vector<std::string> lines;
  for (const PaperCase& each : cases)
    lines.push_back(fmt::format("{} {:g} %: {}", to_string(parse_scene(each.scene, layout), layout),
                                100.0 * each.noise, each.paper));
  return lines;
}

}  // namespace

TEST_CASE("The paper's cases are those printed in its Tables 2 and 3") {
  const PaperCases cases = read_paper_cases(paper_cases_file());
  CHECK(texts(cases.one_block) == std::vector<std::string>{"0,15 10 %: 8", "6,4 5 %: 9", "6,4 10 %: -",
                                                           "2,6 5 %: 27", "2,6 10 %: 65", "4,10 5 %: 35",
                                                           "4,10 10 %: -", "8,12 5 %: 127", "8,12 10 %: -",
                                                           "10,4 10 %: 67", "10,12 10 %: 32"});
  CHECK(texts(cases.two_blocks) ==
        std::vector<std::string>{"0,15+7,10 1 %: 27 and -", "0,15+7,10 5 %: 32 and -", "4,2+11,3 5 %: 90",
                                 "2,6+4,10 2 %: 157", "2,6+4,10 5 %: -", "11,3+11,4 5 %: 196",
                                 "6,4+8,1 2 %: 214", "6,4+8,1 5 %: 239", "10,4+10,12 5 %: 213"});
  CHECK(cases.fields.size() == 9);
  CHECK(cases.example.noise == 0.14);
}

TEST_CASE("A file of cases that is not there, is no JSON or lacks a part is refused by name") {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& text) -> std::string {
    std::ofstream(folder / "cases.json") << text;
    return test::refusal_of([&] { read_paper_cases(folder / "cases.json"); });
  };
  CHECK_THAT(message("{"), Contains("cases.json") && Contains("expected"));
  CHECK_THAT(message("{\"source\": \"s\"}"), Contains("example"));
  CHECK_THAT(message("{\"source\": 5}"), Contains("cases.json"));
  CHECK_THROWS_AS(read_paper_cases(folder / "none.json"), InputError);
  const auto of_example = [&](const std::string& noise) {
    return message("{\"source\": \"s\", \"example\": {\"scene\": \"10,4\", \"noise\": " + noise + "}}");
  };
  CHECK_THAT(of_example("-0.14"), Contains("noise is -0.14, expected a number from 0 to 1"));
  CHECK_THAT(of_example("\"much\""), Contains("noise is \"much\", expected a number"));
}
