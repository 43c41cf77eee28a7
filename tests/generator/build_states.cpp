/// @file Databases of several states: histories and load cases.

#include <catch2/catch.hpp>

#include "core/error.h"
#include "core/structure/mirror_symmetry.h"
#include "database/records/database.h"
#include "generator/build.h"
#include "generator/verify/verify.h"
#include "tests/support/made_up_solver.h"
#include "tests/support/same_bits.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

const std::vector<std::string> kAllNames = {
    "built",       "lost",         "built:lorry@1", "built:lorry@2",  "built:lorry@off",
    "built:crown", "lost:lorry@1", "lost:lorry@2",  "lost:lorry@off", "lost:crown"};

/// A folder to build in and the request for the small bridge with two load cases, one of them one-sided.
struct StatesSite {
  test::TemporaryFolder folder;
  BuildRequest request;

  explicit StatesSite(const std::string& histories = "built,lost", const std::string& loads = "all") {
    request.bridge = test::small_bridge_file();
    request.bridge = parse_bridge_file(
        request.bridge.text +
            "[[loads]]\nname = \"lorry\"\naxles = [{at_m = 0, force_N = 1e4}]\nfrom_m = 2\nto_m = 4\nsteps = "
            "2\n"
            "unload = true\n[[loads]]\nname = \"crown\"\npoints = [{x_m = 3, force_N = 1e4}]\n",
        "small.toml");
    request.output = folder / "small.h5";
    request.histories = histories;
    request.loads = loads;
    request.threads = 2;
    request.known_bridge = true;  // records are looked at here
  }
  BuildSummary build(const SolverChoice& solver = test::made_up_solver()) const {
    Progress quiet(Progress::Mode::quiet);
    return build_database(request, solver, quiet);
  }
  Database open() const { return Database::open(request.output); }
};

std::string digest_of_all() {
  static const std::string digest = StatesSite().build().digest;
  return digest;
}

/// Everything but the checksum, which covers all states of a record.
void check_same_state(const RecordedState& first, const RecordedState& second) {
  CHECK(first.outcome == second.outcome);
  CHECK(first.residual == second.residual);
  CHECK(first.iterations == second.iterations);
  CHECK(first.moving == second.moving);
  CHECK(first.packed_field == second.packed_field);
}

}  // namespace

TEST_CASE(
    "Histories and loads of real scenes are verified, each state with its own equations, and solved anew") {
  for (const char* histories : {"built,lost", "lost"}) {
    StatesSite site(histories);
    site.request.scenes = "intact;4,1..3;0,5;4,1+4,2;4,1+5,3";
    const BuildSummary summary = site.build(quasi_static());
    const Database database = site.open();
    if (database.states().size() == kAllNames.size()) CHECK(database.states() == kAllNames);
    const VerifyReport report = verify_database({site.request.output, database.rows()});
    CHECK(report.problems == std::vector<std::string>{});
    CHECK(report.fields == database.rows() * database.states().size());
    CHECK(report.recomputed == database.rows());
    CHECK(report.largest_recomputed_difference == 0.0);
    REQUIRE(summary.outcomes.states.size() == database.states().size());
    for (const StateOutcomes& outcomes : summary.outcomes.states)
      CHECK(outcomes.standing + outcomes.collapsed + outcomes.unresolved.size() == database.rows());
    const std::size_t standing = *database.find(parse_scene("4,2", database.layout()));
    for (std::size_t state = 1; state < database.states().size(); ++state)  // each is another one
      CHECK_FALSE(test::same_bits(database.field(standing, state), database.field(standing, 0)));
  }
}

