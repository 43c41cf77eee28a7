/// @file Databases of bridges with mortar. Oracles: the stored fields' own equilibrium, scenes solved anew,
/// the same bridge with dry joints.

#include <catch2/catch.hpp>

#include "database/records/database.h"
#include "generator/build.h"
#include "generator/verify/verify.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// So weak that some scenes fall in spite of it, and others stand that would fall dry.
constexpr const char* kMortar =
    "\n[[mortar]]\ntensile_strength_Pa = 6e3\nopening_energy_J_m2 = 0.6\ncohesion_Pa = 12e3\n"
    "slip_energy_J_m2 = 3\n";

BuildSummary build_singles(const std::string& text, const std::filesystem::path& output,
                           bool known_bridge = true) {
  Progress quiet(Progress::Mode::quiet);
  BuildRequest request;
  request.bridge = parse_bridge_file(text, "small.toml");
  request.output = output;
  request.scenes = "singles";
  request.histories = "built,lost";
  request.known_bridge = known_bridge;
  return build_database(request, quasi_static(), quiet);
}

}  // namespace

TEST_CASE("A bridge with mortar has a database like any other, if it may be taken for known",
          "[mortar][many-solutions]") {
  const test::TemporaryFolder folder;
  const std::string dry = test::text_of(test::example_bridge("small"));
  const BuildSummary summary = build_singles(dry + kMortar, folder / "mortar.h5");
  const OutcomeCounts held = summary.outcomes;
  const OutcomeCounts loose = build_singles(dry, folder / "dry.h5").outcomes;
  for (std::size_t state = 0; state < 2; ++state) {
    CHECK(held.states[state].standing > loose.states[state].standing);
    CHECK(held.states[state].collapsed > 0);
    CHECK(held.states[state].unresolved.empty());
  }
  CHECK(Database::open(folder / "mortar.h5").sensitivities() == nullptr);
  CHECK_THROWS_WITH(build_singles(dry + kMortar, folder / "uncertain.h5", false),
                    Catch::Contains("small.toml: has [[mortar]]") && Catch::Contains("--known-bridge"));
  const VerifyReport report =
      verify_database({.database = folder / "mortar.h5", .recompute = 40, .threads = 1});
  CHECK(report.problems.empty());
  CHECK(report.recomputed >= 39);
}

}  // namespace voussoir
