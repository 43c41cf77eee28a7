/// @file Trials on irregular bridges: readings, counting, and the whole study on made-up bridges.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "core/error.h"
#include "core/structure/uncertain_parameters.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"
#include "tools/trials/sampled_truth.h"
#include "tools/trials/study_report.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr std::array kAllTaken = {ReadingsTaken::change, ReadingsTaken::two_epochs, ReadingsTaken::absolute,
                                  ReadingsTaken::load, ReadingsTaken::load_change};

/// Mean and standard deviation.
std::pair<double, double> moments(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / n)};
}

/// The small bridge, its own rows in a second variant as the truth.
struct Site {
  test::TemporaryFolder folder;
  BridgeFile file = test::small_bridge_file();
  Model bridge = make_model(file.description);
  std::vector<Scene> scenes = all_scenes(bridge.layout.size(), 1);

  /// Variants that show this many times what the nominal bridge shows. Everything stands.
  Database write(const std::vector<double>& factors, const std::string& name) const {
    DatabaseContent content = test::made_up_content(file, bridge, scenes, KeepField::yes, factors.size(), 2);
    content.states = {kBuiltState, kLostState};
    write_database(folder / name, content, [&](std::size_t row) {
      const RecordKey& key = content.keys[row];
      std::vector<Solution> solutions(2, test::made_up_solution(bridge, key.scene));
      for (Solution& solution : solutions) {
        solution.outcome = Outcome::standing;
        solution.moving.clear();
        solution.extent = CollapseExtent::none;
        solution.displacement =
            to_storage_precision(factors[static_cast<std::size_t>(key.variant)] * solution.displacement);
      }
      return make_record(key, solutions, bridge.control_points, KeepField::yes, KeepField::yes);
    });
    return Database::open(folder / name);
  }
};

}  // namespace

TEST_CASE("Readings of trials are what the bridge shows, with the stated scatter (mean, deviation)") {
  constexpr std::size_t kMany = 20000;
  const std::vector<double> before(kMany, -1e-3), after(kMany, -3e-3);
  for (const ReadingsTaken taken : kAllTaken) {
    Random random(1);
    const ReadingsFile file = take_readings({before, after}, taken, 1e-5, random);
    const bool second_alone = taken == ReadingsTaken::absolute || taken == ReadingsTaken::load;
    std::vector<double> values, firsts;
    for (const Reading& reading : file.readings) {
      values.push_back(reading.value);
      firsts.push_back(reading.before);
      if (file.two_epochs) REQUIRE(reading.after - reading.before == reading.value);
      REQUIRE(reading.sigma == 1e-5);
    }
    const auto [mean, deviation] = moments(values);
    CHECK(mean == Approx(second_alone ? -3e-3 : -2e-3).margin(3e-7));
    CHECK(deviation == Approx(1e-5).epsilon(0.02));
    if (file.two_epochs) CHECK(moments(firsts).second == Approx(1e-5 / std::sqrt(2.0)).epsilon(0.02));
    CHECK(file.two_epochs == (taken == ReadingsTaken::two_epochs));
    CHECK((file.kind == ReadingKind::absolute) == (taken == ReadingsTaken::absolute));
    CHECK(is_loaded(file.kind) == is_loaded(taken));
    CHECK(is_change(file.kind) != second_alone);
  }
}

TEST_CASE("A sensor on a block that is gone is silent, in every kind of readings") {
  const std::vector<double> before = {-1e-3, -2e-3}, after = {kNan, -2e-3};
  for (const ReadingsTaken taken : kAllTaken) {
    Random random(1);
    const ReadingsFile file = take_readings({before, after}, taken, 1e-5, random);
    CHECK(file.readings.at(0).silent);
    CHECK(std::isnan(file.readings.at(0).value));
    CHECK_FALSE(file.readings.at(1).silent);
  }
}

