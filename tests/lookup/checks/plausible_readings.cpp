/// @file Do changes scatter as instruments let expect? Oracle: cases written out.

#include "lookup/checks/plausible_readings.h"

#include <catch2/catch.hpp>

using namespace voussoir;

namespace {

/// Changes at so many points.
UnknownBridge changes_at(std::size_t points) {
  UnknownBridge bridge;
  for (std::size_t i = 0; i < points; ++i) bridge.rows.push_back({.channel = i, .before = -1.0});
  bridge.movement = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points));
  return bridge;
}

BridgePosterior scattering(double times) {
  BridgePosterior posterior;
  posterior.square = times * times;
  return posterior;
}

}  // namespace

TEST_CASE("Changes that scatter by less than a seventh of their errors are asked about (written out)") {
  const UnknownBridge bridge = changes_at(12);
  const std::optional<Fit> calm = check_scatter(bridge, scattering(0.1));
  REQUIRE(calm);
  CHECK_FALSE(calm->explained);
  CHECK_THAT(calm->reason, Catch::Contains("scatter by 0.1 of") && Catch::Contains("millimetres"));
  CHECK_FALSE(check_scatter(bridge, scattering(0.2)));
  CHECK_FALSE(check_scatter(bridge, scattering(0.0)));
  CHECK_FALSE(check_scatter(changes_at(9), scattering(0.1)));
}

TEST_CASE(
    "Displacements may be just those of the file's bridge, whose own scatter says nothing (written out)") {
  UnknownBridge bridge = changes_at(12);
  bridge.movement.setConstant(1e-3);
  CHECK_FALSE(check_scatter(bridge, scattering(0.1)));
}
