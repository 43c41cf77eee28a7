/// @file Databases that are weighed against each other. Oracle: places and names written down; Bayes' rule by
/// hand.

#include "lookup/weighed_databases.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/error.h"

using namespace voussoir;
using Catch::Matchers::Message;

namespace {

DatabaseReadings readings_in(const std::string& file, double width, const Point& crown) {
  return {
      file, width, {{"T1", {Point(0.0, 3.0), Quantity::uy}}, {"A4", {crown, Quantity::uy}}}, {"T1", "A4"}};
}

AskedDatabase asked(const std::string& file, Verdict verdict, const std::string& first, double log_evidence) {
  return {.file = file,
          .bridge = "bridge",
          .digest = "0123456789abcdef",
          .verdict = verdict,
          .first = first,
          .log_evidence = log_evidence};
}

}  // namespace

TEST_CASE("Databases are of one bridge if no sensor is further apart than half a metre") {
  const DatabaseReadings thick = readings_in("thick.h5", 20.0, Point(3.0, 2.0));
  CHECK_NOTHROW(require_one_bridge(std::vector{thick, readings_in("thin.h5", 20.0, Point(3.0, 2.499))}));
  CHECK_THROWS_MATCHES(
      require_one_bridge(std::vector{thick, thick, readings_in("other.h5", 20.0, Point(3.0, 2.501))}),
      InputError,
      Message("sensor A4 is at x 3, y 2 m in thick.h5 and at x 3, y 2.501 m in other.h5, expected at most "
              "0.5 m in between: several databases are one bridge under different assumptions"));
}

TEST_CASE("Of a short bridge they may be a twentieth of its width apart") {
  const DatabaseReadings one = readings_in("a.h5", 4.0, Point(3.0, 2.0));
  CHECK_NOTHROW(require_one_bridge(std::vector{one, readings_in("b.h5", 5.0, Point(3.19, 2.0))}));
  CHECK_THROWS_AS(require_one_bridge(std::vector{one, readings_in("b.h5", 5.0, Point(3.21, 2.0))}),
                  InputError);
}

TEST_CASE("A sensor of one name reads the same of one bridge") {
  const DatabaseReadings one = readings_in("a.h5", 20.0, Point(3.0, 2.0));
  DatabaseReadings other = readings_in("b.h5", 20.0, Point(3.0, 2.0));
  other.sensors.at("A4").quantity = Quantity::tilt;
  CHECK_THROWS_MATCHES(require_one_bridge(std::vector{one, other}), InputError,
                       Message("sensor A4 reads uy in a.h5 and tilt in b.h5, expected the same in both"));
}

TEST_CASE("As many readings in each database are not the same ones") {
  const DatabaseReadings all = readings_in("all.h5", 20.0, Point(3.0, 2.0));
  DatabaseReadings left = all, right = all;
  CHECK_NOTHROW(require_same_readings(std::vector{all, left}));
  left.counted = {"T1"};
  right.counted = {"A4"};
  left.file = "left.h5", right.file = "right.h5";
  CHECK_THROWS_MATCHES(
      require_same_readings(std::vector{left, right}), InputError,
      Message("the reading of T1 counts in left.h5 and not in right.h5, as the point is held there: "
              "expected errors that are no share of what moves (sigma_mm or --sigma)"));
  CHECK_THROWS_AS(require_same_readings(std::vector{left, all}), InputError);
}

TEST_CASE("Assumptions are as likely as they make the readings, however unlikely these are (by hand)") {
  for (const double shift : {0.0, -2000.0, 2000.0}) {
    std::vector<AskedDatabase> databases = {asked("a", Verdict::intact, "intact", shift + std::log(1.0)),
                                            asked("b", Verdict::intact, "intact", shift + std::log(6.0)),
                                            asked("c", Verdict::intact, "intact", shift + std::log(3.0))};
    weigh(databases);
    CHECK(databases[0].file == "b");
    CHECK(databases[1].file == "c");
    CHECK(databases[0].probability == Approx(0.6));
    CHECK(databases[1].probability == Approx(0.3));
    CHECK(databases[2].probability == Approx(0.1));
  }
}

TEST_CASE("A database in which no scene is possible is excluded, unless none has one") {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::vector<AskedDatabase> databases = {asked("a", Verdict::unexplained, "", kNever),
                                          asked("b", Verdict::intact, "intact", -5.0)};
  weigh(databases);
  CHECK(databases[0].file == "b");
  CHECK(databases[0].probability == 1.0);
  CHECK(databases[1].probability == 0.0);
  databases[0].log_evidence = kNever;
  weigh(databases);
  CHECK(databases[0].probability == 0.5);
  CHECK(databases[1].probability == 0.5);
}

TEST_CASE("An answer is contested by a database that counts and says anything else") {
  const auto contested = [](Verdict one, const std::string& its, Verdict other, const std::string& others,
                            double odds) {
    std::vector<AskedDatabase> databases = {asked("a", one, its, 0.0),
                                            asked("b", other, others, -std::log(odds))};
    weigh(databases);
    return is_contested(databases);
  };
  CHECK(contested(Verdict::intact, "intact", Verdict::located, "4,2", 18.9));        // 1 in 19.9
  CHECK_FALSE(contested(Verdict::intact, "intact", Verdict::located, "4,2", 19.1));  // less than 1 in 20
  CHECK(contested(Verdict::located, "4,2", Verdict::located, "4,3", 2.0));
  CHECK_FALSE(contested(Verdict::located, "4,2", Verdict::located, "4,2", 2.0));
  CHECK_FALSE(contested(Verdict::damaged_unlocated, "4,2", Verdict::damaged_unlocated, "4,3", 2.0));
  CHECK(contested(Verdict::intact, "intact", Verdict::cannot_tell, "intact", 2.0));
  CHECK(contested(Verdict::damaged_unlocated, "4,2", Verdict::unexplained, "4,2", 2.0));
}