TEST_CASE("Lost alone holds the records that built and lost together hold, without fields, too",
          "[many-solutions]") {
  for (const KeepField fields : {KeepField::yes, KeepField::no}) {
    StatesSite both, alone("lost");
    both.request.fields = alone.request.fields = fields;
    both.build();
    alone.build();
    const Database all = both.open(), lost = alone.open();
    CHECK(lost.states().front() == "lost");
    CHECK(lost.table().outcome.size() == all.table().outcome.size());
    for (std::size_t row = 0; row < lost.rows(); ++row)
      for (std::size_t state = 0; state < lost.states().size(); ++state) {
        const Record one = lost.record(row), other = all.record(row);
        check_same_state(one.states[state], other.states[*all.find_state(lost.states()[state])]);
        REQUIRE(std::ranges::equal(view_bytes(one.states[state].vertical),
                                   view_bytes(other.states[*all.find_state(lost.states()[state])].vertical)));
      }
  }
}

TEST_CASE("What falls as built does so by the same proof whether lost is wanted or not, from rest, too") {
  StatesSite built("built", "none"), both("built,lost", "none");
  for (StatesSite* site : {&built, &both}) {
    site->request.scenes = "singles;0,5+4,*";
    site->request.rules.warm_starts = site->request.rules.collapse_fields = false;
    site->build(for_outcomes());
  }
  const Database alone = built.open(), beside = both.open();
  REQUIRE(alone.rows() == beside.rows());
  int proved = 0;
  for (std::size_t row = 0; row < alone.rows(); ++row) {
    const RecordedState state = alone.record(row).states.front();
    check_same_state(state, beside.record(row).states.front());
    if (state.outcome == Outcome::collapsed && state.iterations == 0 && alone.key(row).scene.missing() == 2)
      ++proved;
  }
  CHECK(proved > 0);
}

TEST_CASE("The digest of histories and loads does not depend on threads", "[threads]") {
  for (const int threads : {1, 3}) {
    StatesSite site;
    site.request.threads = threads;
    CHECK(site.build().digest == digest_of_all());
  }
}

TEST_CASE("The digest of histories and loads does not depend on interruptions") {
  for (const int answers : {1, 12, 300, 2000}) {
    const StatesSite site;
    REQUIRE_THROWS_AS(site.build(test::failing_solver(answers)), Failure);
    const BuildSummary summary = site.build();
    CHECK(summary.resumed + summary.computed == summary.outcomes.scenes);
    CHECK(summary.digest == digest_of_all());
  }
}

TEST_CASE("Real histories and loads come out the same on one thread and, interrupted, on three",
          "[threads]") {
  StatesSite once, often;
  for (StatesSite* site : {&once, &often}) site->request.scenes = "4,1..2;4,1..2+5,1";
  once.request.threads = 1;
  often.request.threads = 3;
  const std::string expected = once.build(quasi_static()).digest;
  // The first 30 answers of a real solver, then an interruption.
  const auto left = std::make_shared<std::atomic<int>>(30);
  SolverChoice failing = quasi_static();
  failing.make_solver = [left, make = failing.make_solver](const Model& bridge, const std::string& settings) {
    return StageSolver([left, solver = make(bridge, settings)](std::span<const StageTask> tasks) {
      if (*left -= static_cast<int>(tasks.size()); *left < 0) throw Failure("interrupted");
      return solver(tasks);
    });
  };
  REQUIRE_THROWS_AS(often.build(failing), Failure);
  const BuildSummary summary = often.build(quasi_static());
  CHECK(summary.resumed > 0);
  CHECK(summary.digest == expected);
}

TEST_CASE(
    "Mirror images are mirrored as built, as lost and under symmetric loads, bit by bit, and solved under "
    "others") {
  const StatesSite site;
  site.build();
  const Database database = site.open();
  const Model bridge = make_model(site.request.bridge.description);
  for (const char* text : {"4,1", "1,1+4,2", "4,2+5,3"}) {
    const Scene scene = parse_scene(text, bridge.layout);
    const std::size_t row = *database.find(scene), image = *database.find(mirrored(scene, *bridge.symmetry));
    REQUIRE(row != image);
    for (std::size_t state = 0; state < database.states().size(); ++state) {
      INFO(text << " " << database.states()[state]);
      const bool is_mirrored =
          test::same_bits(database.field(image, state),
                          to_storage_precision(mirrored(database.field(row, state), *bridge.symmetry)));
      const bool stands = database.record(row).states[0].outcome == Outcome::standing;
      const bool one_sided = database.states()[state].find("lorry") != std::string::npos;
      CHECK(is_mirrored == (!one_sided || !stands));
    }
  }
}

