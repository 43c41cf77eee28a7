#include "lookup/readings/comparison.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "core/error.h"
#include "lookup/readings/sensors_file.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

using namespace voussoir;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> kStates = {"built", "lost", "built:axle", "lost:axle", "lost:truck@2"};
constexpr std::size_t kLost = 1, kLostAxle = 3, kLostTruck = 4;

const Model& small_bridge() {
  static const Model bridge = make_model(test::small_bridge_file().description);
  return bridge;
}

/// Databases of the small bridge with made-up numbers: with load cases, and as version 0.1 had them.
class Shelf {
  test::TemporaryFolder folder_;  // first, as what follows is made in it

 public:
  Database with_loads = make("loads.h5", kStates, KeepField::yes);
  Database plain = make("plain.h5", {"built"}, KeepField::no);

 private:
  Database make(const char* name, const std::vector<std::string>& states, KeepField fields) const {
    DatabaseContent content =
        test::made_up_content(test::small_bridge_file(), small_bridge(),
                              all_scenes(small_bridge().layout.size(), 1), fields, 1, states.size());
    content.states = states;
    for (std::size_t state = 0; state < states.size(); ++state)
      content.model_errors.push_back(
          {0.01 * (1.0 + state), 0.002,
           std::vector<double>(small_bridge().control_points.size(), 1e-5 * (1.0 + state))});
    write_database(folder_ / name, content, [&](std::size_t row) {
      return test::made_up_record(small_bridge(), content.keys[row], states.size(), fields);
    });
    return Database::open(folder_ / name);
  }
};

const Shelf& shelf() {
  static const Shelf shared;
  return shared;
}

Comparison compare_text(const std::string& text, const Database& database, const std::string& sensors = "",
                        const ComparisonSettings& settings = {}) {
  SensorList list = control_point_sensors(database.control_points());
  if (!sensors.empty())
    list = parse_sensors(sensors, "s.csv", database.layout(), database.mesh(), std::move(list));
  return compare(parse_readings(text, "m.csv", list), list, database, settings);
}

bool stands(std::size_t row) {
  return shelf().with_loads.table().outcome[row] == static_cast<std::uint8_t>(Outcome::standing);
}

