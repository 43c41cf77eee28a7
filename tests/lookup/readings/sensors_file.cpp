#include "lookup/readings/sensors_file.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/made_up_database.h"

using namespace voussoir;

namespace {

const Model& sensors_bridge() {
  static const Model bridge = make_model(test::small_bridge_file().description);
  return bridge;
}

std::vector<Sensor> sensors_of(const std::string& text) {
  SensorList list{{{"T1", Quantity::uy, Point(0, 2.5), {BlockId{0}}}}, 1};
  list = parse_sensors(text, "s.csv", sensors_bridge().layout, sensors_bridge().mesh, std::move(list));
  list.sensors.erase(list.sensors.begin());
  return list.sensors;
}

std::string error_of(const std::string& text) {
  try {
    sensors_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string label(BlockId id) {
  return sensors_bridge().layout[id].label;
}

const std::string kHeader = "name,quantity,x_m,y_m,x2_m,y2_m,block,block2\n";

}  // namespace

// Blocks of the small bridge: (2,1) is x 0..1, y 0.5..1; (3,1) x 0..0.5, y 1..1.5; (3,2) x 0.5..1.5 above it.

TEST_CASE("Sensors are read with their quantity, place and block") {
  const std::vector<Sensor> sensors =
      sensors_of(kHeader +
                 "L,ux,0.75,0.75,,,,\nV,uy,0.5,0.75,,,,\nR,tilt,0.5,0.75,,,,\nB,tilt,,,,,\"3,2\",\n"
                 "G,distance,0.8,0.8,0.8,1.2,,\n");
  REQUIRE(sensors.size() == 5);
  CHECK(sensors[0].quantity == Quantity::ux);
  CHECK(sensors[0].position == Point(0.75, 0.75));
  CHECK(sensors[1].quantity == Quantity::uy);
  for (const std::size_t i : {0U, 1U, 2U}) CHECK(label(sensors[i].blocks.front()) == "2,1");
  CHECK(sensors[2].quantity == Quantity::tilt);
  CHECK((sensors[2].position - Point(0.5, 0.75)).norm() < 1e-12);
  CHECK(label(sensors[3].blocks.front()) == "3,2");
  REQUIRE(sensors[4].blocks.size() == 2);
  CHECK(label(sensors[4].blocks[0]) == "2,1");
  CHECK(label(sensors[4].blocks[1]) == "3,2");
  CHECK((sensors[4].position - Point(0.8, 1.0)).norm() < 1e-12);
}

TEST_CASE("The example's sensors are on the reference bridge, its gauge over a joint") {
  const std::string examples = std::string(VOUSSOIR_SOURCE_DIR) + "/examples/";
  const Model bridge = make_model(read_bridge_file(examples + "bridges/reference.toml").description);
  const SensorList list = read_sensors(examples + "sensors/reference.csv", bridge.layout, bridge.mesh);
  REQUIRE(list.sensors.size() == 4);
  CHECK(bridge.layout[list.sensors[1].blocks.front()].label == "10,4");
  CHECK(bridge.layout[list.sensors[2].blocks.front()].label == "10,5");
  CHECK(list.sensors[3].blocks.size() == 2);
}

TEST_CASE("A place where blocks meet belongs to the block that is named") {
  CHECK(error_of("name,quantity,x_m,y_m\nV,uy,0.25,1.0\n") ==
        "s.csv:2: blocks meet at x = 0.25 m, y = 1 m, expected 2,1 or 3,1 as block");
  CHECK(label(sensors_of("name;quantity;x_m;y_m;block\nV;uy;0,25;1,0;3,1\n")[0].blocks.front()) == "3,1");
  CHECK(label(sensors_of("name;quantity;x_m;y_m;block\nV;uy;0,25;1,0;2,1\n")[0].blocks.front()) == "2,1");
}

TEST_CASE("A place belongs to a block that it is within a millimetre of") {
  CHECK(label(sensors_of("name,quantity,x_m,y_m\nV,uy,0.25,2.5009\n")[0].blocks.front()) == "5,1");
  CHECK(error_of("name,quantity,x_m,y_m\nV,uy,0.25,2.5011\n") ==
        "s.csv:2: x = 0.25 m, y = 2.5011 m is outside the bridge, expected a place on a block");
}

TEST_CASE("Wrong sensors are refused with the file, the line, the value and what was expected") {
  const std::string columns = ", expected name, quantity; x_m, y_m; optionally x2_m, y2_m, block, block2";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"", "s.csv: the file is empty, expected a header line (" + columns.substr(11) + ")"},
      {"name,x_m\nV,1\n", "s.csv:1: no column name or no quantity" + columns},
      {"name,quantity,z_m\nV,uy,1\n", "s.csv:1: unknown column 'z_m'" + columns},
      {"name,quantity,name\nV,uy,1\n", "s.csv:1: column 'name' is given twice" + columns},
      {kHeader + "V,uz,0.5,0.75,,,,\n", "s.csv:2: unknown quantity 'uz', expected ux, uy, tilt or distance"},
      {kHeader + ",uy,0.5,0.75,,,,\n", "s.csv:2: a sensor without a name, expected one"},
      {kHeader + "T1,uy,0.5,0.75,,,,\n", "s.csv:2: sensor 'T1' is there already, expected another name"},
      {kHeader + "V,uy,0.5,0.75,,,,\nV,ux,0.5,0.75,,,,\n",
       "s.csv:3: sensor 'V' is there already, expected another name"},
      {kHeader + "V,uy,0.5,,,,,\n",
       "s.csv:2: '' is no coordinate, expected a number in metres in column y_m"},
      {kHeader + "V,uy,nan,1,,,,\n",
       "s.csv:2: 'nan' is no coordinate, expected a number in metres in column x_m"},
      {kHeader + "V,uy,3.0,0.2,,,,\n",
       "s.csv:2: x = 3 m, y = 0.2 m is outside the bridge, expected a place on a block"},
      {kHeader + "V,uy,0.5,0.75,,,\"3,1\",\n",
       "s.csv:2: x = 0.5 m, y = 0.75 m is not on block 3,1, expected 2,1"},
      {kHeader + "V,uy,0.5,0.75,,,\"99,1\",\n",
       "s.csv:2: there is no block 99,1: this bridge has no course 99"},
      {kHeader + "V,uy,0.5,0.75,,,\"2,1+3,1\",\n", "s.csv:2: '2,1+3,1': expected one block"},
      {kHeader + "V,uy,0.5,0.75,1,1,,\n",
       "s.csv:2: a second place or block, expected none but of a distance"},
      {kHeader + "V,uy,0.5,0.75,,,,\"2,1\"\n",
       "s.csv:2: a second place or block, expected none but of a distance"},
      {kHeader + "R,tilt,,,,,,\n", "s.csv:2: a tilt without place and without block, expected one of them"},
      {kHeader + "G,distance,0.5,0.75,0.5,0.75,,\n",
       "s.csv:2: a distance between places that are one, expected more than 0.001 m"},
      {kHeader + "G,distance,0.5,0.75,,,,\n",
       "s.csv:2: no place, expected x_m and y_m, of a distance x2_m and y2_m, too"}};
  for (const auto& [text, message] : wrong) CHECK(error_of(text) == message);
}
