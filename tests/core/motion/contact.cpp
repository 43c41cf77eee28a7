#include "core/motion/contact.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/law/joint_law.h"

namespace voussoir {
namespace {

using Places = std::array<Pair<double>, 4>;

JointMaterial material_with(double friction) {
  return {.normal_stiffness = 1e9, .tangential_stiffness = 1e8, .friction_angle = std::atan(friction)};
}

const ContactMaterial kSmooth(material_with(0.0), 1.0);
const ContactMaterial kRough(material_with(0.7), 1.0);

/// Two edges of lengths 1 and 0.8 at rest.
EdgeContact edges(double share, const ContactMaterial& material = kSmooth) {
  return {.nodes = {0, 1, 2, 3},
          .per_length = {1.0, 1.25},
          .corner_share = {share, share, share, share},
          .joined = share == 0.0,
          .deepest = 0.5,
          .material = material};
}

/// Edge A on the x axis with its block below; edge B above it, turned by an angle, its middle at (x, gap).
Places placed(double x, double gap, double angle) {
  const double half_x = 0.4 * std::cos(angle);
  const double half_y = 0.4 * std::sin(angle);
  return {{{1.0, 0.0}, {0.0, 0.0}, {x - half_x, gap - half_y}, {x + half_x, gap + half_y}}};
}

EdgeForces<double> forces_of(const EdgeContact& contact, const Places& now, const Places& moved = {}) {
  ContactShear<double> shear{0.0, 0.0};
  EdgeForces<double> forces{};
  contact_forces<double>(contact, 1.0, {.now = now, .moved = moved}, shear, forces);
  return forces;
}

/// Brute force: the energy by a fine midpoint rule, with the corners' shares and the fading written out as
/// inequalities.
double energy_of(const EdgeContact& contact, const Places& now) {
  const Pair<double> along_a = now[1] - now[0];
  const Pair<double> along_b = now[2] - now[3];
  const Pair<double> d = along_a * contact.per_length[0] + along_b * contact.per_length[1];
  const double length = std::sqrt(dot(d, d));
  if (length <= kNotFacingLength) return 0.0;
  const Pair<double> t = d * (1.0 / length);
  const Pair<double> n = {t.y, -t.x};
  const double a_end = dot(t, along_a);
  const double b_begin = dot(t, now[3] - now[0]);
  const double b_end = dot(t, now[2] - now[0]);
  const double begin = std::max(0.0, b_begin);
  const double end = std::min(a_end, b_end);
  const double share_0 = b_begin > 0.0 ? contact.corner_share[3] : contact.corner_share[0];
  const double share_1 = b_end < a_end ? contact.corner_share[2] : contact.corner_share[1];
  constexpr int kParts = 200000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double s = begin + (end - begin) * (i + 0.5) / kParts;
    const double h_a = dot(n, along_a) * s / a_end;
    const double h_b = dot(n, now[3] - now[0]) + dot(n, along_b) * (s - b_begin) / (b_end - b_begin);
    const double depth = h_a - h_b;
    if (depth > 0.0 && share_0 * depth < s - begin && share_1 * depth < end - s) sum += depth * depth;
  }
  const double x = std::min(1.0, (length - kNotFacingLength) / (kFullyFacingLength - kNotFacingLength));
  return x * x * (3.0 - 2.0 * x) * 0.5e9 * sum * (end - begin) / kParts;
}

Places moved_by(Places places, int component, double distance) {
  Pair<double>& node = places[static_cast<std::size_t>(component / 2)];
  (component % 2 == 0 ? node.x : node.y) += distance;
  return places;
}

double component(const EdgeForces<double>& forces, int c) {
  const Pair<double>& force = forces[static_cast<std::size_t>(c / 2)];
  return c % 2 == 0 ? force.x : force.y;
}

}  // namespace

