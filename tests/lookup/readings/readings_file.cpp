/// @file What files of readings mean. Oracle: the values written out.

#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "lookup/readings/readings_file.h"
#include "tests/support/temporary_folder.h"

using namespace voussoir;

namespace {

/// Two top blocks that share the corner at x = 1, and one point on the intrados.
const std::vector<StoredPoint> kPoints = {{"T1", Point(0, 6), BlockId{0}},
                                          {"T2", Point(1, 6), BlockId{0}},
                                          {"T3", Point(1, 6), BlockId{1}},
                                          {"T4", Point(2, 6), BlockId{1}},
                                          {"A1", Point(1, 2), BlockId{2}}};

ReadingsFile parse(const std::string& text) {
  return parse_readings(text, "m.csv", control_point_sensors(kPoints));
}

/// The only reading of a file [m].
double value_in(const std::string& text) {
  const ReadingsFile file = parse(text);
  REQUIRE(file.readings.size() == 1);
  return file.readings.front().value;
}

std::string error_of_file(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("Displacements are read in metres with up positive, whatever the column's unit and sign") {
  CHECK(value_in("point,uy_mm\nT2,-3.5\n") == Approx(-3.5e-3).epsilon(1e-15));
  CHECK(value_in("point,uy_m\nT2,-3.5e-3\n") == -3.5e-3);
  CHECK(value_in("point,settlement_mm\nT2,3.5\n") == Approx(-3.5e-3).epsilon(1e-15));
  CHECK(value_in("point,value_mm\nT2,+3.5\n") == Approx(3.5e-3).epsilon(1e-15));
  CHECK(value_in("point,settlement_m\nT2,3.5e-3\n") == -3.5e-3);
  CHECK(value_in("point,change_m\nT2,3.5e-3\n") == 3.5e-3);
  for (const char* header : {"Change [mm]", "change(mm)", "CHANGE  mm", " Change_ [ mm ]"})
    CHECK(value_in(std::string("Point;") + header + "\nT2;3,5\n") == Approx(3.5e-3).epsilon(1e-15));
  CHECK(parse("point,uy_mm,sigma_m\nT1,-1,0.00000006\n").readings.front().sigma == 6e-8);
}

TEST_CASE("Heights above a datum are read as such, and only their difference has to be a displacement") {
  CHECK(value_in("point,before_m,after_m\nT2,412.3456,412.3421\n") == Approx(-3.5e-3).epsilon(1e-9));
  CHECK(value_in("point,before_mm,after_mm\nT2,412345.6,412342.1\n") == Approx(-3.5e-3).epsilon(1e-9));
}

TEST_CASE("A remark is not read, and coordinates beside a name say where it is") {
  const ReadingsFile read = parse("point,x_m,y_m,change_mm,remark\nT3,1.02,6,0.5,\"wet, 4 C\"\n");
  REQUIRE(read.readings.size() == 1);
  CHECK(read.readings.front().sensor == 2);
  CHECK(parse("point,x_m,y_m,change_mm\nT3,,,0.5\n").readings.front().sensor == 2);
  SensorList list = control_point_sensors(kPoints);
  list.sensors.push_back({"N1", Quantity::tilt, Point(1, 1), {BlockId{1}}, {{NodeId{0}, Point(0, 1)}}});
  CHECK(parse_readings("point,x_m,y_m,change_mm\nN1,1.4,0.8,0.5\n", "m.csv", list).readings.front().sensor ==
        5);
}

TEST_CASE("Any subset of points in any order is a valid file, and sensors without reading are silent") {
  const ReadingsFile read = parse("uy_mm,point\n1,A1\n,T1\nNaN,T2\nnan,T3\n");
  REQUIRE(read.readings.size() == 4);
  CHECK(read.readings[0].sensor == 4);
  CHECK(read.readings[0].value == Approx(1e-3));
  for (const std::size_t i : {0U, 1U, 2U}) {
    CHECK(read.readings[i + 1].sensor == i);
    CHECK(read.readings[i + 1].silent);
    CHECK(std::isnan(read.readings[i + 1].value));
  }
}

TEST_CASE("Columns say what readings are the difference of") {
  const auto kind_of = [](const std::string& text) { return parse(text).kind; };
  CHECK(kind_of("point,uy_mm\nT1,1\n") == ReadingKind::absolute);
  CHECK(kind_of("point,change_mm\nT1,1\n") == ReadingKind::change);
  CHECK(kind_of("point,before_mm,after_mm\nT1,1,2\n") == ReadingKind::change);
  CHECK(kind_of("point,load,uy_mm\nT1,axle,1\n") == ReadingKind::load);
  CHECK(kind_of("point,load,change_mm\nT1,axle,1\n") == ReadingKind::load);
  CHECK(kind_of("point,load,before_mm,after_mm\nT1,axle,1,2\n") == ReadingKind::load_change);
}

TEST_CASE(
    "Of two epochs the change is the second less the first, and silence counts only after a first reading") {
  const ReadingsFile read =
      parse("point,before_mm,after_mm,sigma_mm\nT1,101.25,101.00,0.02\nT2,1,,\nT3,,1,\nT4,,,\n");
  REQUIRE(read.two_epochs);
  CHECK(read.readings[0].value ==
        Approx(-0.25e-3).epsilon(1e-12));  // 17 digits less 3 lost in the difference
  CHECK(read.readings[0].before == Approx(101.25e-3));
  CHECK(read.readings[0].after == Approx(101e-3));
  CHECK(read.readings[0].sigma == Approx(0.02e-3));
  for (const std::size_t i : {1U, 2U, 3U}) CHECK(std::isnan(read.readings[i].value));
  CHECK(read.readings[1].silent);
  CHECK_FALSE(read.readings[2].silent);
  CHECK_FALSE(read.readings[3].silent);
}

TEST_CASE("What loggers write where there is no reading is refused, other numbers with nines are read") {
  const auto read = [](const std::string& columns, const std::string& value) {
    return [=] { parse(columns + "\nT1," + value + "\n"); };
  };
  for (const std::string value : {"-9999", "9999", "-999.9", "99999.0", "-999"})
    CHECK_THROWS_WITH(read("point,change_mm", value)(),
                      Catch::Contains("what loggers write where there is no reading"));
  for (const std::string value : {"9.999", "-0.9999", "99.99", "-990", "909", "0.999"})
    CHECK_NOTHROW(read("point,change_mm", value)());
  CHECK_NOTHROW(read("point,before_mm,after_mm", "9999,9999.9")());
  CHECK_THROWS_WITH(read("point,before_mm,after_mm", "12.5,-9999")(),
                    Catch::Contains("'-9999' is what loggers write"));
}

TEST_CASE("A point may come once under each load") {
  const ReadingsFile read = parse("point,load,uy_mm\nT1,axle,-1\nT1,truck@2,-2\nT2,axle,-3\n");
  REQUIRE(read.readings.size() == 3);
  CHECK(read.readings[1].sensor == 0);
  CHECK(read.readings[1].load == "truck@2");
  CHECK(error_of_file("point,load,uy_mm\nT1,axle,-1\nT1,axle,-2\n") ==
        "m.csv:3: point T1 is given again, expected each point once under a load (first in line 2)");
}

TEST_CASE("Comments, empty lines, blanks, quotation marks, CRLF and a byte order mark are understood") {
  const ReadingsFile read = parse(
      "\xEF\xBB\xBF# levelling of May\r\n\r\n Point , \"UY_mm\" \r\nT1, -1 # left end\r\n   "
      "\r\n\"T4\",-2\r\n");
  REQUIRE(read.readings.size() == 2);
  CHECK(read.readings[0].value == Approx(-1e-3));
  CHECK(read.readings[1].sensor == 3);
  CHECK(value_in("point,uy_mm\nT1,1") == Approx(1e-3));
}

TEST_CASE("Numbers are read with a point as decimal mark in every locale") {
  const char* const set = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  CHECK(value_in("point,uy_mm\nT1,-1.25\n") == Approx(-1.25e-3));
  std::setlocale(LC_NUMERIC, "C");
  INFO("locale " << (set != nullptr ? set : "not installed"));
}

TEST_CASE("Coordinates mean no tilt and no gauge, however near it is") {
  std::vector<StoredPoint> points = kPoints;
  points.push_back({"N1", Point(1, 2), BlockId{2}, Quantity::tilt});
  points.insert(points.begin(), {"H1", Point(1, 2), BlockId{2}, Quantity::ux});
  const std::string text = "x_m,y_m,change_mm\n1,2,-3\n";
  const ReadingsFile read = parse_readings(text, "m.csv", control_point_sensors(points));
  CHECK(points[read.readings[0].sensor].name == "A1");
  const SensorList no_height = control_point_sensors({points.front(), points.back()});
  CHECK_THROWS_MATCHES(parse_readings(text, "m.csv", no_height), InputError,
                       Catch::Matchers::Message("m.csv:2: no sensor of vertical displacements in the "
                                                "database, expected sensors by name in a column point"));
}

TEST_CASE("Coordinates mean the nearest control point, and twins at one place are taken from left to right") {
  const ReadingsFile read = parse("x_m,y_m,uy_mm\n1.02,5.99,-1\n1.0,6.0,-2\n1,2,-3\n");
  CHECK(read.readings[0].sensor == 1);
  CHECK(read.readings[1].sensor == 2);
  CHECK(read.readings[2].sensor == 4);
  const ReadingsFile loads = parse("x_m,y_m,load,uy_mm\n1,6,a,-1\n1,6,b,-2\n1,6,a,-3\n1,6,b,-4\n");
  for (const std::size_t i : {0U, 1U}) CHECK(loads.readings[i].sensor == 1);
  for (const std::size_t i : {2U, 3U}) CHECK(loads.readings[i].sensor == 2);
  CHECK(error_of_file("x_m,y_m,uy_mm\n1,6,-1\n1,6,-2\n1,6,-3\n") ==
        "m.csv:4: point T2 is given again, expected each point once (first in line 2)");
  CHECK(error_of_file("x_m,y_m,uy_mm\n1,6.2,-1\n") ==
        "m.csv:2: no control point at x = 1 m, y = 6.2 m: the nearest, T2, is 0.2 m away, expected at most "
        "0.05 m");
}

TEST_CASE("A sensor's own sigma is read in its column's unit") {
  CHECK(parse("point,uy_mm,sigma_m\nT1,-1,0.0002\n").readings.front().sigma == 2e-4);
  const ReadingsFile read = parse("point,uy_mm,sigma_mm\nT1,-1,0.2\nT2,-1,\n");
  CHECK(read.readings[0].sigma == Approx(2e-4));
  CHECK(std::isnan(read.readings[1].sigma));
}

TEST_CASE("Long and unprintable texts are shortened and cleaned in messages") {
  const std::string message = error_of_file("point,uy_mm\n" + std::string(10000, 'x') + "\x01,1\n");
  CHECK(message == "m.csv:2: unknown point '" + std::string(40, 'x') +
                       "...', expected T1 to T4, A1, or a sensor of a file that --sensors names");
  CHECK(error_of_file("point,uy_mm\n\x1b[2J,1\n") ==
        "m.csv:2: unknown point '?[2J', expected T1 to T4, A1, or a sensor of a file that --sensors names");
}

TEST_CASE("A number too large for a double is refused in every spelling, and one too small is zero") {
  const std::string zeros(400, '0');
  for (const std::string& huge :
       {std::string("1e400"), std::string("-1e+999"), "1" + zeros, "1" + zeros + ".5", std::string(400, '9'),
        "0." + zeros + "1e900", "1" + zeros + "e-20", std::string("1e99999999999999999999")}) {
    const std::string error = error_of_file("point,uy_m\nT1," + huge + "\n");
    INFO(huge);
    CHECK(error.find("is no finite number, expected a displacement or nothing") != std::string::npos);
    CHECK(error_of_file("point,uy_mm,sigma_mm\nT1,1," + huge + "\n").find("is no sigma") !=
          std::string::npos);
    CHECK(error_of_file("x_m,y_m,uy_mm\n" + huge + ",1,1\n").find("is no coordinate") != std::string::npos);
  }
  for (const std::string& tiny : {std::string("1e-999"), "0." + zeros + "1", "-1" + zeros + "e-900",
                                  std::string("1e-99999999999999999999")})
    CHECK(value_in("point,uy_mm\nT1," + tiny + "\n") == 0.0);
}

TEST_CASE("A file that cannot be read is named with the reason, and so is a file that is too large") {
  const test::TemporaryFolder folder;
  const SensorList sensors = control_point_sensors(kPoints);
  CHECK_THROWS_WITH(read_readings(folder / "none.csv"),
                    (folder / "none.csv").string() +
                        ": cannot be read (No such file or directory), expected a CSV file of measurements");
  CHECK_THROWS_WITH(
      read_readings(folder.path()),
      folder.path().string() + ": cannot be read (Is a directory), expected a CSV file of measurements");
  CHECK_THROWS_WITH(read_readings("/dev/zero"),
                    "/dev/zero: larger than 4 MiB, expected a CSV file of measurements");
  std::ofstream(folder / "good.csv") << "point,uy_mm\nT1,-1\n";
  const auto [text, name] = read_readings(folder / "good.csv");
  CHECK(name == (folder / "good.csv").string());
  CHECK(parse_readings(text, name, sensors).readings.size() == 1);
}
