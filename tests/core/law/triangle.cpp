#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "core/law/joint_kinematics.h"
#include "core/law/triangle.h"
#include "core/statics/equilibrium.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

const std::array<Point, 3> kCorners = {Point(0.1, 0.2), Point(1.3, 0.1), Point(0.4, 0.9)};

TriangleShape shape() {
  return triangle_shape(kCorners[0], kCorners[1], kCorners[2]);
}

Vector6d rotated_by(double angle) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Vector6d q;
  for (int i = 0; i < 3; ++i)
    q.segment<2>(2 * i) =
        turn * kCorners[static_cast<std::size_t>(i)] - kCorners[static_cast<std::size_t>(i)];
  return q;
}

/// Two edges of two blocks that face each other over part of their length, in a skew direction.
struct SkewJoint {
  Mesh mesh;
  Joint joint;
};

SkewJoint skew_joint() {
  SkewJoint result;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  result.mesh.nodes.resize(2, 4);
  result.mesh.nodes << 0.0, 1.0, 1.4, 0.3, 0.0, 0.0, 0.0, 0.0;
  result.mesh.nodes = turn * result.mesh.nodes;
  result.joint = {.first = BlockId{0},
                  .second = BlockId{1},
                  .first_edge = {NodeId{0}, NodeId{1}},
                  .second_edge = {NodeId{2}, NodeId{3}},
                  .first_at = {0.3, 1.0},
                  .second_at = {1.0, 0.4 / 1.1},
                  .length = 0.7};
  return result;
}

Vector8d random_displacement(std::mt19937& generator, double size) {
  std::normal_distribution<double> normal(0.0, size);
  return Vector8d::NullaryExpr([&] { return normal(generator); });
}

/// Of all triangles [m].
double smallest_height(const Mesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = mesh.position(triangle.nodes[i]), b = mesh.position(triangle.nodes[(i + 1) % 3]),
                  c = mesh.position(triangle.nodes[(i + 2) % 3]);
      smallest = std::min(smallest, std::abs(cross(b - a, c - a)) / (b - a).norm());
    }
  return smallest;
}

/// The small bridge without a block of its wall.
struct DamagedBridge {
  Model bridge = test::small_bridge();
  EquilibriumSystem system{bridge};
  Coefficients coefficients{system, bridge.parameters};
  Scene scene = parse_scene("4,2", bridge.layout);
  StageEquations equations{system, coefficients, {.scene = scene}};

  /// Where nothing holds it, each component by itself.
  Field random_field(std::mt19937& generator, double size) const {
    std::normal_distribution<double> normal(0.0, 1.0);
    Field field = Field::Zero(2, bridge.mesh.node_count());
    for (const int c : system.component) field.data()[c] = size * normal(generator);
    return field;
  }
};

}  // namespace

TEST_CASE("A constant strain gives the stress of Hooke's law in any direction", "[element]") {
  const Material material;
  const double e = 1e-7;
  Vector6d q;
  for (int i = 0; i < 3; ++i) q.segment<2>(2 * i) << e * kCorners[static_cast<std::size_t>(i)].x(), 0.0;
  const Eigen::Vector3d stress = triangle_stress(shape(), plane_moduli(material), q);
  CHECK(stress[0] == Approx(2.5e10 / (1 - 0.04) * e).epsilon(1e-6));
  CHECK(stress[1] == Approx(0.2 * stress[0]).epsilon(1e-6));
  CHECK(std::abs(stress[2]) < 1e-9 * stress[0]);
}

TEST_CASE("A patch in pure shear carries G = E / (2 (1 + nu)) times the shear strain (closed form)",
          "[element]") {
  // A square of 1 m, cut into four triangles about a place that is not its middle, sheared by u = (k y, k x)
  // / 2.
  const std::vector<Point> corners = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  const Point inside(0.4, 0.55);
  const double shear = 1e-6;
  const double thickness = 0.7;
  const auto displaced = [&](const Point& p) { return Point(0.5 * shear * p.y(), 0.5 * shear * p.x()); };
  for (const PlaneState plane : {PlaneState::stress, PlaneState::strain}) {
    Material material;
    material.plane = plane;
    std::array<Point, 4> force;
    force.fill(Point::Zero());
    Point force_inside = Point::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      const TriangleShape part = triangle_shape(corners[i], corners[next], inside);
      Vector6d q;
      q << displaced(corners[i]), displaced(corners[next]), displaced(inside);
      const Eigen::Vector3d stress = triangle_stress(part, plane_moduli(material), q);
      CHECK(stress[2] == Approx(2.5e10 / 2.4 * shear).epsilon(1e-9));
      const Vector6d f = triangle_force(part, plane_moduli(material), thickness, q);
      force[i] += f.segment<2>(0);
      force[next] += f.segment<2>(2);
      force_inside += f.segment<2>(4);
    }
    // Normal stresses are of the order of the shear squared: a millionth of the shear stress.
    const double edge = 2.5e10 / 2.4 * shear * thickness;  // on each edge of 1 m, along it
    CHECK(force_inside.norm() < 1e-12 * edge);
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = corners[i].x() > 0.5 ? 1.0 : -1.0;
      const double y = corners[i].y() > 0.5 ? 1.0 : -1.0;
      INFO("corner " << i);
      CHECK(force[i].x() == Approx(0.5 * y * edge).epsilon(1e-5));
      CHECK(force[i].y() == Approx(0.5 * x * edge).epsilon(1e-5));
    }
  }
}

