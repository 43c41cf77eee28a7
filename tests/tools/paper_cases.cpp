/// Files of cases.

#include <catch2/catch.hpp>
#include <fstream>

#include "core/error.h"
#include "tests/support/temporary_folder.h"
#include "tools/paper_cases.h"

using namespace voussoir;
using Catch::Matchers::Contains;

TEST_CASE("The paper's cases are those printed in its Tables 2 and 3") {
  const PaperCases cases = read_paper_cases(paper_cases_file());
  CHECK(cases.one_block.size() == 11);
  CHECK(cases.two_blocks.size() == 9);
  CHECK(cases.fields.size() == 9);
  CHECK(cases.one_block[7].scene == "8,12");
  CHECK(cases.one_block[7].noise == 0.05);
  CHECK(cases.one_block[7].paper == "127");
  CHECK(cases.two_blocks[7].paper == "239");
  CHECK(cases.example.noise == 0.14);
}

TEST_CASE("A file of cases that is not there, is no JSON or lacks a part is refused by name") {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& text) -> std::string {
    std::ofstream(folder / "cases.json") << text;
    try {
      read_paper_cases(folder / "cases.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK_THAT(message("{"), Contains("cases.json") && Contains("expected"));
  CHECK_THAT(message("{\"source\": \"s\"}"), Contains("example"));
  CHECK_THAT(message("{\"source\": 5}"), Contains("cases.json"));
  CHECK_THROWS_AS(read_paper_cases(folder / "none.json"), InputError);
}
