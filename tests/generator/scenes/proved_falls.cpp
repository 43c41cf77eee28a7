/// @file Pairs that limit analysis proves to fall, against a search of every one of them.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

#include "database/records/database.h"
#include "generator/build.h"
#include "tests/support/bridges.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

Database build_pairs(const test::TemporaryFolder& folder, const std::string& name, bool inherited) {
  BuildRequest request;
  request.bridge = read_bridge_file(test::example_bridge("small"));
  request.output = folder / name;
  request.scenes = "pairs";
  request.histories = "built,lost";
  request.rules.inherited = inherited;
  request.known_bridge = true;
  Progress quiet(Progress::Mode::quiet);
  build_database(request, quasi_static(), quiet);
  return Database::open(request.output);
}

}  // namespace

TEST_CASE("What is proved to fall has no equilibrium after a loss either (every pair searched for)",
          "[many-solutions]") {
  const test::TemporaryFolder folder;
  const Database quick = build_pairs(folder, "quick.h5", true);
  const Database searched = build_pairs(folder, "searched.h5", false);
  for (const std::size_t state : {std::size_t{0}, std::size_t{1}}) {
    CAPTURE(state);
    const SceneTable of_quick = quick.table(kNominalVariant, state);
    const SceneTable of_searched = searched.table(kNominalVariant, state);
    CHECK(std::ranges::count(of_searched.outcome, static_cast<std::uint8_t>(Outcome::collapsed)) > 10);
    CHECK(std::ranges::equal(of_quick.outcome, of_searched.outcome));
    CHECK(std::ranges::equal(of_quick.collapse, of_searched.collapse));
    CHECK(std::ranges::equal(of_quick.vertical, of_searched.vertical,
                             [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
  }
}

}  // namespace voussoir