TEST_CASE("True bridges are the variants of a file; one without variants is refused") {
  const Site site;
  const Database database = site.write({1.0, 1.1, 0.8}, "bridges.h5");
  const std::vector<TrueBridge> bridges = read_true_bridges(database);
  REQUIRE(bridges.size() == 2);
  for (std::size_t b = 0; b < 2; ++b) {
    REQUIRE(bridges[b].damaged.size() == site.bridge.layout.size());
    const SceneTable table = database.table(static_cast<std::int32_t>(b) + 1, 0);
    for (std::size_t point = 0; point < table.points; ++point)
      REQUIRE(bridges[b].intact[point] == table.row(0)[point]);
  }
  CHECK_THROWS_WITH(read_true_bridges(site.write({1.0}, "none.h5")), Contains("no variants"));
}

TEST_CASE("A study of bridges that are the database's own finds every block and writes what it found") {
  const Site site;
  const Database database = site.write({1.0, 1.0}, "own.h5");
  StudySettings settings{.sigmas = {1e-6}, .every_all = 7};
  std::size_t shown = 0;
  const std::vector<StudyRow> rows = study_damaged(database, {"own", read_true_bridges(database)}, settings,
                                                   [&](const StudyRow&) { ++shown; });
  REQUIRE(rows.size() == 10);  // among singles and among all: three kinds of readings, two with known bridge
  CHECK(shown == rows.size());
  for (const StudyRow& row : rows) {
    INFO(to_text(row));
    CHECK(row.rates.trials == (row.looked_for == "singles among singles" ? 38 : 6));
    if (row.known_bridge) CHECK(row.rates.first.value == 1.0);
    if (row.known_bridge) CHECK(row.rates.names_sound.value == 0.0);
  }
  const auto json = nlohmann::json::parse(to_json({"own.h5", "digest", "small", {"own"}, settings}, rows));
  REQUIRE(json["rows"].size() == rows.size());
  CHECK(json["rows"][0]["first"]["share"] == rows[0].rates.first.value);
  CHECK(json["rows"][0]["sigma_mm"] == Approx(1e-3));
  const std::string page = to_page({"own.h5", "digest", "small", {"own"}, settings}, rows);
  CHECK_THAT(page, Contains("Reliability") && Contains("singles among singles") && Contains("own.h5"));
}

TEST_CASE("Trials do not depend on what else is asked; other seeds draw other errors") {
  const Site site;
  const Database database = site.write({1.0, 1.02}, "bridges.h5");
  const SensorList sensors = control_point_sensors(database.control_points());
  Asking asking{database, sensors, {}, true};
  asking.lookup.prior.missing = {1};
  const auto bridges = read_true_bridges(database);
  const auto likeliest = [&](std::uint64_t seed) {
    std::vector<double> values;
    for (const Trial& each : look_for_damage(asking, bridges, 1, {ReadingsTaken::change, 1e-4, seed}))
      values.push_back(each.likeliest);
    return values;
  };
  CHECK(likeliest(1) == likeliest(1));
  CHECK(likeliest(1) != likeliest(2));
}

TEST_CASE("A verdict that names a block that is there is counted, one that names a missing one is not") {
  const Site site;
  const Database database = site.write({1.0, 1.0}, "own.h5");
  const SensorList sensors = control_point_sensors(database.control_points());
  Asking asking{database, sensors, {}, true};
  asking.lookup.prior.missing = {1};
  const TrueBridge bridge = read_true_bridges(database).front();
  Random random(1);
  const ReadingsFile readings =
      take_readings({bridge.intact, bridge.damaged[3].lost}, ReadingsTaken::change, 1e-6, random);
  const auto if_true = [&](std::size_t damaged) {
    return ask(asking, readings, database.find(bridge.damaged[damaged].scene).value());
  };
  REQUIRE(if_true(3).verdict == Verdict::located);
  CHECK_FALSE(if_true(3).names_sound);
  CHECK(if_true(5).names_sound);
}

