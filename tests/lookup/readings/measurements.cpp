#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "lookup/readings/measurements.h"
#include "tests/support/temporary_folder.h"

using namespace voussoir;

namespace {

/// Two top blocks that share the corner at x = 1, and one point on the intrados.
const std::vector<StoredPoint> kPoints = {{"T1", Point(0, 6), BlockId{0}},
                                          {"T2", Point(1, 6), BlockId{0}},
                                          {"T3", Point(1, 6), BlockId{1}},
                                          {"T4", Point(2, 6), BlockId{1}},
                                          {"A1", Point(1, 2), BlockId{2}}};

Measurements parse(const std::string& text) {
  return parse_measurements(text, "m.csv", kPoints);
}

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("Displacements are read in metres with up positive, whatever the column's unit and sign") {
  CHECK(parse("point,uy_mm\nT2,-3.5\n").displacement[1] == Approx(-3.5e-3).epsilon(1e-15));
  CHECK(parse("point,uy_m\nT2,-3.5e-3\n").displacement[1] == -3.5e-3);
  CHECK(parse("point,settlement_mm\nT2,3.5\n").displacement[1] == Approx(-3.5e-3).epsilon(1e-15));
  CHECK(parse("point,uy_mm\nT2,+3.5\n").displacement[1] == Approx(3.5e-3).epsilon(1e-15));
}

TEST_CASE(
    "Any subset of points in any order is a valid file, and sensors without reading count for nothing") {
  const Measurements read = parse("uy_mm,point\n1,A1\n,T1\nNaN,T2\nnan,T3\n");
  CHECK(read.count() == 1);
  CHECK(read.displacement[4] == Approx(1e-3));
  for (const std::size_t i : {0U, 1U, 2U, 3U}) CHECK(std::isnan(read.displacement[i]));
}

TEST_CASE("Comments, empty lines, blanks, quotation marks, CRLF and a byte order mark are understood") {
  const Measurements read = parse(
      "\xEF\xBB\xBF# levelling of May\r\n\r\n point , \"uy_mm\" \r\nT1, -1 # left end\r\n   "
      "\r\n\"T4\",-2\r\n");
  CHECK(read.count() == 2);
  CHECK(read.displacement[0] == Approx(-1e-3));
  CHECK(read.displacement[3] == Approx(-2e-3));
  CHECK(parse("point,uy_mm\nT1,1").count() == 1);
}

TEST_CASE("Numbers are read with a point as decimal mark in every locale") {
  const char* const set = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  CHECK(parse("point,uy_mm\nT1,-1.25\n").displacement[0] == Approx(-1.25e-3));
  std::setlocale(LC_NUMERIC, "C");
  INFO("locale " << (set != nullptr ? set : "not installed"));
}

TEST_CASE("Coordinates mean the nearest control point, and twins at one place are taken from left to right") {
  const Measurements read = parse("x_m,y_m,uy_mm\n1.02,5.99,-1\n1.0,6.0,-2\n1,2,-3\n");
  CHECK(read.displacement[1] == Approx(-1e-3));
  CHECK(read.displacement[2] == Approx(-2e-3));
  CHECK(read.displacement[4] == Approx(-3e-3));
  CHECK(error_of("x_m,y_m,uy_mm\n1,6,-1\n1,6,-2\n1,6,-3\n") ==
        "m.csv:4: point T2 is given again, expected each point once (first in line 2)");
  CHECK(error_of("x_m,y_m,uy_mm\n1,6.2,-1\n") ==
        "m.csv:2: no control point at x = 1 m, y = 6.2 m: the nearest, T2, is 0.2 m away, expected at most "
        "0.05 m");
}

TEST_CASE("A sensor's own sigma is read in millimetres") {
  const Measurements read = parse("point,uy_mm,sigma_mm\nT1,-1,0.2\nT2,-1,\n");
  CHECK(read.sigma[0] == Approx(2e-4));
  CHECK(std::isnan(read.sigma[1]));
  CHECK(error_of("point,uy_mm,sigma_mm\nT1,-1,0\n") ==
        "m.csv:2: '0' is no sigma, expected a positive number of millimetres or nothing");
  CHECK(error_of("point,uy_mm,sigma_mm\nT1,-1,inf\n") ==
        "m.csv:2: 'inf' is no sigma, expected a positive number of millimetres or nothing");
}

TEST_CASE("Bad headers are refused with the file, the line, the value and what was expected") {
  const std::string columns =
      "expected point or x_m,y_m; one of uy_mm, uy_m, settlement_mm; optionally sigma_mm";
  CHECK(error_of("") ==
        "m.csv: the file is empty, expected a header line "
        "(point or x_m,y_m; one of uy_mm, uy_m, settlement_mm; optionally sigma_mm)");
  CHECK(error_of("# only a comment\n").find("m.csv: the file is empty") == 0);
  CHECK(error_of("point,uy_cm\nT1,1\n") == "m.csv:1: unknown column 'uy_cm', " + columns);
  CHECK(error_of("point,uy_mm,note\nT1,1,x\n") == "m.csv:1: unknown column 'note', " + columns);
  CHECK(error_of("T1,-3.2\n") == "m.csv:1: unknown column 'T1', " + columns);
  CHECK(error_of("point;uy_mm\nT1;1\n") == "m.csv:1: unknown column 'point;uy_mm', " + columns);
  CHECK(error_of("point\nT1\n") == "m.csv:1: no value column, " + columns);
  CHECK(error_of("uy_mm\n1\n") == "m.csv:1: no single way to name a point, " + columns);
  CHECK(error_of("point,x_m,y_m,uy_mm\n") == "m.csv:1: no single way to name a point, " + columns);
  CHECK(error_of("x_m,uy_mm\n1,1\n") == "m.csv:1: no single way to name a point, " + columns);
  CHECK(error_of("point,uy_mm,uy_m\nT1,1,1\n") ==
        "m.csv:1: column 'uy_m' is given twice or beside another value column, " + columns);
  CHECK(error_of("point,point,uy_mm\n") ==
        "m.csv:1: column 'point' is given twice or beside another value column, " + columns);
  CHECK(error_of("point,uy_mm\n") ==
        "m.csv: no usable row, expected at least one control point with a displacement");
  CHECK(error_of("point,uy_mm\nT1,\n") ==
        "m.csv: no usable row, expected at least one control point with a displacement");
}

TEST_CASE("Bad rows are refused with the file, the line, the value and what was expected") {
  CHECK(error_of("# x\npoint,uy_mm\nT1,1\nT99,1\n") == "m.csv:4: unknown point 'T99', expected T1 to A1");
  CHECK(error_of("point,uy_mm\nT1,1\nT2,1\nT1,2\n") ==
        "m.csv:4: point T1 is given again, expected each point once (first in line 2)");
  CHECK(error_of("point,uy_mm\nT1,soft\n") ==
        "m.csv:2: 'soft' is no finite number, expected a displacement or nothing");
  CHECK(error_of("point,uy_mm\nT1,1.5mm\n") ==
        "m.csv:2: '1.5mm' is no finite number, expected a displacement or nothing");
  CHECK(error_of("point,uy_mm\nT1,0x10\n") ==
        "m.csv:2: '0x10' is no finite number, expected a displacement or nothing");
  CHECK(error_of("point,uy_mm\nT1,-inf\n") ==
        "m.csv:2: '-inf' is no finite number, expected a displacement or nothing");
  CHECK(error_of("point,uy_mm\nT1,1e999\n") ==
        "m.csv:2: '1e999' is no finite number, expected a displacement or nothing");
  CHECK(error_of("point,uy_m\nT1,-350\n") ==
        "m.csv:2: '-350' is a displacement of 350 m, expected at most 100 m (check the units)");
  CHECK(error_of("point,uy_mm\nT1,-3,5\n") == "m.csv:2: 3 values, expected 2 as in the header");
  CHECK(error_of("point,uy_mm\nT1\n") == "m.csv:2: 1 values, expected 2 as in the header");
  CHECK(error_of("x_m,y_m,uy_mm\n1,high,1\n") ==
        "m.csv:2: 'high' is no coordinate, expected a number in metres");
  CHECK(error_of("x_m,y_m,uy_mm\nnan,1,1\n") ==
        "m.csv:2: 'nan' is no coordinate, expected a number in metres");
  CHECK(error_of(std::string("point,uy_mm\nT1,1\0\n", 19)) ==
        "m.csv:1: the file holds binary data, expected CSV");
  CHECK(error_of("\xFF\xFEp") == "m.csv:1: the file is UTF-16, expected UTF-8 (save it as plain CSV)");
}

TEST_CASE("Long and unprintable texts are shortened and cleaned in messages") {
  const std::string message = error_of("point,uy_mm\n" + std::string(10000, 'x') + "\x01,1\n");
  CHECK(message == "m.csv:2: unknown point '" + std::string(40, 'x') + "...', expected T1 to A1");
  CHECK(error_of("point,uy_mm\n\x1b[2J,1\n") == "m.csv:2: unknown point '?[2J', expected T1 to A1");
}

TEST_CASE("A number too large for a double is refused in every spelling, and one too small is zero") {
  const std::string zeros(400, '0');
  for (const std::string& huge :
       {std::string("1e400"), std::string("-1e+999"), "1" + zeros, "1" + zeros + ".5", std::string(400, '9'),
        "0." + zeros + "1e900", "1" + zeros + "e-20", std::string("1e99999999999999999999")}) {
    const std::string error = error_of("point,uy_m\nT1," + huge + "\n");
    INFO(huge);
    CHECK(error.find("is no finite number, expected a displacement or nothing") != std::string::npos);
    CHECK(error_of("point,uy_mm,sigma_mm\nT1,1," + huge + "\n").find("is no sigma") != std::string::npos);
    CHECK(error_of("x_m,y_m,uy_mm\n" + huge + ",1,1\n").find("is no coordinate") != std::string::npos);
  }
  for (const std::string& tiny : {std::string("1e-999"), "0." + zeros + "1", "-1" + zeros + "e-900",
                                  std::string("1e-99999999999999999999")})
    CHECK(parse("point,uy_mm\nT1," + tiny + "\n").displacement[0] == 0.0);
}

TEST_CASE("A file that cannot be read is named with the reason, and so is a file that is too large") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(read_measurements(folder / "none.csv", kPoints),
                    (folder / "none.csv").string() +
                        ": cannot be read (No such file or directory), expected a CSV file of measurements");
  CHECK_THROWS_WITH(
      read_measurements(folder.path(), kPoints),
      folder.path().string() + ": cannot be read (Is a directory), expected a CSV file of measurements");
  CHECK_THROWS_WITH(read_measurements("/dev/zero", kPoints),
                    "/dev/zero: larger than 4 MiB, expected a CSV file of measurements");
  std::ofstream(folder / "good.csv") << "point,uy_mm\nT1,-1\n";
  CHECK(read_measurements(folder / "good.csv", kPoints).count() == 1);
}
