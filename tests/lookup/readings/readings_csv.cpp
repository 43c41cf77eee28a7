#include "lookup/readings/readings_csv.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace voussoir;

namespace {

const std::vector<StoredPoint> kTwoPoints = {{"T1", Point(0, 6), BlockId{0}},
                                             {"T2", Point(1, 6), BlockId{0}}};

/// The control points, and a sensor whose name needs quotation marks.
SensorList sensors() {
  SensorList list = control_point_sensors(kTwoPoints);
  list.sensors.push_back(
      {"N \"a\", b", Quantity::tilt, Point(1, 1), {BlockId{0}}, {{NodeId{0}, Point(0, 1)}}});
  return list;
}

bool same_number(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || a == Approx(b).margin(5e-10);  // half a unit of the last place
}

}  // namespace

TEST_CASE("What is written is read again, whatever the kind (inverse functions)") {
  const double none = std::nan("");
  for (const ReadingKind kind :
       {ReadingKind::absolute, ReadingKind::change, ReadingKind::load, ReadingKind::load_change})
    for (const bool with_sigma : {false, true}) {
      const bool two_epochs = kind == ReadingKind::load_change;
      ReadingsFile file{"m.csv", kind, two_epochs, {}};
      for (std::size_t sensor = 0; sensor < 3; ++sensor) {
        const double value = sensor == 1 ? none : -1.25e-3 * (1.0 + static_cast<double>(sensor));
        file.readings.push_back({.sensor = sensor,
                                 .load = is_loaded(kind) ? "truck@2" : "",
                                 .value = value,
                                 .before = 0.5e-3,
                                 .after = 0.5e-3 + value,
                                 .sigma = with_sigma && sensor != 2 ? 2e-5 : none,
                                 .silent = std::isnan(value)});
      }
      const ReadingsFile read = parse_readings(to_csv(file, sensors()), "m.csv", sensors());
      CHECK(read.kind == kind);
      REQUIRE(read.readings.size() == 3);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(read.readings[i].sensor == file.readings[i].sensor);
        CHECK(read.readings[i].load == file.readings[i].load);
        CHECK(read.readings[i].silent == file.readings[i].silent);
        CHECK(same_number(read.readings[i].value, file.readings[i].value));
        CHECK(same_number(read.readings[i].sigma, file.readings[i].sigma));
      }
    }
}

TEST_CASE(
    "Absolute readings are written in millimetres to a tenth of a micrometre, silent ones without value") {
  CHECK(to_csv(as_measurements(std::vector<double>{-1.23456e-3, std::nan("")}), kTwoPoints) ==
        "point,uy_mm\nT1,-1.2346\nT2,\n");
}
