/// @file Errors of programs that were asked for JSON. Oracle: the message for people on the standard error.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// The message in JSON is the one for people, and there only where JSON is asked for.
void check_error(const std::string& name, std::vector<std::string> arguments, int exit_code) {
  INFO(name << " " << arguments.front());
  const test::ProgramResult plain = test::run(name, arguments);
  CHECK(plain.exit_code == exit_code);
  CHECK(plain.out.empty());
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"--format", "json"}, {"--format=json"}}) {
    std::vector<std::string> with_format = arguments;
    with_format.insert(with_format.end(), asked.begin(), asked.end());
    const test::ProgramResult result = test::run(name, with_format);
    CHECK(result.exit_code == exit_code);
    REQUIRE_FALSE(result.out.empty());
    const auto printed = nlohmann::json::parse(result.out);
    CHECK(printed.at("ok") == false);
    CHECK(result.err == name + ": " + printed.at("error").get<std::string>() + "\n");
  }
}

}  // namespace

TEST_CASE("Whoever asks for JSON gets JSON, of wrong usage, too") {
  const test::TemporaryFolder folder;
  const std::string none = (folder / "none").string();
  for (const char* const program :
       {"build-database", "merge-databases", "verify-database", "locate-damage", "query-field"})
    check_error(program, {"--nonsense"}, 2);
  check_error("build-database", {none, "-o", (folder / "b.h5").string()}, 2);
  check_error("locate-damage", {none, "-d", none}, 1);
  check_error("query-field", {"intact", "-d", none}, 1);
}

}  // namespace voussoir
