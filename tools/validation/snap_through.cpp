#include "tools/validation/snap_through.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unsupported/Eigen/AutoDiff>
#include <utility>

#include "core/error.h"

namespace voussoir::validation {
namespace {

constexpr double kSinkingStep = 0.02;     ///< of the sinking so far: the greatest force is met within 1e-4
constexpr double kLeastStep = 1e-6;       ///< where Newton's method fails, a step is halved
constexpr double kFallen = 0.98;          ///< of the greatest force: it has been passed
constexpr int kStretches = 20;            ///< of the closed part of a joint, two Gauss points each
constexpr int kMostIterations = 40;       ///< of Newton's method
constexpr double kForceTolerance = 1e-6;  ///< of forces [weight of 1 m2] and, relative, of the sinking

/// A number with its derivatives by the movements of the two bodies at a joint.
using Derivatives = Eigen::Matrix<double, 6, 1>;
using Number = Eigen::AutoDiffScalar<Derivatives>;

struct Vector {
  Number x = 0.0, y = 0.0;
};
Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y};
}
Vector operator*(const Number& factor, const Vector& v) {
  return {factor * v.x, factor * v.y};
}
Number dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y;
}
Number cross(const Vector& a, const Vector& b) {
  return a.x * b.y - a.y * b.x;
}
Vector fixed(const Point& p) {
  return {p.x(), p.y()};
}

/// How the origin of a body moves, and the body about it.
struct BodyMovement {
  Vector origin;
  Number turn = 0.0;
  /// Of a point. Cosine less 1 is no difference here: turns are as small as joints are stiff.
  Vector of(const Point& p) const {
    const Number sine = sin(turn), half = sin(0.5 * turn), fall = -2.0 * half * half;
    return origin + Vector{fall * p.x() - sine * p.y(), sine * p.x() + fall * p.y()};
  }
};

/// Three movements of every voussoir times the joints' stiffness, and the force.
struct Equilibrium {
  Eigen::VectorXd movements;
  double force = 0.0;
};

class RingOnJoints {
 public:
  RingOnJoints(const RigidArch& arch, int loaded, const Point& place, const ElasticJoints& joints)
      : arch_(arch), loaded_(loaded), place_(place), joints_(joints) {}

  Equilibrium at_rest() const { return {Eigen::VectorXd::Zero(size()), 0.0}; }
  double sinking(const Equilibrium& at) const { return at.movements[3 * loaded_ + 1]; }
  /// Newton's method, under the weight alone or with the loaded voussoir held so deep by the force.
  bool find(std::optional<double> depth, Equilibrium& at);

 private:
  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(arch_.voussoirs.size()); }
  void add_joint(int joint, const Eigen::VectorXd& movements);
  void add_load(int body, const Point& place, double force, const Eigen::VectorXd& movements);
  void assemble(const Equilibrium& at);

  const RigidArch& arch_;
  int loaded_;
  Point place_;
  ElasticJoints joints_;
  Eigen::VectorXd unbalanced_;  ///< forces and moments about each body's origin
  Eigen::MatrixXd tangent_;     ///< d unbalanced / d movements
};

/// What the faces of a joint do to the body on its right: force and moment about (0, 0).
struct JointForce {
  Vector force;
  Number moment = 0.0;
};

JointForce force_of(const RigidJoint& joint, const BodyMovement& left, const BodyMovement& right,
                    const ElasticJoints& law) {
  JointForce sum;
  const Point along = (joint.outer - joint.inner).normalized();
  const Number turn = 0.5 * (left.turn + right.turn), cosine = cos(turn), sine = sin(turn);
  const Vector tangent{cosine * along.x() - sine * along.y(), sine * along.x() + cosine * along.y()};
  const Vector normal{tangent.y, -tangent.x};  // from the left face to the right one
  const Vector start = right.of(joint.inner) - left.of(joint.inner);
  const Vector change = right.of(joint.outer) - left.of(joint.outer) - start;
  const Number gap = dot(start, normal), more = dot(change, normal);
  const Number other = gap + more;
  if (gap > 0.0 && other > 0.0) return sum;
  const Number begin = gap > 0.0 ? Number(-gap / more) : Number(0.0);
  const Number end = other > 0.0 ? Number(-gap / more) : Number(1.0);
  const Number weight = (end - begin) * (0.5 * (joint.outer - joint.inner).norm() / kStretches);
  for (int k = 0; k < 2 * kStretches; ++k) {
    const double gauss = (k % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0);
    const Number share = begin + (end - begin) * ((k / 2 + 0.5 + gauss) / kStretches);
    const Number pressure = -law.stiffness * (gap + share * more);
    const Number bound = law.friction * pressure;
    const Number stuck = law.stiffness * (dot(start, tangent) + share * dot(change, tangent));
    const Number shear = stuck > bound ? bound : stuck < -bound ? Number(-bound) : stuck;
    const Vector force = weight * (pressure * normal - shear * tangent);
    // Both faces are pressed at the same place, half-way between their images of the point.
    const Vector inner = fixed(joint.inner) + left.of(joint.inner) + Number(0.5) * start;
    const Vector outer = fixed(joint.outer) + left.of(joint.outer) + Number(0.5) * (start + change);
    sum.force = sum.force + force;
    sum.moment += cross(inner + share * (outer - inner), force);
  }
  return sum;
}

