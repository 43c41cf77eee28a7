/// @file The readers of measurements and sensors files against damaged and made-up inputs. Oracle: they
/// accept or throw InputError, and what they accept is finite and in place.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "lookup/readings/readings_file.h"
#include "lookup/readings/sensors_file.h"
#include "tests/support/fuzzing.h"
#include "tests/support/made_up_database.h"

using namespace voussoir;

namespace {

const std::vector<StoredPoint> kFuzzedPoints = {{"T1", Point(0, 6), BlockId{0}},
                                                {"T2", Point(1, 6), BlockId{0}},
                                                {"T3", Point(1, 6), BlockId{1}},
                                                {"A1", Point(1, 2), BlockId{2}}};

/// Pieces that parsers stumble over.
const std::vector<std::string> kNasty = {"nan",
                                         "inf",
                                         "-inf",
                                         "1e999",
                                         "-1e-999",
                                         "\"",
                                         ",",
                                         "\n",
                                         "\r",
                                         "#",
                                         "T1",
                                         "T",
                                         "point",
                                         "uy_mm",
                                         "sigma_mm",
                                         "x_m",
                                         "before_mm",
                                         "after_mm",
                                         "change_mm",
                                         "load",
                                         "truck@2",
                                         "tilt",
                                         "distance",
                                         "block",
                                         "1,5",
                                         "1.234,5",
                                         "\"1,234.5\"",
                                         "\"\"",
                                         ";",
                                         "\t",
                                         "+-1",
                                         "0x1p3",
                                         std::string(1, '\0'),
                                         "\xFF\xFE",
                                         "\xEF\xBB\xBF",
                                         "e",
                                         ".",
                                         "-",
                                         "1.7976931348623157e308"};

bool is_sound(const ReadingsFile& file) {
  bool sound = !file.readings.empty();
  for (const Reading& reading : file.readings) {
    sound = sound && reading.sensor < kFuzzedPoints.size() &&
            !(std::abs(reading.value) > 2.0 * kLargestDisplacement);
    sound = sound && (std::isnan(reading.sigma) || (reading.sigma > 0.0 && std::isfinite(reading.sigma)));
    sound = sound &&
            reading.load.empty() == (file.kind == ReadingKind::absolute || file.kind == ReadingKind::change);
  }
  return sound;
}

bool is_sound(const SensorList& list, const Mesh& mesh) {
  bool sound = true;
  for (const Sensor& sensor : list.sensors) {
    sound = sound && !sensor.name.empty() && !sensor.blocks.empty() && !sensor.weights.empty();
    for (const NodeWeight& part : sensor.weights)
      sound =
          sound && value(part.node) >= 0 && value(part.node) < mesh.node_count() && part.weight.allFinite();
  }
  return sound;
}

/// Whether `read` accepts; what it refuses, it has to refuse with the file's name.
template <class Read>
test::Verdict verdict_of(const std::string& text, const Read& read) {
  try {
    if (!read()) FAIL("accepted an unsound file: " << text);
    return test::Verdict::accepted;
  } catch (const InputError& error) {
    if (std::string(error.what()).find("fuzz.csv:") != 0)
      FAIL("a message without the file: " << error.what());
    return test::Verdict::refused;
  }
}

test::Tally feed_readings(int inputs, std::uint64_t seed) {
  const std::vector<std::string> good = test::corpus("measurements");
  const SensorList sensors = control_point_sensors(kFuzzedPoints);
  test::Chance chance(seed);
  return test::feed(inputs, [&] {
    const std::string text = test::damaged_text(good, kNasty, chance);
    return verdict_of(text, [&] { return is_sound(parse_readings(text, "fuzz.csv", sensors)); });
  });
}

test::Tally feed_sensors(int inputs, std::uint64_t seed) {
  const std::vector<std::string> good = test::corpus("sensors");
  const Model bridge = make_model(test::small_bridge_file().description);
  test::Chance chance(seed);
  return test::feed(inputs, [&] {
    const std::string text = test::damaged_text(good, kNasty, chance);
    return verdict_of(text, [&] {
      return is_sound(parse_sensors(text, "fuzz.csv", bridge.layout, bridge.mesh), bridge.mesh);
    });
  });
}

}  // namespace

TEST_CASE("Thirty thousand damaged measurement files are read or refused cleanly", "[fuzz]") {
  const test::Tally tally = feed_readings(30'000, 1);
  CHECK(tally.accepted > 300);
  CHECK(tally.refused > 1000);
}

TEST_CASE("Ten minutes or a million damaged measurement files are read or refused cleanly", "[.long][fuzz]") {
  const test::Tally tally = feed_readings(1'000'000, 2);
  WARN(tally.accepted << " accepted, " << tally.refused << " refused");
  CHECK(tally.accepted > 0);
  CHECK(tally.refused > 0);
}

TEST_CASE("Ten thousand damaged sensor files are read or refused cleanly", "[fuzz]") {
  const test::Tally tally = feed_sensors(10'000, 3);
  CHECK(tally.accepted > 100);
  CHECK(tally.refused > 1000);
}

TEST_CASE("Ten minutes or a million damaged sensor files are read or refused cleanly", "[.long][fuzz]") {
  const test::Tally tally = feed_sensors(1'000'000, 4);
  WARN(tally.accepted << " accepted, " << tally.refused << " refused");
  CHECK(tally.accepted > 0);
  CHECK(tally.refused > 0);
}
