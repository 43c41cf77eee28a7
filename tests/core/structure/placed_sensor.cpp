/// @file Sensors of a bridge file. Oracles: closed forms of linear displacements, places of the drawing.

#include "core/structure/placed_sensor.h"

#include <catch2/catch.hpp>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "core/statics/sensitivity.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"

using namespace voussoir;
using Catch::Matchers::Message;

namespace {

// Blocks of the small bridge: (2,1) is x 0..1, y 0.5..1; (3,1) x 0..0.5, y 1..1.5.
constexpr char kSensors[] = R"(
[[sensors]]
name = "V1"
x_m = 0.75
y_m = 0.8
[[sensors]]
name = "H1"
quantity = "ux"
x_m = 0.25
y_m = 1.0
block = "3,1"
[[sensors]]
name = "N1"
quantity = "tilt"
block = "2,1"
[[sensors]]
name = "G1"
quantity = "distance"
x_m = 0.2
y_m = 0.8
x2_m = 0.4
y2_m = 1.3
)";

BridgeDescription with_sensors(const std::string& sensors) {
  return parse_bridge_file(test::text_of(test::example_bridge("small")) + sensors, "b.toml").description;
}

/// Lines before the sensors.
long first_line() {
  const std::string text = test::text_of(test::example_bridge("small"));
  return std::count(text.begin(), text.end(), '\n') + 1;
}

std::string sensor(const std::string& keys) {
  return "[[sensors]]\n" + keys;
}

}  // namespace

TEST_CASE("Sensors of a bridge file follow its control points and read linear displacements exactly",
          "[sensors]") {
  const Model bridge = make_model(with_sensors(kSensors));
  const std::size_t plain = make_model(test::small_description()).control_points.size();
  REQUIRE(bridge.control_points.size() == plain + 4);
  const Point shift(3e-3, -2e-3);
  const Eigen::Matrix2d gradient = (Eigen::Matrix2d() << 1e-4, -3e-4, 5e-4, 2e-4).finished();
  const Field field = (gradient * bridge.mesh.nodes).colwise() + shift;
  const Eigen::VectorXd read = readings_at(bridge.control_points, field).tail(4);
  const auto moved = [&](double x, double y) { return Point(shift + gradient * Point(x, y)); };
  CHECK(read[0] == Approx(moved(0.75, 0.8).y()).epsilon(1e-12));
  CHECK(read[1] == Approx(moved(0.25, 1.0).x()).epsilon(1e-12));
  CHECK(read[2] == Approx(0.5 * (5e-4 + 3e-4)).epsilon(0.4));  // least squares: between 3e-4 and 5e-4
  const Point way(0.2, 0.5);
  CHECK(read[3] == Approx(way.dot(gradient * way) / way.norm()).epsilon(1e-12));
  const ControlPoint& gauge = bridge.control_points.back();
  CHECK(bridge.layout[gauge.block].label == "2,1");
  CHECK(bridge.layout[gauge.other_block.value()].label == "3,1");
  CHECK(lacks(parse_scene("3,1", bridge.layout), gauge));
  CHECK(lacks(parse_scene("2,1", bridge.layout), gauge));
  CHECK_FALSE(lacks(parse_scene("3,2", bridge.layout), gauge));
}

TEST_CASE("Columns of what is read are the readings' weights (any field)", "[sensors]") {
  const Model bridge = make_model(with_sensors(kSensors));
  const Field field = Field::Random(2, bridge.mesh.node_count());
  const Eigen::MatrixXd columns = reading_columns(bridge, bridge.control_points);
  const Eigen::VectorXd read = readings_at(bridge.control_points, field);
  CHECK((columns.transpose() * field.reshaped() - read).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("Sensors that a bridge file cannot have are refused with the line and what was expected",
          "[sensors]") {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"quantity = \"ux\"\n", "name in [[sensors]]: is missing"},
      {"name = \"a name\"\n", "expected at most 8 letters, digits, -, _ and ."},
      {"name = \"123456789\"\n", "expected at most 8 letters, digits, -, _ and ."},
      {"name = \"V1\"\nquantity = \"uz\"\n", "expected one of \"ux\", \"uy\", \"tilt\", \"distance\""},
      {"name = \"V1\"\nx_m = 1.0\n", "y_m in [[sensors]]: is missing"},
      {"name = \"V1\"\nx_m = 1.0\ny_m = 1e9\n", "y_m in [[sensors]]"},
      {"name = \"V1\"\nx_m = 1.0\ny_m = 1.0\nz_m = 1.0\n", "z_m"}};
  for (const auto& [keys, message] : wrong) {
    INFO(keys);
    CHECK_THROWS_MATCHES(with_sensors(sensor(keys)), InputError,
                         Catch::Matchers::Predicate<InputError>([&](const InputError& error) {
                           const std::string text = error.what();
                           INFO(text);
                           const std::string line = text.substr(0, text.find(':', 7));
                           return text.find(message) != std::string::npos &&
                                  std::stol(line.substr(7)) >= first_line();
                         }));
  }
}

TEST_CASE("Sensors that are not on the bridge are refused by name", "[sensors]") {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"name = \"V1\"\n",
       "sensor 'V1' in [[sensors]]: no place, expected x_m and y_m, of a distance x2_m and y2_m, too"},
      {"name = \"V1\"\nx_m = 3.0\ny_m = 0.2\n",
       "sensor 'V1' in [[sensors]]: x = 3 m, y = 0.2 m is outside the bridge, expected a place on a block"},
      {"name = \"V1\"\nx_m = 0.25\ny_m = 1.0\n",
       "sensor 'V1' in [[sensors]]: blocks meet at x = 0.25 m, y = 1 m, expected 2,1 or 3,1 as block"},
      {"name = \"T1\"\nx_m = 0.75\ny_m = 0.8\n",
       "sensor 'T1' in [[sensors]] is there already, expected another name"},
      {"name = \"N1\"\nquantity = \"tilt\"\nblock = \"2,99\"\n",
       "sensor 'N1' in [[sensors]]: there is no block 2,99: course 2 has positions 1 to 4"}};
  for (const auto& [keys, message] : wrong) {
    const BridgeDescription description = with_sensors(sensor(keys));
    CHECK_THROWS_MATCHES(make_model(description), InputError, Message(message));
  }
}
