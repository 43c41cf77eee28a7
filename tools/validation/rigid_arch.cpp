#include "tools/validation/rigid_arch.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace voussoir::validation {
namespace {

/// A rigid body's movement: velocity at the origin and turning, counter-clockwise.
struct Movement {
  Point origin = Point::Zero();
  double turn = 0.0;
  Point at(const Point& p) const { return origin + turn * Point(-p.y(), p.x()); }
};

Movement about(const Point& hinge, double turn) {
  return {-turn * Point(-hinge.y(), hinge.x()), turn};
}

/// Movements of the three bodies between four hinges if the first turns by 1.
std::optional<std::array<Movement, 3>> movements(const std::array<Point, 4>& h) {
  // Unknown: origin and turn of the middle body, turn of the last. Equal velocities at hinges 1 and 2.
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right;
  const Movement first = about(h[0], 1.0), last = about(h[3], 1.0);
  matrix.topLeftCorner<2, 2>().setIdentity();
  matrix.bottomLeftCorner<2, 2>().setIdentity();
  matrix.block<2, 1>(0, 2) = Point(-h[1].y(), h[1].x());
  matrix.block<2, 1>(2, 2) = Point(-h[2].y(), h[2].x());
  matrix.block<2, 1>(2, 3) = -last.at(h[2]);
  right << first.at(h[1]), 0.0, 0.0;
  const Eigen::FullPivLU<Eigen::Matrix4d> solver(matrix);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector4d x = solver.solve(right);
  return std::array<Movement, 3>{first, Movement{x.head<2>(), x[2]}, about(h[3], x[3])};
}

/// Does every hinge open on its other side? A hinge on the outside opens inside: what follows on the right
/// turns clockwise against what comes before, minus the ground's rest.
bool opens(const std::array<Movement, 3>& bodies, bool first_inside) {
  const std::array<double, 5> turns = {0.0, bodies[0].turn, bodies[1].turn, bodies[2].turn, 0.0};
  for (int i = 0; i < 4; ++i) {
    const bool inside = (i % 2 == 0) == first_inside;
    const double relative = turns[static_cast<std::size_t>(i + 1)] - turns[static_cast<std::size_t>(i)];
    // A part to the right that turns counter-clockwise about the outer corner leaves the inner one.
    if (inside ? relative > 1e-12 : relative < -1e-12) return false;
  }
  return true;
}

/// What a joint of the left half allows of the thrust H at the crown and its moment H y, (H, H y) = p.
struct JointBounds {
  int number;
  Point inner, outer;     ///< [m] its ends
  double weight, moment;  ///< of what lies between it and the crown, per specific weight
  /// Moments of thrust and weight about the ends, of one sign inside, of the other outside.
  double inner_room(const Point& p) const { return weight * inner.x() - moment - inner.y() * p.x() + p.y(); }
  double outer_room(const Point& p) const { return moment - weight * outer.x() + outer.y() * p.x() - p.y(); }
};

/// From the crown to the left springing.
std::vector<JointBounds> bounds_of_joints(const RigidArch& arch) {
  std::vector<JointBounds> bounds;
  double weight = 0.0, moment = 0.0;
  const int n = static_cast<int>(arch.voussoirs.size());
  for (int j = n / 2; j >= 0; --j) {  // from the crown's joint, if there is one
    const Polygon half = clipped(arch.voussoirs[static_cast<std::size_t>(j)], {1.0, 0.0}, 0.0);
    const double size = half.size() < 3 ? 0.0 : std::abs(area(half));
    weight += size;
    if (size > 0.0) moment += size * centroid(half).x();
    const auto& [inner, outer] = arch.joints[static_cast<std::size_t>(j)];
    bounds.push_back({j, inner, outer, weight, moment});
  }
  return bounds;
}

/// All (H, H y) with which the thrust passes through all joints.
Polygon possible_thrusts(const RigidArch& arch) {
  Polygon possible = {{0.0, -1e3}, {1e3, -1e3}, {1e3, 1e3}, {0.0, 1e3}};
  for (const JointBounds& joint : bounds_of_joints(arch)) {
    possible = clipped(possible, [&](const Point& p) { return -joint.inner_room(p); });
    possible = clipped(possible, [&](const Point& p) { return -joint.outer_room(p); });
  }
  return possible;
}

}  // namespace

bool symmetric_arch_stands(const RigidArch& arch) {
  return !possible_thrusts(arch).empty();
}

std::optional<LeastThrust> least_thrust(const RigidArch& arch) {
  const Polygon possible = possible_thrusts(arch);
  if (possible.empty()) return std::nullopt;
  const Point least = *std::ranges::min_element(possible, {}, [](const Point& p) { return p.x(); });
  LeastThrust found{.thrust = least.x()};
  double outer_room = std::numeric_limits<double>::infinity(), inner_room = outer_room;
  for (const JointBounds& joint : bounds_of_joints(arch)) {
    const double outer = joint.outer_room(least), inner = joint.inner_room(least);
    if (outer < outer_room) found.outer = joint.number;
    if (inner < inner_room) found.inner = joint.number;
    outer_room = std::min(outer_room, outer);
    inner_room = std::min(inner_room, inner);
  }
  return found;
}

std::optional<Mechanism> weakest_mechanism(const RigidArch& arch, int loaded, const Point& place) {
  std::optional<Mechanism> weakest;
  const int joints = static_cast<int>(arch.joints.size());
  std::array<int, 4> at{};
  const auto try_one = [&](bool first_inside) {
    std::array<Point, 4> hinges;
    for (std::size_t i = 0; i < 4; ++i) {
      const RigidJoint& joint = arch.joints[static_cast<std::size_t>(at[i])];
      hinges[i] = (i % 2 == 0) == first_inside ? joint.inner : joint.outer;
    }
    auto bodies = movements(hinges);
    if (!bodies) return;
    if (!opens(*bodies, first_inside)) {
      for (Movement& body : *bodies) body = {-body.origin, -body.turn};
      if (!opens(*bodies, first_inside)) return;
    }
    double by_weight = 0.0, by_load = 0.0;
    for (std::size_t b = 0; b < 3; ++b)
      for (int v = at[b]; v < at[b + 1]; ++v) {
        const Polygon& voussoir = arch.voussoirs[static_cast<std::size_t>(v)];
        by_weight -= std::abs(area(voussoir)) * (*bodies)[b].at(centroid(voussoir)).y();
        if (v == loaded) by_load -= (*bodies)[b].at(place).y();
      }
    if (by_load <= 1e-12) return;
    const double load = -by_weight / by_load;
    if (!weakest || load < weakest->load) weakest = Mechanism{load, at, first_inside};
  };
  for (at[0] = 0; at[0] < joints; ++at[0])
    for (at[1] = at[0] + 1; at[1] < joints; ++at[1])
      for (at[2] = at[1] + 1; at[2] < joints; ++at[2])
        for (at[3] = at[2] + 1; at[3] < joints; ++at[3])
          for (const bool first_inside : {false, true}) try_one(first_inside);
  return weakest;
}

}  // namespace voussoir::validation