TEST_CASE("Forces of a smooth contact are the derivatives of its energy (brute force quadrature)") {
  int checked = 0;
  for (const double angle : {0.0, 0.01, -0.2, 0.85})
    for (const double share : {0.0, angle < 0.8 ? 1.0 : 0.0})  // fading edges hardly own anything at corners
      for (const double x : {0.5, 0.2, 0.9}) {
        const EdgeContact contact = edges(share);
        const Places now = placed(x, -0.02, angle);
        const EdgeForces<double> forces = forces_of(contact, now);
        double largest = 0.0;
        for (int c = 0; c < 8; ++c) largest = std::max(largest, std::abs(component(forces, c)));
        for (int c = 0; c < 8; ++c) {
          constexpr double kShift = 5e-4;
          const double slope =
              (energy_of(contact, moved_by(now, c, kShift)) - energy_of(contact, moved_by(now, c, -kShift))) /
              (2.0 * kShift);
          INFO("share " << share << " angle " << angle << " x " << x << " component " << c);
          CHECK(component(forces, c) == Approx(-slope).margin(3e-3 * largest));
          ++checked;
        }
      }
  CHECK(checked == 2 * 4 * 3 * 8);
}

TEST_CASE(
    "Forces of a rough contact are in balance and leave no couple, wherever the edges are (closed form)") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int touching = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Places now = placed(0.5 + 0.6 * any(random), 0.03 * any(random), 0.5 * any(random));
    Places moved{};
    for (Pair<double>& node : moved) node = {1e-3 * any(random), 1e-3 * any(random)};
    const EdgeForces<double> forces = forces_of(edges(1.0, kRough), now, moved);
    Pair<double> sum{0.0, 0.0};
    double couple = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum = sum + forces[i];
      couple += now[i].x * forces[i].y - now[i].y * forces[i].x;
      size += std::abs(forces[i].x) + std::abs(forces[i].y);
    }
    CHECK(std::abs(sum.x) + std::abs(sum.y) <= 1e-13 * size);
    CHECK(std::abs(couple) <= 1e-13 * size);
    touching += size > 0.0;
  }
  CHECK(touching > 200);
}

TEST_CASE("Faces that overlap by more than they may are seen from behind and do not touch") {
  EdgeContact contact = edges(0.0);
  contact.deepest = 0.1;
  CHECK(forces_of(contact, placed(0.5, -0.099, 0.0))[0].y < 0.0);
  const EdgeForces<double> behind = forces_of(contact, placed(0.5, -0.101, 0.0));
  for (const Pair<double>& force : behind) CHECK((force.x == 0.0 && force.y == 0.0));
}

TEST_CASE("A contact turned and shifted as a whole has forces turned alike (frame invariance)") {
  const double angle = 1.1;
  const auto turned = [&](const Pair<double>& v) {
    return Pair<double>{std::cos(angle) * v.x - std::sin(angle) * v.y,
                        std::sin(angle) * v.x + std::cos(angle) * v.y};
  };
  const Places now = placed(0.3, -0.01, 0.05);
  const Places moved = {{{1e-4, 0.0}, {0.0, 2e-4}, {3e-4, 0.0}, {5e-4, 1e-4}}};
  Places now_turned;
  Places moved_turned;
  for (std::size_t i = 0; i < 4; ++i) {
    now_turned[i] = turned(now[i]) + Pair<double>{3.0, -2.0};
    moved_turned[i] = turned(moved[i]);
  }
  const EdgeForces<double> forces = forces_of(edges(1.0, kRough), now, moved);
  const EdgeForces<double> forces_turned = forces_of(edges(1.0, kRough), now_turned, moved_turned);
  for (std::size_t i = 0; i < 4; ++i) {
    const Pair<double> expected = turned(forces[i]);
    CHECK(forces_turned[i].x == Approx(expected.x).epsilon(1e-9));
    CHECK(forces_turned[i].y == Approx(expected.y).epsilon(1e-9));
  }
}

