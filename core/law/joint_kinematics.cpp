#include "core/law/joint_kinematics.h"

namespace voussoir {
namespace {

/// Turned clockwise by a right angle: from the joint's direction to its normal.
Point clockwise(const Point& v) {
  return {v.y(), -v.x()};
}

struct CurrentEdges {
  Point first;   ///< first edge now, from -> to
  Point second;  ///< second edge now, to -> from
};

CurrentEdges current_edges(const JointFrame& frame, const Vector8d& q) {
  return {frame.first_along + q.segment<2>(2) - q.segment<2>(0),
          frame.second_along + q.segment<2>(4) - q.segment<2>(6)};
}

/// The vector turned by an angle, (cos, sin).
Point turned(const Point& v, const Point& by) {
  return {v.x() * by.x() - v.y() * by.y(), v.x() * by.y() + v.y() * by.x()};
}

/// (cos, sin) of the angle from one unit vector to another.
Point angle_between(const Point& from, const Point& to) {
  return {from.dot(to), cross(from, to)};
}

/// d theta / d q.
Vector8d rotation_gradient(const JointPose& pose) {
  Vector8d gradient;
  gradient << -pose.turn[0], pose.turn[0], pose.turn[1], -pose.turn[1];
  return gradient;
}

/// d angle / d vector of a vector's direction angle.
Point angle_gradient(const Point& v) {
  return Point(-v.y(), v.x()) / v.squaredNorm();
}

/// Second derivative of a vector's direction angle.
Eigen::Matrix2d angle_hessian(const Point& v) {
  const double x = v.x();
  const double y = v.y();
  Eigen::Matrix2d h;
  h << 2.0 * x * y, y * y - x * x, y * y - x * x, -2.0 * x * y;
  return h / (v.squaredNorm() * v.squaredNorm());
}

Point jump(const JointFrame& frame, const Vector8d& q, std::size_t end) {
  Point j = frame.offset[end];
  for (int corner = 0; corner < 4; ++corner) j += frame.weights[end][corner] * q.segment<2>(2 * corner);
  return j;
}

}  // namespace

JointFrame make_joint_frame(const Joint& joint, const Mesh& mesh) {
  const std::array<Point, 4> x = {mesh.position(joint.first_edge.from), mesh.position(joint.first_edge.to),
                                  mesh.position(joint.second_edge.from), mesh.position(joint.second_edge.to)};
  JointFrame frame;
  frame.first_along = x[1] - x[0];
  frame.second_along = x[2] - x[3];
  const Point first = frame.first_along.normalized(), second = frame.second_along.normalized();
  frame.direction = (first + second).normalized();
  frame.from_edge = {angle_between(first, frame.direction), angle_between(second, frame.direction)};
  for (std::size_t end = 0; end < 2; ++end) {
    const double a = joint.first_at[end];
    const double b = joint.second_at[end];
    frame.weights[end] << a - 1.0, -a, 1.0 - b, b;
    // Differences of near points, so that round-off does not grow with the distance from the origin.
    frame.offset[end] = (x[2] - x[0]) + b * (x[3] - x[2]) - a * (x[1] - x[0]);
    if (frame.offset[end].norm() < 1e-12 * frame.first_along.norm()) frame.offset[end].setZero();
  }
  return frame;
}

JointPose joint_pose(const JointFrame& frame, const Vector8d& q) {
  const CurrentEdges edges = current_edges(frame, q);
  JointPose pose;
  pose.turn = {0.5 * angle_gradient(edges.first), 0.5 * angle_gradient(edges.second)};
  // The joint's direction as either edge has turned it; both have the same length.
  const Point by_first = edges.second.norm() * turned(edges.first, frame.from_edge[0]);
  const Point by_second = edges.first.norm() * turned(edges.second, frame.from_edge[1]);
  pose.along = (by_first + by_second) / (by_first + by_second).norm();
  const Point n = clockwise(pose.along);
  for (std::size_t end = 0; end < 2; ++end) {
    const Point j = jump(frame, q, end);
    const int gap = 2 * static_cast<int>(end);
    pose.state[gap] = n.dot(j);
    pose.state[gap + 1] = pose.along.dot(j);
  }
  return pose;
}

Vector8d corner_forces(const JointFrame& frame, const JointPose& pose, const Eigen::Vector4d& force) {
  const Point n = clockwise(pose.along);
  double moment = 0.0;  // conjugate to theta: dn/dtheta = t, dt/dtheta = -n
  std::array<Point, 2> on_end;
  for (int end = 0; end < 2; ++end) {
    const int gap = 2 * end, slip = gap + 1;
    moment += force[gap] * pose.state[slip] - force[slip] * pose.state[gap];
    on_end[static_cast<std::size_t>(end)] = force[gap] * n + force[slip] * pose.along;
  }
  Vector8d forces = moment * rotation_gradient(pose);
  for (int corner = 0; corner < 4; ++corner)
    forces.segment<2>(2 * corner) +=
        frame.weights[0][corner] * on_end[0] + frame.weights[1][corner] * on_end[1];
  return forces;
}

JointKinematics joint_kinematics(const JointFrame& frame, const Vector8d& q) {
  JointKinematics result{joint_pose(frame, q), {}};
  const Point& t = result.along;
  const Point n = clockwise(t);
  const Vector8d turn = rotation_gradient(result);
  for (std::size_t end = 0; end < 2; ++end) {
    const int gap = 2 * static_cast<int>(end);
    const int slip = gap + 1;
    // dn/dtheta = t, dt/dtheta = -n
    result.gradient.row(gap) = result.state[slip] * turn.transpose();
    result.gradient.row(slip) = -result.state[gap] * turn.transpose();
    for (int corner = 0; corner < 4; ++corner) {
      result.gradient.block<1, 2>(gap, 2 * corner) += frame.weights[end][corner] * n.transpose();
      result.gradient.block<1, 2>(slip, 2 * corner) += frame.weights[end][corner] * t.transpose();
    }
  }
  return result;
}

Matrix8d joint_geometric_stiffness(const JointFrame& frame, const Vector8d& q,
                                   const JointKinematics& kinematics, const Eigen::Vector4d& force) {
  // With total gradients, and dgap/dtheta = slip, dslip/dtheta = -gap:
  //   d2 gap  =  dslip (x) dtheta + dtheta (x) dslip + gap  dtheta (x) dtheta + slip d2theta
  //   d2 slip = -dgap (x) dtheta - dtheta (x) dgap  + slip dtheta (x) dtheta - gap  d2theta
  const Vector8d turn = rotation_gradient(kinematics);
  Vector8d mixed = Vector8d::Zero();
  double turning = 0.0;  // coefficient of dtheta (x) dtheta
  double bending = 0.0;  // coefficient of d2theta
  for (int end = 0; end < 2; ++end) {
    const int gap = 2 * end;
    const int slip = gap + 1;
    mixed += force[gap] * kinematics.gradient.row(slip).transpose() -
             force[slip] * kinematics.gradient.row(gap).transpose();
    turning += force[gap] * kinematics.state[gap] + force[slip] * kinematics.state[slip];
    bending += force[gap] * kinematics.state[slip] - force[slip] * kinematics.state[gap];
  }
  Matrix8d stiffness =
      mixed * turn.transpose() + turn * mixed.transpose() + turning * turn * turn.transpose();

  const CurrentEdges edges = current_edges(frame, q);
  const Eigen::Matrix2d first = 0.5 * bending * angle_hessian(edges.first);
  const Eigen::Matrix2d second = 0.5 * bending * angle_hessian(edges.second);
  stiffness.block<2, 2>(0, 0) += first;
  stiffness.block<2, 2>(2, 2) += first;
  stiffness.block<2, 2>(0, 2) -= first;
  stiffness.block<2, 2>(2, 0) -= first;
  stiffness.block<2, 2>(4, 4) += second;
  stiffness.block<2, 2>(6, 6) += second;
  stiffness.block<2, 2>(4, 6) -= second;
  stiffness.block<2, 2>(6, 4) -= second;
  return stiffness;
}

}  // namespace voussoir
