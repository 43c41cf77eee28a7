#include <catch2/catch.hpp>
#include <cmath>

#include "lookup/lookup.h"
#include "tests/lookup/synthetic_library.h"

using namespace voussoir;
using namespace voussoir::test;

namespace {

constexpr double kGaugeSigma = 1e-5;  // [m]

/// Changes that a block's loss makes, times a sign, with errors of so many standard deviations to and fro.
Comparison changes(const SyntheticLibrary& library, const Scene& scene, double sign, double size = 1.0) {
  Comparison comparison = absolute_readings(library.library(), no_measurements(library.points.size()));
  comparison.kind = ReadingKind::change;
  const std::span<const double> lost = library.table.row(library.row_of(scene));
  for (std::size_t i = 0; i < library.points.size(); ++i) {
    const double error = i % 2 == 0 ? size * kGaugeSigma : -size * kGaugeSigma;
    comparison.measured.displacement[i] =
        library.intact()[i] + sign * (lost[i] - library.intact()[i]) + error;
    comparison.measured.sigma[i] = kGaugeSigma;
  }
  return comparison;
}

Answer answer_to(const Comparison& comparison) {
  LookupSettings settings;
  settings.known_bridge = true;
  return locate_damage(comparison, settings);
}

}  // namespace

TEST_CASE(
    "Changes with the opposite sign are none of a known bridge, and the answer says whose they would be") {
  const SyntheticLibrary library(3, 4, 2);
  int turned = 0;
  for (std::size_t block = 0; block < 8; ++block) {
    const Scene scene{{BlockId{static_cast<std::int32_t>(block)}}};
    const std::string name = to_string(scene, library.layout);
    CAPTURE(name);
    CHECK(answer_to(changes(library, scene, 1.0)).fit->explained);
    const Answer answer = answer_to(changes(library, scene, -1.0));
    CHECK_FALSE(answer.fit->explained);
    turned += answer.fit->reason.find("opposite sign") != std::string::npos &&
                      answer.fit->reason.find(name) != std::string::npos
                  ? 1
                  : 0;
  }
  CHECK(turned >= 6);  // of others a collapse is nearer
}

TEST_CASE("Changes that are shown badly, but no better with the opposite sign, have no sign to doubt") {
  const SyntheticLibrary library(3, 4, 2);
  for (const Scene& scene : {Scene{}, Scene{{BlockId{0}}}, Scene{{BlockId{5}}}}) {
    CAPTURE(to_string(scene, library.layout));
    const Answer answer = answer_to(changes(library, scene, 1.0, 1.6));
    CHECK(answer.fit->chance < 0.05);  // or nothing would be asked
    CHECK(answer.fit->explained);
  }
}

TEST_CASE("What the opposite sign would show counts at the level of noise that it needs") {
  const SyntheticLibrary library(3, 4, 2);
  Comparison comparison = changes(library, {{BlockId{5}}}, -1.0);
  comparison.measured.sigma.assign(comparison.measured.sigma.size(), std::nan(""));
  LookupSettings settings;
  settings.known_bridge = true;
  settings.noise.floor = kGaugeSigma;
  settings.noise.shape = NoiseShape::gaussian;
  const Answer answer = locate_damage(comparison, settings);
  CHECK_FALSE(answer.fit->explained);
  CHECK_THAT(answer.fit->reason, Catch::Contains("opposite sign"));
}