TEST_CASE("Of a database of built only, built is taken over when lost and loads are wanted") {
  StatesSite site("built", "none");
  site.build();
  site.request.histories = "built,lost";
  site.request.loads = "all";
  // Every scene of the plan has one answer less than with nothing known.
  const auto asked = std::make_shared<std::atomic<int>>(0);
  SolverChoice counting = test::made_up_solver();
  counting.make_solver = [asked, make = counting.make_solver](const Model& bridge,
                                                              const std::string& settings) {
    return StageSolver([asked, solver = make(bridge, settings)](std::span<const StageTask> tasks) {
      for (const StageTask& task : tasks) *asked += task.before == nullptr ? 1 : 0;
      return solver(tasks);
    });
  };
  const BuildSummary summary = site.build(counting);
  CHECK(*asked == 0);
  CHECK(summary.changes == std::vector<std::string>{fmt::format("other states are wanted ({}, was built)",
                                                                fmt::join(kAllNames, ","))});
  CHECK(summary.computed == summary.outcomes.scenes);
  CHECK(summary.digest == digest_of_all());
}

TEST_CASE("States that are no longer wanted are left out without solving anything") {
  StatesSite site;
  site.build();
  site.request.histories = "lost";
  site.request.loads = "crown";
  CHECK_THROWS_WITH(site.build(test::failing_solver(1)), Catch::Contains("scenes as built, built:lorry@1"));
  site.request.drop = true;
  const BuildSummary summary = site.build(test::failing_solver(1));
  CHECK(summary.reused == summary.outcomes.scenes);
  CHECK(summary.digest == StatesSite("lost", "crown").build().digest);
  CHECK(site.build(test::failing_solver(1)).up_to_date);
}

TEST_CASE("When a load case changes its states are solved again and the others are kept",
          "[many-solutions]") {
  StatesSite site;
  site.build();
  site.request.bridge.description.loads[1].points[0].force = 2e4;
  site.request.bridge.text += "# crown is heavier\n";
  CHECK(site.build().reused == 0);
  StatesSite direct;
  direct.request.bridge = site.request.bridge;
  CHECK(site.open().digest() == direct.build().digest);
  CHECK(site.open().digest() != digest_of_all());
}

TEST_CASE("The records of an interrupted build with other states are not mixed in") {
  StatesSite site;
  REQUIRE_THROWS_AS(site.build(test::failing_solver(900)), Failure);
  site.request.loads = "crown";
  CHECK(site.build().resumed == 0);
}

TEST_CASE(
    "A state that is not what its history makes of it is found, though checksums and other states are "
    "right") {
  StatesSite site;
  site.request.scenes = "intact;4,1..2";
  site.build(quasi_static());
  const Database right = site.open();
  const Model bridge = make_model(site.request.bridge.description);
  std::vector<RecordKey> keys;
  for (std::size_t row = 0; row < right.rows(); ++row) keys.push_back(right.key(row));
  for (std::size_t wrong = 1; wrong < kAllNames.size(); ++wrong) {
    const auto path = site.folder / "wrong.h5";
    write_database(path, {right.provenance(), bridge, right.variants(), keys, right.states(), KeepField::yes},
                   [&](std::size_t row) {
                     std::vector<Solution> states;
                     for (std::size_t state = 0; state < right.states().size(); ++state)
                       states.push_back(right.solution(row, state));
                     if (row == 2) states[wrong] = right.solution(row, wrong == 1 ? 0 : wrong == 6 ? 2 : 1);
                     return make_record(keys[row], states, bridge.control_points, KeepField::yes,
                                        KeepField::yes);
                   });
    const VerifyReport report = verify_database({path});
    INFO(kAllNames[wrong]);
    REQUIRE_FALSE(report.ok());
    CHECK_THAT(report.problems.front(),
               Catch::Contains("scene 4,2: as " + kAllNames[wrong] + ": stands, but"));
  }
}

}  // namespace voussoir