TEST_CASE("Plane strain is stiffer than plane stress by the closed form", "[element]") {
  Material strain;
  strain.plane = PlaneState::strain;
  CHECK(plane_moduli(strain).a == Approx(2.5e10 * 0.8 / (1.2 * 0.6)));
  CHECK(plane_moduli(strain).g == Approx(plane_moduli(Material{}).g));
}

TEST_CASE("A rigid rotation of any angle gives no stress and no force", "[element]") {
  for (const double angle : {1e-3, 0.5, 2.0, -3.0}) {
    const Vector6d q = rotated_by(angle);
    CHECK(triangle_stress(shape(), plane_moduli({}), q).norm() < 1e-4);  // E times round-off: 2.5e10 x 1e-16
    CHECK(triangle_force(shape(), plane_moduli({}), 1.0, q).norm() < 1e-4);
  }
}

TEST_CASE("The triangle's tangent is the derivative of its force at large displacements", "[element]") {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0.0, 0.1);
  int checked = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Vector6d q = Vector6d::NullaryExpr([&] { return normal(generator); });
    const TriangleResponse response = triangle_response(shape(), plane_moduli({}), 1.0, q);
    CHECK((response.force - triangle_force(shape(), plane_moduli({}), 1.0, q)).norm() <
          1e-9 * response.force.norm());
    for (int k = 0; k < 6; ++k) {
      const double h = 1e-6;
      const Vector6d dx = h * Vector6d::Unit(k);
      const Vector6d difference = (triangle_force(shape(), plane_moduli({}), 1.0, q + dx) -
                                   triangle_force(shape(), plane_moduli({}), 1.0, q - dx)) /
                                  (2 * h);
      CHECK((difference - response.tangent.col(k)).norm() < 1e-7 * response.tangent.norm());
      ++checked;
    }
  }
  CHECK(checked == 300);
}

TEST_CASE("Gap and slip do not change under a rigid motion of both blocks", "[joint]") {
  const SkewJoint s = skew_joint();
  const JointFrame frame = make_joint_frame(s.joint, s.mesh);
  std::mt19937 generator(4);
  const Vector8d q = random_displacement(generator, 1e-2);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  Vector8d moved;
  for (int i = 0; i < 4; ++i)
    moved.segment<2>(2 * i) =
        turn * (s.mesh.nodes.col(i) + q.segment<2>(2 * i)) + Point(5.0, -3.0) - s.mesh.nodes.col(i);
  CHECK((joint_kinematics(frame, q).state - joint_kinematics(frame, moved).state).norm() < 1e-14);
}

TEST_CASE("A joint's direction turns by the mean of its edges' turns, far or not (closed form)", "[joint]") {
  const SkewJoint s = skew_joint();
  const JointFrame frame = make_joint_frame(s.joint, s.mesh);
  for (const auto& [first, second] :
       {std::pair{1e-9, -3e-9}, {0.3, 0.1}, {-2.0, -1.5}, {3.0, 3.1}, {1.4, -1.4}}) {
    Vector8d q;
    q << 0.0, 0.0, Eigen::Rotation2Dd(first) * frame.first_along - frame.first_along,
        Eigen::Rotation2Dd(second) * frame.second_along - frame.second_along, 0.0, 0.0;
    const Point expected = Eigen::Rotation2Dd(0.5 * (first + second)) * frame.direction;
    CHECK((joint_pose(frame, q).along - expected).norm() < 1e-15 * 4.0);
  }
}

TEST_CASE("Forces on a joint's corners do the work of its forces (virtual work)", "[joint]") {
  const SkewJoint s = skew_joint();
  const JointFrame frame = make_joint_frame(s.joint, s.mesh);
  std::mt19937 generator(8);
  const Eigen::Vector4d force(-3.0, 1.0, -2.0, 0.5);
  for (int trial = 0; trial < 20; ++trial) {
    const JointKinematics at = joint_kinematics(frame, random_displacement(generator, 0.05));
    CHECK((corner_forces(frame, at, force) - at.gradient.transpose() * force).norm() < 1e-13);
  }
}