double stored(std::size_t state, std::size_t row, std::size_t point) {
  return shelf().with_loads.table(kNominalVariant, state).row(row)[point];
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

TEST_CASE("Absolute readings are compared with the database's own table of the history built, not a copy") {
  const Database& database = shelf().with_loads;
  const Comparison comparison = compare_text("point,uy_mm\nT2,-1.5\n", database);
  CHECK(comparison.kind == ReadingKind::absolute);
  CHECK(comparison.history == "built");
  CHECK(comparison.library.table.vertical.data() == database.table().vertical.data());
  CHECK(comparison.library.storage == nullptr);
  CHECK(comparison.measured.displacement[1] == Approx(-1.5e-3));
  CHECK(comparison.measured.count() == 1);
  CHECK(comparison.model_error == database.model_errors()[0]);
  CHECK(compare_text("point,uy_mm\nT2,-1.5\n", database, "", {.history = "lost", .sigma = {}}).history ==
        "lost");
}

TEST_CASE("Changes are compared with the history lost, or with built where the database has only that") {
  for (const char* const text : {"point,change_mm\nT2,-0.25\n", "point,before_mm,after_mm\nT2,100,99.75\n"}) {
    const Comparison lost = compare_text(text, shelf().with_loads);
    CHECK(lost.kind == ReadingKind::change);
    CHECK(lost.history == "lost");
    CHECK(lost.library.table.vertical.data() == shelf().with_loads.table(0, kLost).vertical.data());
    CHECK(lost.measured.displacement[1] == Approx(stored(kLost, 0, 1) - 0.25e-3).epsilon(1e-12));
    CHECK(origin_of(lost)[1] == stored(kLost, 0, 1));
    CHECK(lost.model_error == shelf().with_loads.model_errors()[kLost]);
    CHECK(compare_text(text, shelf().plain).history == "built");
  }
  CHECK(compare_text("point,before_mm,after_mm\nT2,100,99\n", shelf().with_loads).before[1] == Approx(0.1));
}

TEST_CASE("What a load adds is the difference of two states, for scenes that stand in both (brute force)") {
  const Comparison comparison =
      compare_text("point,load,uy_mm\nT2,axle,-1\nT2,truck@2,-2\nA1,axle,\n", shelf().with_loads);
  CHECK(comparison.kind == ReadingKind::load);
  CHECK(comparison.history == "lost");
  REQUIRE(comparison.library.points.size() == 3);
  CHECK(comparison.library.points[1].name == "T2 under truck@2");
  const std::size_t a1 = 14;  // after the corners of the seven blocks on top
  REQUIRE(shelf().with_loads.control_points()[a1].name == "A1");
  int standing = 0;
  for (std::size_t row = 0; row < comparison.library.table.rows; ++row) {
    const auto shown = comparison.library.table.row(row);
    const auto added = [&](std::size_t state, std::size_t point) {
      return stands(row) ? stored(state, row, point) - stored(kLost, row, point) : std::nan("");
    };
    CHECK(same(shown[0], added(kLostAxle, 1)));
    CHECK(same(shown[1], added(kLostTruck, 1)));
    CHECK(same(shown[2], added(kLostAxle, a1)));
    standing += stands(row) ? 1 : 0;
  }
  CHECK(standing > 10);
  CHECK(comparison.measured.displacement[0] == Approx(-1e-3));
  CHECK(comparison.measured.silent[2]);
  CHECK(comparison.levelling == std::vector<int>{0, 1, 0});
}

TEST_CASE("How much more a load adds counts from what it adds to the intact bridge") {
  const Comparison comparison =
      compare_text("point,load,before_mm,after_mm\nT2,axle,-1,-1.25\n", shelf().with_loads);
  CHECK(comparison.kind == ReadingKind::load_change);
  CHECK(comparison.measured.displacement[0] ==
        Approx(stored(kLostAxle, 0, 1) - stored(kLost, 0, 1) - 0.25e-3).epsilon(1e-12));
}

TEST_CASE("A load that only the history built has is compared with that history") {
  const std::string text = "point,load,uy_mm\nT2,axle,-1\n";
  CHECK(compare_text(text, shelf().with_loads, "", {.history = "built", .sigma = {}}).history == "built");
}

TEST_CASE(
    "A sensor at a control point shows what the table holds there (the table is written from other "
    "numbers)") {
  const Database& database = shelf().with_loads;
  const StoredPoint& point = database.control_points()[2];
  const std::string sensors = fmt::format("name;quantity;x_m;y_m;block\nV;uy;{};{};{}\n", point.position.x(),
                                          point.position.y(), database.layout()[point.block].label);
  const Comparison change = compare_text("point,change_mm\nV,-1\nT1,-1\n", database, sensors);
  CHECK(change.library.points[0].block == point.block);
  for (std::size_t row = 0; row < change.library.table.rows; ++row) {
    const double shown = change.library.table.row(row)[0];
    const double expected = stored(kLost, row, 2);
    CHECK((std::isnan(expected) ? std::isnan(shown) : shown == Approx(expected).epsilon(1e-12)));
    CHECK(same(change.library.table.row(row)[1], stored(kLost, row, 0)));
    CHECK(change.library.table.outcome[row] == database.table(0, kLost).outcome[row]);
  }
  const Comparison load = compare_text("point,load,change_mm\nV,axle,-1\n", database, sensors);
  CHECK(load.library.table.row(0)[0] == Approx(stored(kLostAxle, 0, 2) - stored(kLost, 0, 2)).epsilon(1e-12));
}

TEST_CASE("Heights share a level under each load, and tilts and distances have none") {
  const Comparison comparison = compare_text("point,change_mm\nR,0.1\nT1,-1\nT2,-1\n", shelf().with_loads,
                                             "name;quantity;block\nR;tilt;2,1\n");
  CHECK(comparison.levelling == std::vector<int>{kNoLevelling, 0, 0});
}

TEST_CASE("Levellings that a file names are told apart, under each load, too (written out)") {
  const Comparison change = compare_text(
      "point,change_mm,levelling\nT1,-1,road\nT2,-1,\"below\"\nT3,-1,\nT4,-1,road\n", shelf().with_loads);
  REQUIRE(change.levelling.size() == shelf().with_loads.control_points().size());
  CHECK(change.levelling[0] == change.levelling[3]);
  CHECK(change.levelling[0] != change.levelling[1]);
  CHECK(change.levelling[0] != change.levelling[2]);
  CHECK(change.levelling[1] != change.levelling[2]);
  CHECK(change.quantity.empty());  // all are heights of control points
  const Comparison load = compare_text(
      "point,load,uy_mm,levelling\nT1,axle,-1,road\nT1,truck@2,-2,road\nT2,axle,-1,road\nT3,axle,-1,below\n",
      shelf().with_loads);
  CHECK(load.levelling == std::vector<int>{0, 1, 0, 2});
  CHECK(compare_text("point,change_mm,levelling\nT1,-1,road\n", shelf().with_loads).levelling ==
        compare_text("point,change_mm\nT1,-1\n", shelf().with_loads).levelling);
}

TEST_CASE(
    "The errors of what a load adds are those of both states, of other sensors the share of control points") {
  const Comparison comparison = compare_text("point,load,value_mm\nT2,axle,-1\nV,axle,1\n",
                                             shelf().with_loads, "name;quantity;x_m;y_m\nV;uy;0,5;0,75\n");
  CHECK(comparison.model_error.share == Approx(0.04));  // of the fourth state, the largest
  CHECK(comparison.model_error.common == Approx(0.002));
  REQUIRE(comparison.model_error.intact.size() == 2);
  CHECK(comparison.model_error.intact[0] == Approx(2e-5));  // 4e-5 less 2e-5
  double square = 0.0;
  const std::size_t points = small_bridge().control_points.size();
  for (std::size_t i = 0; i < points; ++i)
    square += std::pow(stored(kLost, 0, i), 2) / static_cast<double>(points);
  CHECK(comparison.model_error.intact[1] ==
        Approx(2e-5 / std::sqrt(square) * std::abs(comparison.library.table.row(0)[1])));
}

TEST_CASE("A sigma for all is that of the readings without their own") {
  const Comparison comparison = compare_text("point,change_mm,sigma_mm\nT1,1,0.5\nT2,1,\n",
                                             shelf().with_loads, "", {.history = {}, .sigma = 2e-5});
  CHECK(comparison.measured.sigma[0] == Approx(5e-4));
  CHECK(comparison.measured.sigma[1] == 2e-5);
  CHECK(std::isnan(comparison.measured.sigma[2]));
}

TEST_CASE("What the database lacks is refused with what it has") {
  const auto message = [](const std::string& text, const Database& database, const std::string& sensors,
                          const ComparisonSettings& settings) {
    try {
      compare_text(text, database, sensors, settings);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK(message("point,load,uy_mm\nT1,axle,1\nT1,tram,1\n", shelf().with_loads, "", {}) ==
        "m.csv:3: the database has no load 'tram' after the history 'lost', expected one of axle, truck@2");
  CHECK_THAT(
      message("point,load,uy_mm\nT1,axle,1\n", shelf().plain, "", {}),
      Contains("m.csv:2: the database has no load 'axle' after the history 'built', expected a database "
               "built with load cases"));
  CHECK_THAT(message("point,uy_mm\nT1,1\n", shelf().plain, "", {.history = "lost", .sigma = {}}),
             Contains("plain.h5: has no history 'lost' but the states built"));
  CHECK_THAT(message("point,change_mm\nR,1\n", shelf().plain, "name;quantity;block\nR;tilt;2,1\n", {}),
             Contains("holds no fields"));
}

TEST_CASE("A database of a bridge that does not stand is named, and what was expected (all NaN)") {
  const test::TemporaryFolder folder;
  const DatabaseContent content = test::made_up_content(
      test::small_bridge_file(), small_bridge(), all_scenes(small_bridge().layout.size(), 1), KeepField::no);
  write_database(folder / "fallen.h5", content, [&](std::size_t row) {
    Record record = test::made_up_record(small_bridge(), content.keys[row], 1, KeepField::no);
    std::ranges::fill(record.states[0].vertical, std::numeric_limits<double>::quiet_NaN());
    return record;
  });
  CHECK_THROWS_WITH(
      compare_text("point,uy_mm\nT1,1\n", Database::open(folder / "fallen.h5")),
      Contains(
          "fallen.h5: the intact bridge shows nothing of what was read, as it does not stand: expected") &&
          Contains("of a bridge that stands"));
}
