/// @file The reader of measurements files against damaged and made-up inputs. Oracle: it accepts or throws
/// InputError, and what it accepts is finite and in place.

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"
#include "lookup/measurements.h"
#include "lookup/random.h"

using namespace voussoir;

namespace {

const std::vector<StoredPoint> kPoints = {{"T1", Point(0, 6), BlockId{0}},
                                          {"T2", Point(1, 6), BlockId{0}},
                                          {"T3", Point(1, 6), BlockId{1}},
                                          {"A1", Point(1, 2), BlockId{2}}};

const std::vector<std::string> kGoodFiles = {
    "point,uy_mm\nT1,-1.25\nT2,-3e-1\nA1,0\n", "x_m,y_m,uy_m\n0,6,-1e-3\n1,6,\n1,6,NaN\n",
    "\xEF\xBB\xBF# c\r\npoint,settlement_mm,sigma_mm\r\n\"T3\", 4.5 ,0.1\r\n\r\nT1,,\r\n"};

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

std::string mutated(Random& random) {
  std::string text = kGoodFiles[random.below(static_cast<std::uint32_t>(kGoodFiles.size()))];
  const std::uint32_t changes = 1 + random.below(6);
  for (std::uint32_t i = 0; i < changes; ++i) {
    const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()) + 1);
    const std::uint32_t kind = random.below(5);
    if (kind == 0) text.insert(at, kNasty[random.below(static_cast<std::uint32_t>(kNasty.size()))]);
    if (kind == 1) text.insert(at, 1, static_cast<char>(random.below(256)));
    if (kind == 2 && at < text.size()) text[at] = static_cast<char>(random.below(256));
    if (kind == 3) text.erase(at, random.below(8));
    if (kind == 4) text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(at) + 1), 20));
  }
  return text;
}

struct Tally {
  int accepted = 0;
  int refused = 0;
};

Tally feed(int inputs, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < inputs; ++i) {
    const std::string text = mutated(random);
    try {
      const Measurements read = parse_measurements(text, "fuzz.csv", kPoints);
      ++tally.accepted;
      bool sound = read.displacement.size() == kPoints.size() && read.count() > 0;
      for (const double value : read.displacement) sound = sound && !(std::abs(value) > kLargestDisplacement);
      for (const double sigma : read.sigma)
        sound = sound && (std::isnan(sigma) || (sigma > 0.0 && std::isfinite(sigma)));
      if (!sound) FAIL("accepted an unsound file: " << text);
    } catch (const InputError& error) {
      ++tally.refused;
      if (std::string(error.what()).find("fuzz.csv:") != 0)
        FAIL("a message without the file: " << error.what());
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("Thirty thousand damaged measurement files are read or refused cleanly") {
  const Tally tally = feed(30'000, 1);
  CHECK(tally.accepted > 300);
  CHECK(tally.refused > 1000);
}

TEST_CASE("A million damaged measurement files are read or refused cleanly", "[long]") {
  const Tally tally = feed(1'000'000, 2);
  CHECK(tally.accepted + tally.refused == 1'000'000);
}
