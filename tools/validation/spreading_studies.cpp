/// @file Arches whose feet give way: thrust and hinges.

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "core/law/joint_kinematics.h"
#include "core/statics/elements.h"
#include "tools/validation/joint_limits.h"
#include "tools/validation/movements.h"
#include "tools/validation/studies.h"
#include "tools/validation/trial_arches.h"

namespace voussoir::validation {
namespace {

constexpr double kSpread = 5e-4;  ///< [m] by which the span grows, of a radius of 1 m
constexpr int kSteps = 20;
const std::vector<double> kHalfAngles = {90.0, 75.0, 60.0};  ///< [degrees]
constexpr double kThickness = 0.15;                          ///< [m]
constexpr int kVoussoirs = 31;

/// How far each joint of the left half has turned open, from the springing to the crown: positive where it is
/// open inside.
std::vector<double> turns(const Model& arch, const Field& displacement) {
  std::vector<double> result(static_cast<std::size_t>(kVoussoirs) / 2 + 1);
  const Point centre(kArchCentre, 0.0);
  for (const Joint& joint : arch.joints) {
    const auto left = static_cast<std::size_t>(std::min(value(joint.first), value(joint.second)));
    if (left >= result.size()) continue;
    const std::array<Point, 2> ends = ends_of(joint, arch.mesh);
    const JointState state =
        joint_kinematics(make_joint_frame(joint, arch.mesh), gathered(displacement, corners(joint))).state;
    const double turn = (state[0] - state[2]) / joint.length;
    result[left] += (ends[0] - centre).norm() < (ends[1] - centre).norm() ? turn : -turn;
  }
  return result;
}

struct SpreadArch {
  double thrust = 0.0;       ///< over rho g R^2
  int outer = 0, inner = 0;  ///< the joints that have turned most, open inside and open outside
};

SpreadArch spread(const SpanDescription& span, double normal_stiffness) {
  const Model arch = elastic(span, normal_stiffness);
  const MovementDescription outwards{.support = "foot 1", .pressure = {}, .x = -kSpread, .steps = kSteps};
  const MovedStructure moved = follow_movements(arch, {outwards});
  if (!moved.complete) throw Failure("the arch falls before its feet are where they shall be");
  const MovedPoint& last = moved.points.back();
  const std::vector<double> turned = turns(arch, last.at.state.displacement);
  const auto most = std::ranges::max_element(turned), least = std::ranges::min_element(turned);
  return {last.force.x() / kSpecificWeight, static_cast<int>(most - turned.begin()),
          static_cast<int>(least - turned.begin())};
}

Findings spreading() {
  Findings findings;
  for (const double degrees : kHalfAngles) {
    const SpanDescription span = segmental(degrees * std::numbers::pi / 180.0, kThickness, kVoussoirs);
    const auto expected = least_thrust(rigid(span));
    if (!expected) throw Failure("an arch that shall spread does not stand");
    SpreadArch found;
    const Limit limit = find_limit(
        kStiffForThinRings,
        [&](double stiffness) {
          found = spread(span, stiffness);  // of the stiffest in the end
          return found.thrust;
        },
        kAtGivenTurn);
    const std::string name = fmt::format("Arch of twice {} degrees, t/R = {}, {} voussoirs, feet {} R apart",
                                         degrees, kThickness, kVoussoirs, kSpread);
    findings.cases.push_back(
        absolute_case({.name = name,
                       .quantity = "thrust over rho g R^2, extrapolated to rigid joints",
                       .expected = expected->thrust,
                       .source = "least thrust by statics of rigid voussoirs",
                       .computed = limit.rigid},
                      limit.spread + 5e-3 * expected->thrust,
                      "hinges press over a width that goes with the square root of 1 / p_n; what "
                      "curving the extrapolation changes, and half a per cent for the span, which "
                      "has grown"));
    const auto hinge = [&](const char* quantity, int joint, int computed) {
      findings.cases.push_back(absolute_case({.name = name,
                                              .quantity = quantity,
                                              .expected = static_cast<double>(joint),
                                              .source = "where the least thrust touches the ring's edge",
                                              .computed = static_cast<double>(computed)},
                                             0.0, "the same joint"));
    };
    hinge("hinge on the extrados, joint from the left springing", expected->outer, found.outer);
    hinge("hinge on the intrados, joint from the left springing", expected->inner, found.inner);
  }
  return findings;
}

}  // namespace

std::vector<Study> spreading_studies() {
  return {{.name = "spreading", .title = "Arches on spreading feet: thrust and hinges", .run = spreading}};
}

}  // namespace voussoir::validation