TEST_CASE("Two facing edges of one length answer as the joint law of the quasi-static equations does") {
  const EdgeContact contact{.nodes = {0, 1, 2, 3},
                            .per_length = {1.0, 1.0},
                            .corner_share = {},
                            .joined = true,
                            .deepest = 0.5,
                            .material = kRough};
  const JointStiffness joint = joint_stiffness(material_with(0.7), 1.0);
  for (const double gap_1 : {-2e-6, 1e-6})
    for (const double slip : {3e-6, 1e-5, -4e-5}) {
      const double gap_0 = -3e-6;
      // t along +x: A from 0 to 1, its block above, so B lies below and the gap is towards -y.
      const Places now = {{{0.0, 0.0}, {1.0, 0.0}, {1.0, -gap_1}, {0.0, -gap_0}}};
      const Places moved = {{{0.0, 0.0}, {0.0, 0.0}, {slip, 0.0}, {slip, 0.0}}};
      const EdgeForces<double> forces = forces_of(contact, now, moved);
      const JointResponse law = integrate_joint(joint, {}, {gap_0, slip, gap_1, slip});
      INFO("gap_1 " << gap_1 << " slip " << slip);
      // The law's forces work on the opening: force on B is their negative.
      const double scale = law.force.cwiseAbs().maxCoeff();
      CHECK(-forces[3].y == Approx(-law.force[0]).margin(1e-4 * scale));
      CHECK(-forces[2].y == Approx(-law.force[2]).margin(1e-4 * scale));
      CHECK(forces[2].x + forces[3].x == Approx(-(law.force[1] + law.force[3])).margin(1e-4 * scale));
    }
}

TEST_CASE("A block that leans over on its edge does not slip at the end that opens (kinematics)") {
  // B above A turns about the common corner in small steps; its base and A's face keep their lengths in the
  // frame.
  const EdgeContact contact{.nodes = {0, 1, 2, 3},
                            .per_length = {1.0, 1.0},
                            .corner_share = {},
                            .joined = true,
                            .deepest = 0.5,
                            .material = kRough};
  constexpr int kSteps = 200;
  constexpr double kLean = 0.2;
  const auto lean = [](double angle) {
    return Places{{{1.0, 0.0}, {0.0, 0.0}, {0.0, -1e-9}, {std::cos(angle), std::sin(angle) - 1e-9}}};
  };
  for (const double ahead : {0.0, 2.0}) {
    ContactShear<double> shear{0.0, 0.0};
    for (int i = 1; i <= kSteps; ++i) {
      const Places before = lean(kLean * (i - 1) / kSteps);
      const Places after = lean(kLean * i / kSteps);
      EdgePlaces<double> edges{.now = {}, .moved = {}, .ahead = ahead};
      for (std::size_t n = 0; n < 4; ++n) {
        edges.moved[n] = after[n] - before[n];
        edges.now[n] = after[n] + edges.moved[n] * ahead;
      }
      EdgeForces<double> forces{};
      contact_forces<double>(contact, 1.0, edges, shear, forces);
    }
    // Along a frame that stands still the open end would slip by 1 - cos 0.2 = 0.02, by half of it in the
    // mean frame.
    INFO("ahead " << ahead);
    CHECK(std::abs(shear.at_0) < 1e-5);
    CHECK(std::abs(shear.at_1) < 1e-5);
  }
}

TEST_CASE("A lane's forces have the same bits whatever the other lanes hold") {
  using Four = DoubleLanes;
  const EdgeContact contact = edges(1.0, kRough);
  const std::array<Places, 4> lanes = {placed(0.5, -0.01, 0.0), placed(0.2, 0.5, 0.3),
                                       placed(0.9, -0.02, 0.8), placed(0.4, -0.03, -0.1)};
  EdgePlaces<Four> together{};
  for (std::size_t i = 0; i < 4; ++i)
    for (int l = 0; l < 4; ++l) {
      set_lane(together.now[i].x, l, lanes[static_cast<std::size_t>(l)][i].x);
      set_lane(together.now[i].y, l, lanes[static_cast<std::size_t>(l)][i].y);
    }
  ContactShear<Four> shear{Four{}, Four{}};
  EdgeForces<Four> forces{};
  REQUIRE(contact_forces<Four>(contact, Four{} + 1.0, together, shear, forces));
  for (int l = 0; l < 4; ++l) {
    const EdgeForces<double> alone = forces_of(contact, lanes[static_cast<std::size_t>(l)]);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(lane(forces[i].x, l) == alone[i].x);
      CHECK(lane(forces[i].y, l) == alone[i].y);
    }
  }
}

}  // namespace voussoir
