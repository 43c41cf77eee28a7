/// The whole way from the bridge to the answer, on the reference bridge: without noise every standing scene
/// is found.

#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "generator/build.h"
#include "lookup/lookup.h"
#include "tests/support/temporary_folder.h"

using namespace voussoir;

namespace {

/// Intact, all singles and 1,000 pairs drawn with a fixed seed.
std::string scene_list(const BlockLayout& layout) {
  std::set<Scene> pairs;
  std::mt19937 random(20250101);
  const auto blocks = static_cast<std::uint32_t>(layout.size());
  while (pairs.size() < 1000) {
    const int a = static_cast<int>(random() % blocks);
    const int b = static_cast<int>(random() % blocks);
    if (a < b) pairs.insert(Scene{{BlockId{a}, BlockId{b}}});
  }
  std::string list = "singles";
  for (const Scene& pair : pairs) list += ";" + to_string(pair, layout);
  return list;
}

bool same_displacements(const SceneTable& table, std::size_t a, std::size_t b) {
  const auto x = table.row(a);
  const auto y = table.row(b);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(x[i] == y[i] || (std::isnan(x[i]) && std::isnan(y[i])))) return false;
  return true;
}

}  // namespace

TEST_CASE("Noise-free readings of every standing scene are located exactly", "[locate][whole-build]") {
  // Oracle: the scene that the readings were taken from, for all singles and 1,000 pairs of the reference
  // bridge.
  const test::TemporaryFolder folder;
  BuildRequest request;
  request.bridge = reference_bridge_file();
  request.output = folder / "bridge.h5";
  request.scenes = scene_list(lay_blocks(request.bridge.description));
  request.fields = KeepField::no;
  Progress silent(Progress::Mode::quiet);
  build_database(request, quasi_static(), silent);

  const Database database = Database::open(request.output);
  const SceneTable& table = database.table();
  const Library library = library_of(database);
  int located = 0;
  for (const Objective objective : {Objective::paper, Objective::posterior})
    for (std::size_t row = 0; row < table.rows; ++row) {
      if (static_cast<Outcome>(table.outcome[row]) != Outcome::standing) continue;
      LookupSettings settings;
      settings.objective = objective;
      settings.top = 3;
      const Answer answer =
          locate_damage(absolute_readings(library, as_measurements(table.row(row))), settings);
      const std::size_t first = answer.candidates.at(0).row;
      INFO(to_string(table.scene(row), database.layout())
           << " located as " << to_string(table.scene(first), database.layout()));
      CHECK((first == row || same_displacements(table, first, row)));
      ++located;
    }
  CHECK(located > 2 * 900);
}