TEST_CASE("Joint forces balance in force and moment at large displacements", "[joint]") {
  const SkewJoint s = skew_joint();
  const JointFrame frame = make_joint_frame(s.joint, s.mesh);
  std::mt19937 generator(5);
  const Vector8d q = random_displacement(generator, 0.05);
  const JointKinematics k = joint_kinematics(frame, q);
  const Vector8d f = k.gradient.transpose() * Eigen::Vector4d(-3.0, 1.0, -2.0, 0.5);
  Point sum = Point::Zero();
  double moment = 0.0;
  for (int i = 0; i < 4; ++i) {
    sum += f.segment<2>(2 * i);
    moment += cross(s.mesh.nodes.col(i) + q.segment<2>(2 * i), f.segment<2>(2 * i));
  }
  CHECK(sum.norm() < 1e-13);
  CHECK(std::abs(moment) < 1e-13);
}

TEST_CASE("Gradient and geometric stiffness of a joint are derivatives of its state", "[joint]") {
  const SkewJoint s = skew_joint();
  const JointFrame frame = make_joint_frame(s.joint, s.mesh);
  std::mt19937 generator(6);
  const Eigen::Vector4d force(-3.0, 1.0, -2.0, 0.5);
  int checked = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Vector8d q = random_displacement(generator, 0.05);
    const JointKinematics at = joint_kinematics(frame, q);
    const Matrix8d geometric = joint_geometric_stiffness(frame, q, at, force);
    for (int k = 0; k < 8; ++k) {
      const Vector8d dx = 1e-6 * Vector8d::Unit(k);
      const JointKinematics up = joint_kinematics(frame, q + dx);
      const JointKinematics down = joint_kinematics(frame, q - dx);
      CHECK(((up.state - down.state) / 2e-6 - at.gradient.col(k)).norm() < 1e-8);
      CHECK(((up.gradient - down.gradient).transpose() * force / 2e-6 - geometric.col(k)).norm() < 1e-7);
      ++checked;
    }
  }
  CHECK(checked == 160);
}

TEST_CASE("The bridge's tangent is the derivative of its unbalanced forces", "[equilibrium]") {
  const DamagedBridge damaged;
  const auto& [bridge, system, coefficients, scene, equations] = damaged;
  std::mt19937 generator(7);
  const Field u = damaged.random_field(generator, 1e-4), direction = damaged.random_field(generator, 1.0);
  Eigen::SparseMatrix<double> tangent = system.pattern;
  assemble(equations, u, 0.0, {tangent.valuePtr()});
  const double h = 1e-9;
  const Field difference =
      (unbalanced_forces(equations, u - h * direction) - unbalanced_forces(equations, u + h * direction)) /
      (2 * h);
  Eigen::VectorXd along(system.unknown_count());
  for (int i = 0; i < along.size(); ++i)
    along[i] = direction.data()[system.component[static_cast<std::size_t>(i)]];
  const Eigen::VectorXd predicted = tangent * along;
  int checked = 0;
  for (int i = 0; i < along.size(); ++i) {
    const int c = system.component[static_cast<std::size_t>(i)];
    const IndexRange gone = bridge.mesh.block_nodes[static_cast<std::size_t>(value(scene.removed.front()))];
    if (gone.contains(c / 2)) continue;
    CHECK(std::abs(difference.data()[c] - predicted[i]) < 1e-8 * predicted.cwiseAbs().maxCoeff());
    ++checked;
  }
  CHECK(checked > 300);
}

TEST_CASE("With triangles at rest the tangent is exact at rest, and near it off by their turns alone",
          "[equilibrium]") {
  const DamagedBridge damaged;
  const auto& [bridge, system, coefficients, scene, equations] = damaged;
  std::mt19937 generator(9);
  for (const double size : {0.0, 1e-6, 1e-4}) {
    const Field u = damaged.random_field(generator, size);
    Eigen::SparseMatrix<double> exact = system.pattern, near = system.pattern;
    const Field forces = assemble(equations, u, 0.0, {exact.valuePtr()});
    const Field same = assemble(equations, u, 0.0, {near.valuePtr()}, ElasticPart::at_rest);
    CHECK((same - forces).cwiseAbs().maxCoeff() <= 1e-12 * forces.cwiseAbs().maxCoeff());
    // The displacement gradient H of a triangle is at most two displacements over its height; to first order
    // its tangent B^T C B + stress changes by no more than four times that.
    const double steepest = 2.0 * u.colwise().norm().maxCoeff() / smallest_height(bridge.mesh);
    CHECK((exact - near).norm() <= (1e-14 + 4.0 * steepest) * exact.norm());
    if (size > 0.0) CHECK((exact - near).norm() > 0.1 * size * exact.norm());
  }
}