TEST_CASE("Between two epochs intact bridges stay as they are, or rise with the warmth") {
  const BridgeDescription description = test::small_bridge_file().description;
  const Model bridge = make_model(description);
  const SampledTruth truth{"joints", scattered_joints(0.2), 3, 1};
  const IntactTruth same = solve_intact(description, truth, {});
  const IntactTruth warmer = solve_intact(description, truth, {.warmer = 20.0});
  REQUIRE(same.bridges.size() == 3);
  CHECK(same.bridges[0].before != same.bridges[1].before);
  for (std::size_t b = 0; b < same.bridges.size(); ++b) {
    double rise = 0.0, free = 0.0;
    for (std::size_t point = 0; point < bridge.control_points.size(); ++point) {
      CHECK(same.bridges[b].after[point] == Approx(same.bridges[b].before[point]).margin(1e-12));
      CHECK(warmer.bridges[b].before[point] == same.bridges[b].before[point]);
      rise += warmer.bridges[b].after[point] - warmer.bridges[b].before[point];
      free += description.material.thermal_expansion * 20.0 * bridge.control_points[point].position.y();
    }
    // A free column rises by alpha dT y; sides that hold push up, an arch rises more in its middle.
    CHECK(rise > 0.8 * free);
    CHECK(rise < 2.0 * free);
  }
}

TEST_CASE("A foot that settles takes the points above it along, those of the other foot hardly") {
  const BridgeDescription description = test::small_bridge_file().description;
  const Model bridge = make_model(description);
  const IntactTruth truth =
      solve_intact(description, {"joints", scattered_joints(0.1), 1, 1}, {.settlement = 1e-3});
  const auto change = [&](std::size_t point) {
    return truth.bridges[0].after[point] - truth.bridges[0].before[point];
  };
  std::size_t left = 0, right = 0;
  for (std::size_t i = 0; i < bridge.control_points.size(); ++i) {
    if (bridge.control_points[i].position.x() < bridge.control_points[left].position.x()) left = i;
    if (bridge.control_points[i].position.x() > bridge.control_points[right].position.x()) right = i;
  }
  CHECK(change(left) == Approx(-1e-3).epsilon(0.3));
  CHECK(std::abs(change(right)) < 3e-4);
}

TEST_CASE(
    "Where half of the joints soften half of the bridge sinks, mirrored on the other side if those do") {
  const BridgeDescription description = test::small_bridge_file().description;
  const Model bridge = make_model(description);
  REQUIRE(bridge.symmetry);
  const SampledTruth nominal{"joints", scattered_joints(0.0), 1, 1};
  const auto sinking = [&](const Between& between) {
    const IntactBridge truth = solve_intact(description, nominal, between).bridges[0];
    std::vector<double> sunk;
    for (std::size_t i = 0; i < truth.before.size(); ++i) sunk.push_back(truth.before[i] - truth.after[i]);
    return sunk;
  };
  const std::vector<double> all = sinking({.joint_stiffness = 0.9}),
                            left = sinking({.joint_stiffness = 0.9, .softened_part = 0.5}),
                            none = sinking({.joint_stiffness = 0.9, .softened_part = -1.0});
  double of_left = 0.0, of_right = 0.0, of_all = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = bridge.control_points[i].position.x();
    (x < 0.5 * description.wall.length ? of_left : of_right) += left[i];
    of_all += all[i];
    CHECK(none[i] == Approx(0.0).margin(1e-12));
  }
  CHECK(of_left > 3.0 * std::abs(of_right));
  CHECK(of_left + of_right == Approx(0.5 * of_all).epsilon(0.1));
}

TEST_CASE("Where half of the bridge is warmer half of it rises, but for what its other half holds back") {
  const BridgeDescription description = test::small_bridge_file().description;
  const Model bridge = make_model(description);
  const auto rise = [&](const Between& between) {
    const IntactBridge truth =
        solve_intact(description, {"joints", scattered_joints(0.0), 1, 1}, between).bridges[0];
    Eigen::Vector2d halves(0.0, 0.0);
    for (std::size_t i = 0; i < truth.before.size(); ++i)
      halves[bridge.control_points[i].position.x() < 0.5 * description.wall.length ? 0 : 1] +=
          truth.after[i] - truth.before[i];
    return halves;
  };
  const Eigen::Vector2d all = rise({.warmer = 5.0}), left = rise({.warmer = 5.0, .warmer_part = 0.5});
  CHECK(left[0] > std::abs(left[1]));
  CHECK(left.sum() == Approx(0.5 * all.sum()).epsilon(0.2));
}

