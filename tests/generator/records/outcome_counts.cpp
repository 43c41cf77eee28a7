#include "generator/records/outcome_counts.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

struct Found {
  Outcome outcome;
  CollapseExtent extent;
};

/// A record of the scene, in two states and one with a load.
Record record_of(const Model& bridge, const Scene& scene, const std::vector<Found>& found) {
  std::vector<Solution> states;
  for (const Found& each : found) {
    Solution& state = states.emplace_back(test::made_up_solution(bridge, scene));
    state.outcome = each.outcome;
    state.extent = each.extent;
    state.moving.clear();
    state.residual = 0.25;
  }
  return make_record({kNominalVariant, scene}, states, bridge.control_points, KeepField::no, KeepField::no);
}

Record record_of(const Model& bridge, int block, const std::vector<Found>& found) {
  return record_of(bridge, Scene{{BlockId{block}}}, found);
}

constexpr Found kStands{Outcome::standing, CollapseExtent::none};
constexpr Found kFalls{Outcome::collapsed, CollapseExtent::local};
constexpr Found kArchFalls{Outcome::collapsed, CollapseExtent::arch};
constexpr Found kOpen{Outcome::unresolved, CollapseExtent::none};

/// Standing, local collapses, arch collapses, collapses, unresolved.
std::vector<std::size_t> numbers_of(const OutcomeCounts& counts, std::size_t state) {
  const StateOutcomes& found = counts.states.at(state);
  return {found.standing, found.local_collapses, found.arch_collapses, found.collapsed,
          found.unresolved.size()};
}

}  // namespace

TEST_CASE("Outcomes are counted for each state, by the build and from the file alike (written out)") {
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  const std::vector<Record> records = {record_of(bridge, 0, {kStands, kStands, kOpen}),
                                       record_of(bridge, 1, {kFalls, kStands, kOpen}),
                                       record_of(bridge, 2, {kArchFalls, kArchFalls, kArchFalls})};
  DatabaseContent content = test::made_up_content(file, bridge, {}, KeepField::no);
  content.states = {kBuiltState, kLostState, "built:truck"};
  OutcomeCounts counts(content.states);
  for (const Record& record : records) {
    content.keys.push_back(record.key);
    counts.add(record, bridge.layout);
  }
  const test::TemporaryFolder folder;
  write_database(folder / "three.h5", content, [&](std::size_t row) { return records[row]; });
  for (const OutcomeCounts& each : {counts, count_outcomes(Database::open(folder / "three.h5"))}) {
    CHECK(each.scenes == 3);
    CHECK(numbers_of(each, 0) == std::vector<std::size_t>{1, 1, 1, 2, 0});
    CHECK(numbers_of(each, 1) == std::vector<std::size_t>{2, 0, 1, 1, 0});
    CHECK(numbers_of(each, 2) == std::vector<std::size_t>{0, 0, 1, 1, 2});
    const std::string first = to_string(records[0].key, bridge.layout);
    CHECK(each.states.at(2).unresolved[0].scene == first);
    CHECK(each.states.at(2).unresolved[0].residual == 0.25);
    const auto json = to_json(each);
    CHECK(json["standing"] == 1);
    CHECK(json["states"][1]["standing"] == 2);
    CHECK(json["states"][2]["unresolved_scenes"][0]["scene"] == first);
    CHECK_THAT(to_text(each), Catch::Contains("  lost\n  standing    2\n") &&
                                  Catch::Contains("  built:truck: 0 standing, 1 collapsed, 2 unresolved\n"));
    CHECK(json["intact"].is_null());
  }
}

TEST_CASE(
    "An intact bridge that falls or has no outcome is said, by the build and from the file (written out)") {
  const BridgeFile file = test::small_bridge_file();
  const Model bridge = make_model(file.description);
  const std::vector<std::pair<Found, std::string>> cases = {
      {kStands, ""}, {kArchFalls, "the intact bridge falls"}, {kOpen, "the intact bridge has no outcome"}};
  for (const auto& [found, said] : cases) {
    const Record record = record_of(bridge, Scene{}, {found});
    DatabaseContent content = test::made_up_content(file, bridge, {}, KeepField::no);
    content.keys = {record.key};
    OutcomeCounts counts(content.states);
    counts.add(record, bridge.layout);
    const test::TemporaryFolder folder;
    write_database(folder / "one.h5", content, [&](std::size_t) { return record; });
    for (const OutcomeCounts& each : {counts, count_outcomes(Database::open(folder / "one.h5"))}) {
      CHECK(to_json(each)["intact"] == std::string(to_string(found.outcome)));
      if (said.empty())
        CHECK_THAT(to_text(each), !Catch::Contains("intact"));
      else
        CHECK_THAT(to_text(each), Catch::Contains(said));
    }
  }
}

}  // namespace voussoir
