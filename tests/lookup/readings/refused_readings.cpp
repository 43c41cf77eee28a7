/// @file Wrong files of readings, one a line: each is refused with the file, the line and what was expected.

#include <catch2/catch.hpp>

#include "core/error.h"
#include "lookup/readings/readings_file.h"

using namespace voussoir;

namespace {

const std::vector<StoredPoint> kThreePoints = {
    {"T1", Point(0, 6), BlockId{0}}, {"T2", Point(1, 6), BlockId{0}}, {"A1", Point(1, 2), BlockId{2}}};

/// The control points, and a tilt meter.
SensorList with_tilt_meter() {
  SensorList list = control_point_sensors(kThreePoints);
  list.sensors.push_back({"N1", Quantity::tilt, Point(1, 1), {BlockId{1}}, {{NodeId{0}, Point(0, 1)}}});
  return list;
}

std::string refusal_of(const std::string& text) {
  try {
    parse_readings(text, "m.csv", with_tilt_meter());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Wrong {
  std::string text;
  std::string message;
};

const std::string kExpected =
    ", expected point, or x_m,y_m; one of uy_mm, settlement_mm, value_mm, change_mm, or "
    "before_mm,after_mm (_m: in metres); optionally sigma_mm, load, levelling, remark";
const std::string kOneColumn =
    " is no header, expected several columns with commas, semicolons or tabs between them (" +
    kExpected.substr(11) + ")";

const std::vector<Wrong> kHeaders = {
    {"point,uy_cm\nT1,1\n", "unknown column 'uy_cm'"},
    {"point,uy_mm,note\nT1,1,x\n", "unknown column 'note'"},
    {"T1,-3.2\n", "unknown column 't1'"},
    {"point,x_m,y_m\nT1,1,1\n", "no value column"},
    {"point,sigma_mm\nT1,1\n", "no value column"},
    {"uy_mm,sigma_mm\n1,1\n", "nothing that names points"},
    {"point,x_m,uy_mm\n", "nothing that names points"},
    {"x_m,uy_mm\n1,1\n", "nothing that names points"},
    {"point,uy_mm,uy_m\nT1,1,1\n", "column 'uy_m' is given twice or beside another value column"},
    {"point,uy_mm,uy_mm\nT1,1,1\n", "column 'uy_mm' is given twice or beside another value column"},
    {"point,uy_mm,change_mm\nT1,1,1\n", "column 'change_mm' is given twice or beside another value column"},
    {"point,point,uy_mm\n", "column 'point' is given twice or beside another value column"},
    {"point,before_mm\nT1,1\n", "values before without values after"},
    {"point,after_mm\nT1,1\n", "values after without values before"},
    {"point,before_mm,after_m\nT1,1,1\n", "columns 'before_mm' and 'after_m' have different units"},
    {"point,before_mm,settlement_mm,after_mm\nT1,1,1,1\n",
     "column 'settlement_mm' beside values before and after"},
    {"point,before_mm,after_mm,uy_mm\nT1,1,1,1\n", "column 'uy_mm' beside values before and after"},
    {"point,before_mm,after_mm,change_mm\nT1,1,1,1\n", "column 'change_mm' beside values before and after"},
    {"point,uy (cm)\nT1,1\n", "unknown column 'uy_cm'"}};

const std::string kNumber = " is no finite number, expected a displacement or nothing";
const std::string kNoSigma = " is no sigma, expected millimetres from 5e-05 to 10000, or nothing";

const std::vector<Wrong> kRows = {
    {"# x\npoint,uy_mm\nT1,1\nT99,1\n",
     "m.csv:4: unknown point 'T99', expected T1, T2, A1, or a sensor of the list"},
    {"point,uy_mm\nT1,1\nT2,1\nT1,2\n",
     "m.csv:4: point T1 is given again, expected each point once (first in line 2)"},
    {"point,uy_mm\nT1,soft\n", "m.csv:2: 'soft'" + kNumber},
    {"point,uy_mm\nT1,1.5mm\n", "m.csv:2: '1.5mm'" + kNumber},
    {"point,uy_mm\nT1,0x10\n", "m.csv:2: '0x10'" + kNumber},
    {"point,uy_mm\nT1,-inf\n", "m.csv:2: '-inf'" + kNumber},
    {"point,uy_mm\nT1,1e999\n", "m.csv:2: '1e999'" + kNumber},
    {"point,before_mm,after_mm\nT1,1,later\n", "m.csv:2: 'later'" + kNumber},
    {"point,uy_m\nT1,-350\n",
     "m.csv:2: '-350' is a displacement of 350 m, expected at most 100 m (check the units)"},
    {"point,before_m,after_m\nT1,112.3456,12.3456\nT2,112.3456,12.2\n",
     "m.csv:3: from '112.3456' to '12.2' is a displacement of 100 m, expected at most 100 m (check the "
     "units)"},
    {"point,before_mm,after_mm\nT1,20000000,20000000\n",
     "m.csv:2: '20000000' is a height of 2e+04 m, expected at most 10000 m (check the units)"},
    {"point,x_m,y_m,uy_mm\nT2,0.04,6,1\n",
     "m.csv:2: x = 0.04 m, y = 6 m is not where T2 is, expected x = 1 m, y = 6 m within 0.05 m"},
    {"point,uy_mm,sigma_m\nT1,-1,0.00000002\n",
     "m.csv:2: '0.00000002' is no sigma, expected metres from 5e-08 to 10, or nothing"},
    {"point,uy_mm\nT1,-3,5\n",
     "m.csv:2: 3 values, expected 2 as in the header (a number with a decimal comma needs quotation marks, "
     "or a file "
     "with semicolons)"},
    {"point,uy_mm\nT1\n", "m.csv:2: 1 values, expected 2 as in the header"},
    {"point;uy_mm\nT1;1,5\nT2;2.5\n",
     "m.csv:3: '2.5' has a decimal point, expected a decimal comma as in line 2"},
    {"x_m,y_m,uy_mm\n1,high,1\n", "m.csv:2: 'high' is no coordinate, expected a number in metres"},
    {"x_m,y_m,uy_mm\nnan,1,1\n", "m.csv:2: 'nan' is no coordinate, expected a number in metres"},
    {"point,uy_mm,sigma_mm\nT1,-1,0\n", "m.csv:2: '0'" + kNoSigma},
    {"point,change_mm,sigma_mm\nT1,-1,0\n", "m.csv:2: '0'" + kNoSigma},
    {"point,uy_mm,sigma_mm\nT1,-1,-0.1\n", "m.csv:2: '-0.1'" + kNoSigma},
    {"point,uy_mm,sigma_mm\nT1,-1,inf\n", "m.csv:2: 'inf'" + kNoSigma},
    {"point,uy_mm,sigma_mm\nT1,-1,1e300\n", "m.csv:2: '1e300'" + kNoSigma},
    {"point,uy_mm,sigma_mm\nT1,-1,0.00002\n", "m.csv:2: '0.00002'" + kNoSigma},
    {"point,uy_mm\nT1,1\nT2,\u20141\n", "m.csv:3: '<U+2014>1'" + kNumber},
    {"point,load,uy_mm\nT1,axle,1\nT2,,1\n",
     "m.csv:3: no load in this row, expected one, as all readings of a file are of one kind"},
    {"point,uy_mm\nT1,1\nN1,1\n",
     "m.csv:3: sensor N1 reads no vertical displacement, expected a column value_mm, change_mm, or "
     "before_mm,after_mm"}};

const std::vector<Wrong> kFiles = {
    {"", "the file is empty, expected a header line (" + kExpected.substr(11) + ")"},
    {"# only a comment\n", "the file is empty, expected a header line (" + kExpected.substr(11) + ")"},
    {"point,uy_mm\n", "no usable row, expected at least one point with a displacement"},
    {"point,uy_mm\nT1,\n", "no usable row, expected at least one point with a displacement"},
    {"point,before_mm,after_mm\nT1,1,\nT2,,1\n",
     "no usable row, expected at least one point with a value before and after"}};

}  // namespace

TEST_CASE("Headers that leave open what was read are refused with what a header may have") {
  for (const Wrong& wrong : kHeaders)
    CHECK(refusal_of(wrong.text) == "m.csv:1: " + wrong.message + kExpected);
}

TEST_CASE("What has one column only is taken for a title, not a header") {
  for (const std::string title : {"Bridge 7;;", "point change_mm sigma_mm", "point", "[ ];( );[]"})
    CHECK(refusal_of(title + "\npoint;change_mm\nT1;1\n") == "m.csv:1: '" + title + "'" + kOneColumn);
}

TEST_CASE("Wrong rows are refused with the file, the line, the value and what was expected") {
  for (const Wrong& wrong : kRows) CHECK(refusal_of(wrong.text) == wrong.message);
}

TEST_CASE("Files without any reading are refused") {
  for (const Wrong& wrong : kFiles) CHECK(refusal_of(wrong.text) == "m.csv: " + wrong.message);
}

TEST_CASE("A column that has another name in each row names no levellings") {
  std::string text = "point,load,uy_mm,levelling\n";
  for (int row = 0; row < 50; ++row) text += fmt::format("T1,load{},-1,{}\n", row, row);
  CHECK(refusal_of(text) == "no error");
  CHECK(refusal_of(text + "T2,load0,-1,7\n") == "no error");
  CHECK(refusal_of(text + "T2,load0,-1,road\n") ==
        "m.csv:52: 'road' is another levelling, expected at most 50 in a file");
}