void RingOnJoints::add_joint(int joint, const Eigen::VectorXd& movements) {
  const auto place = [&](int i) { return 3 * (joint - 1 + i / 3) + i % 3; };  // beyond the ends: rigid ground
  const auto moves = [&](int i) { return place(i) >= 0 && place(i) < size(); };
  std::array<Number, 6> all;
  for (int i = 0; i < 6; ++i)
    all.at(static_cast<std::size_t>(i)) = Number(moves(i) ? movements[place(i)] / joints_.stiffness : 0.0,
                                                 Derivatives::Unit(i) / joints_.stiffness);
  const BodyMovement left{{all[0], all[1]}, all[2]}, right{{all[3], all[4]}, all[5]};
  const JointForce on_right = force_of(arch_.joints[static_cast<std::size_t>(joint)], left, right, joints_);
  const std::array<Number, 6> forces = {
      -on_right.force.x, -on_right.force.y, cross(left.origin, on_right.force) - on_right.moment,
      on_right.force.x,  on_right.force.y,  on_right.moment - cross(right.origin, on_right.force)};
  for (int i = 0; i < 6; ++i) {
    if (!moves(i)) continue;
    const Number& force = forces.at(static_cast<std::size_t>(i));
    unbalanced_[place(i)] += force.value();
    for (int k = 0; k < 6; ++k)
      if (moves(k)) tangent_(place(i), place(k)) += force.derivatives()[k];
  }
}

void RingOnJoints::add_load(int body, const Point& place, double force, const Eigen::VectorXd& movements) {
  const double turn = movements[3 * body + 2] / joints_.stiffness;
  const Point arm = Eigen::Rotation2Dd(turn) * place;
  unbalanced_[3 * body + 1] -= force;
  unbalanced_[3 * body + 2] -= force * arm.x();
  tangent_(3 * body + 2, 3 * body + 2) += force * arm.y() / joints_.stiffness;
}

void RingOnJoints::assemble(const Equilibrium& at) {
  unbalanced_.setZero(size());
  tangent_.setZero(size(), size());
  for (int joint = 0; joint < static_cast<int>(arch_.joints.size()); ++joint) add_joint(joint, at.movements);
  for (int body = 0; body < static_cast<int>(arch_.voussoirs.size()); ++body) {
    const Polygon& voussoir = arch_.voussoirs[static_cast<std::size_t>(body)];
    add_load(body, centroid(voussoir), std::abs(area(voussoir)), at.movements);
  }
  add_load(loaded_, place_, at.force, at.movements);
}

bool RingOnJoints::find(std::optional<double> depth, Equilibrium& at) {
  const Eigen::Index n = size();
  for (int i = 0; i < kMostIterations; ++i) {
    assemble(at);
    const double off = depth ? *depth - sinking(at) : 0.0;
    if (unbalanced_.lpNorm<Eigen::Infinity>() < kForceTolerance * (1.0 + at.force) &&
        std::abs(off) <= kForceTolerance * std::abs(sinking(at)))
      return true;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 1, n + 1);
    matrix.topLeftCorner(n, n) = tangent_;
    matrix(3 * loaded_ + 1, n) = -1.0;
    matrix(3 * loaded_ + 2, n) =
        -(Eigen::Rotation2Dd(at.movements[3 * loaded_ + 2] / joints_.stiffness) * place_).x();
    matrix(n, depth ? 3 * loaded_ + 1 : n) = 1.0;
    Eigen::VectorXd right(n + 1);
    right << -unbalanced_, off;
    const Eigen::VectorXd change = matrix.partialPivLu().solve(right);
    at.movements += change.head(n);
    at.force += change[n];
  }
  return false;
}

}  // namespace

double snap_through_force(const RigidArch& arch, int loaded, const Point& place,
                          const ElasticJoints& joints) {
  RingOnJoints ring(arch, loaded, place, joints);
  Equilibrium at = ring.at_rest();
  if (!ring.find(std::nullopt, at)) throw Failure("no equilibrium under the weight");
  Equilibrium before = at;
  double greatest = 0.0, step = kSinkingStep;
  while (at.force >= kFallen * greatest) {
    greatest = std::max(greatest, at.force);
    const double deeper = step * ring.sinking(at), last = ring.sinking(at) - ring.sinking(before);
    const double share = last == 0.0 ? 0.0 : deeper / last;
    Equilibrium next{at.movements + share * (at.movements - before.movements),
                     at.force + share * (at.force - before.force)};
    if (ring.find(ring.sinking(at) + deeper, next)) {
      before = std::exchange(at, next);
      step = std::min(2.0 * step, kSinkingStep);
    } else if ((step *= 0.5) < kLeastStep) {
      throw Failure("no equilibrium of the ring with its voussoir held");
    }
  }
  return greatest;
}

}  // namespace voussoir::validation
