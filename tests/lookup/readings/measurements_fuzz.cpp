/// @file The reader of measurements files against damaged and made-up inputs. Oracle: it accepts or throws
/// InputError, and what it accepts is finite and in place.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "lookup/readings/measurements.h"
#include "tests/support/fuzzing.h"

using namespace voussoir;

namespace {

const std::vector<StoredPoint> kPoints = {{"T1", Point(0, 6), BlockId{0}},
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
                                         "+-1",
                                         "0x1p3",
                                         std::string(1, '\0'),
                                         "\xFF\xFE",
                                         "\xEF\xBB\xBF",
                                         "e",
                                         ".",
                                         "-",
                                         "1.7976931348623157e308"};

void check_sound(const Measurements& read, const std::string& text) {
  bool sound = read.displacement.size() == kPoints.size() && read.count() > 0;
  for (const double value : read.displacement) sound = sound && !(std::abs(value) > kLargestDisplacement);
  for (const double sigma : read.sigma)
    sound = sound && (std::isnan(sigma) || (sigma > 0.0 && std::isfinite(sigma)));
  if (!sound) FAIL("accepted an unsound file: " << text);
}

test::Verdict read(const std::string& text) {
  try {
    check_sound(parse_measurements(text, "fuzz.csv", kPoints), text);
    return test::Verdict::accepted;
  } catch (const InputError& error) {
    if (std::string(error.what()).find("fuzz.csv:") != 0)
      FAIL("a message without the file: " << error.what());
    return test::Verdict::refused;
  }
}

test::Tally feed(int inputs, std::uint64_t seed) {
  const std::vector<std::string> good = test::corpus("measurements");
  test::Chance chance(seed);
  return test::feed(inputs, [&] { return read(test::damaged_text(good, kNasty, chance)); });
}

}  // namespace

TEST_CASE("Thirty thousand damaged measurement files are read or refused cleanly", "[fuzz]") {
  const test::Tally tally = feed(30'000, 1);
  CHECK(tally.accepted > 300);
  CHECK(tally.refused > 1000);
}

TEST_CASE("Ten minutes or a million damaged measurement files are read or refused cleanly", "[.long][fuzz]") {
  const test::Tally tally = feed(1'000'000, 2);
  WARN(tally.accepted << " accepted, " << tally.refused << " refused");
  CHECK(tally.accepted > 0);
  CHECK(tally.refused > 0);
}