TEST_CASE("Epochs at random are others for each bridge and epoch, the same in every run") {
  const BridgeDescription description = test::small_bridge_file().description;
  const SampledTruth truth{"everything", {}, 2, 1};
  const IntactTruth once = solve_intact(description, truth, {.at_random = true});
  const IntactTruth again = solve_intact(description, truth, {.at_random = true});
  for (std::size_t b = 0; b < 2; ++b) {
    CHECK(once.bridges[b].before == again.bridges[b].before);
    CHECK(once.bridges[b].after == again.bridges[b].after);
    CHECK(once.bridges[b].before != once.bridges[b].after);
  }
}

TEST_CASE("Random pairs are so many different ones of the wall, with the intact bridge") {
  const Model bridge = make_model(test::small_bridge_file().description);
  const std::string list = random_pairs(bridge.layout, 20, 3);
  CHECK(list == random_pairs(bridge.layout, 20, 3));
  CHECK(list != random_pairs(bridge.layout, 20, 4));
  std::set<Scene> scenes;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(';', begin), list.size());
    const Scene scene = parse_scene(list.substr(begin, end - begin), bridge.layout);
    for (const BlockId block : scene.removed) CHECK(bridge.layout[block].role == BlockRole::wall);
    scenes.insert(scene);
    begin = end + 1;
  }
  CHECK(scenes.size() == 21);
  CHECK(scenes.begin()->removed.empty());
  CHECK(std::ranges::all_of(scenes, [](const Scene& scene) { return scene.missing() != 1; }));
}

TEST_CASE("Damaged truths are solved once, and taken from their file then") {
  test::TemporaryFolder folder;
  const BridgeFile file = test::small_bridge_file();
  const SampledTruth truth{"joints", scattered_joints(0.2), 2, 1};
  const DamagedTruth solved = solve_damaged(file, truth, "intact;4,2..3", folder.path());
  const auto written = std::filesystem::last_write_time(folder / "joints.h5");
  const DamagedTruth read = solve_damaged(file, truth, "intact;4,2..3", folder.path());
  CHECK(std::filesystem::last_write_time(folder / "joints.h5") == written);
  REQUIRE(read.bridges.size() == 2);
  REQUIRE(read.bridges[0].damaged.size() == 2);
  CHECK(read.bridges[0].intact == solved.bridges[0].intact);
  CHECK(read.bridges[0].intact != read.bridges[1].intact);
  // The intact bridge of the file is the one that solve_intact finds by itself.
  const IntactTruth intact = solve_intact(file.description, truth, {});
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t point = 0; point < read.bridges[b].intact.size(); ++point)
      CHECK(read.bridges[b].intact[point] == Approx(intact.bridges[b].before[point]).epsilon(1e-6));
}

TEST_CASE("A trial's lookup takes sampled bridges for evidence if it is given them") {
  const Site site;
  std::vector<double> factors = {1.0};
  for (int i = 0; i < 20; ++i) factors.push_back(0.81 + 0.02 * i);
  const Database database = site.write(factors, "sampled.h5"), truth = site.write({1.0, 1.1}, "truth.h5");
  const SensorList sensors = control_point_sensors(database.control_points());
  const TrueBridge bridge = read_true_bridges(truth).front();
  const std::size_t row = database.find(bridge.damaged[3].scene).value();
  const auto tried = [&](std::shared_ptr<const SampledBridges> sampled) {
    Random random(1);
    Asking asking{database, sensors, {}, false, std::move(sampled)};
    asking.lookup.conditions = Conditions::known;
    return ask(asking,
               take_readings({bridge.intact, bridge.damaged[3].lost}, ReadingsTaken::change, 1e-6, random),
               row);
  };
  // All signals are a tenth larger than the nominal bridge's, as sampled bridges let expect.
  CHECK(tried(nullptr).verdict == Verdict::unexplained);
  const Trial unknown = tried(sampled_bridges(database, ScatterEvidence::variants));
  CHECK(unknown.verdict == Verdict::located);
  CHECK(unknown.first);
}
