/// @file What a database states of its origin. Oracle: the file as it was built.

#include "generator/verify/origin_check.h"

#include <catch2/catch.hpp>

#include "tests/support/damaged_database.h"
#include "tests/support/few_scenes.h"

namespace voussoir {
namespace {

/// The file with another first letter in the text of an attribute.
std::string with_changed(const std::string& bytes, const std::string& attribute, const std::string& text) {
  const std::size_t at = bytes.find(text, bytes.find(attribute));
  REQUIRE(at != std::string::npos);
  return test::forged_at(test::good_database(bytes), at, bytes[at] == 'x' ? 'y' : 'x');
}

}  // namespace

TEST_CASE("A file that states another origin than its text and settings give is found out") {
  const test::FewScenes few;
  const Provenance good = Database::open(few.path).provenance();
  const auto report = [&](const char* name, const std::string& text) {
    return few.verify_with(with_changed(few.bytes, name, text));
  };
  CHECK(test::names(report(attribute::kBridgeName, good.bridge_name),
                    "attribute 'bridge_name' is 'xmall', expected 'small'"));
  for (const auto& [name, text] : {std::pair(attribute::kResultsKey, good.results_key),
                                   std::pair(attribute::kSolverRevision, good.solver_revision),
                                   std::pair(attribute::kCompiler, good.compiler),
                                   std::pair(attribute::kCompileFlags, good.compile_flags)})
    CHECK(test::names(report(name, text), "attribute 'results_key'"));
  CHECK(few.verify_with(few.bytes).ok());
}

TEST_CASE("Settings with which solvers would search for ever are refused before anything is solved") {
  const test::FewScenes few;
  const std::string good = "motion.most_parts = 8\n";
  std::string changed = few.bytes;
  const std::size_t at = changed.find(good);
  REQUIRE(at != std::string::npos);
  changed.replace(at, good.size(), "motion.most_parts=8e9\n");
  const VerifyReport report = few.verify_with(changed);
  CHECK(test::names(report,
                    "dataset 'solver/settings': 'motion.most_parts=8e9': expected a number from 0 to 1000"));
  CHECK(report.fields == 0);
}

}  // namespace voussoir
