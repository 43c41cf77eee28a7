/// @file Intrados curves. Oracles: closed forms of circles, the arithmetic-geometric mean for the ellipse,
/// finite differences for normals.

#include "core/geometry/curve.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/geometry/arc_chain.h"
#include "core/geometry/circular_arc.h"
#include "core/geometry/ellipse.h"
#include "core/geometry/spline.h"

using namespace voussoir;

namespace {

constexpr double kPi = std::numbers::pi;
const Point kMiddle(4.0, 1.5);

struct Named {
  const char* name;
  Curve curve;
  double span, rise;
};

std::vector<Point> points_on_circle(int count, double half_angle) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double angle = half_angle * (1.0 - 2.0 * i / (count - 1));
    points.emplace_back(kMiddle.x() - 5.0 * std::sin(angle), 5.0 * std::cos(angle));
  }
  return points;
}

std::vector<Named> all_curves() {
  return {
      {"semicircle", circular_arc(kMiddle, 3.0, 0.5 * kPi), 6.0, 3.0},
      {"segment", segment_of_circle(kMiddle, 6.0, 1.2), 6.0, 1.2},
      {"pointed", pointed_arch(kMiddle, 6.0, 4.0, pointed_radius(6.0, 4.0)), 6.0, 4.0},
      {"low pointed", pointed_arch(kMiddle, 6.0, 2.0, 5.0), 6.0, 2.0},
      {"three-centred", three_centred_arch(kMiddle, 6.0, 2.0, roundest_haunch_radius(6.0, 2.0)), 6.0, 2.0},
      {"flat ellipse", half_ellipse(kMiddle, 6.0, 2.0), 6.0, 2.0},
      {"steep ellipse", half_ellipse(kMiddle, 6.0, 4.0), 6.0, 4.0},
      {"round ellipse", half_ellipse(kMiddle, 6.0, 3.0), 6.0, 3.0}};
}

/// Unit normal to the outer side. At a corner it is not defined.
Point normal_at(const Curve& curve, const CurvePlace& place) {
  return (curve.point(place, 1.0) - curve.point(place, 0.0)).normalized();
}

/// Length by very many chords.
double length_of_chords(const Curve& curve, double offset, int count) {
  double length = 0.0;
  for (int i = 0; i < count; ++i)
    length +=
        (curve.point({i + 1.0, double(count)}, offset) - curve.point({double(i), double(count)}, offset))
            .norm();
  return length;
}

/// Quarter of an ellipse's length by the arithmetic-geometric mean (Gauss).
double quarter_of_ellipse(double a, double b) {
  double x = a, y = b, power = 0.5, sum = a * a;
  double c = std::sqrt(std::abs(a * a - b * b));
  sum -= power * (a * a - b * b);
  for (int i = 0; i < 40 && std::abs(c) > 1e-17; ++i) {
    c = 0.5 * (x - y);
    const double mean = 0.5 * (x + y);
    y = std::sqrt(x * y);
    x = mean;
    power *= 2.0;
    sum -= power * c * c;
  }
  return 0.5 * kPi * sum / x;
}

}  // namespace

TEST_CASE("Curves go from springing to springing over the crown (their definition)", "[curve]") {
  for (const Named& each : all_curves()) {
    INFO(each.name);
    CHECK((each.curve.point({0.0, 1.0}, 0.0) - (kMiddle - Point(0.5 * each.span, 0.0))).norm() < 1e-12);
    CHECK((each.curve.point({1.0, 1.0}, 0.0) - (kMiddle + Point(0.5 * each.span, 0.0))).norm() < 1e-12);
    CHECK((each.curve.point({1.0, 2.0}, 0.0) - (kMiddle + Point(0.0, each.rise))).norm() < 1e-12);
  }
}

TEST_CASE("Equal parts of a curve are equally long, and all of them make its length (many chords)",
          "[curve]") {
  constexpr int kChords = 20000;  // chords are short by length^3 / 24 radius^2: 1e-9 of each
  for (const Named& each : all_curves()) {
    INFO(each.name);
    CHECK(length_of_chords(each.curve, 0.0, kChords) == Approx(each.curve.length).epsilon(1e-7));
    const double one = each.curve.length / kChords;
    double least = 1.0, most = 0.0;
    for (int i = 0; i < kChords; i += 7) {
      const double chord = (each.curve.point({i + 1.0, double(kChords)}, 0.0) -
                            each.curve.point({double(i), double(kChords)}, 0.0))
                               .norm();
      least = std::min(least, chord);
      most = std::max(most, chord);
    }
    CHECK(least > one * (1.0 - 1e-6));
    CHECK(most < one * (1.0 + 1e-6));
  }
}

TEST_CASE("Lengths of arches are those of their circles, and of ellipses that of Gauss's mean", "[curve]") {
  const auto curves = all_curves();
  CHECK(curves[0].curve.length == Approx(3.0 * kPi).epsilon(1e-14));
  const double radius = (9.0 + 1.44) / 2.4;
  CHECK(curves[1].curve.length == Approx(2.0 * radius * std::asin(3.0 / radius)).epsilon(1e-13));
  const double pointed = 1.5 + 16.0 / 6.0;  // centres on the springing line
  CHECK(curves[2].curve.length ==
        Approx(2.0 * pointed * std::acos((pointed - 3.0) / pointed)).epsilon(1e-13));
  CHECK(curves[5].curve.length == Approx(2.0 * quarter_of_ellipse(3.0, 2.0)).epsilon(1e-12));
  CHECK(curves[6].curve.length == Approx(2.0 * quarter_of_ellipse(4.0, 3.0)).epsilon(1e-12));
  CHECK(curves[7].curve.length == Approx(3.0 * kPi).epsilon(1e-14));
}

TEST_CASE("Normals stand on the curve, and a parallel curve lies at its distance (finite differences)",
          "[curve]") {
  constexpr double kStep = 1e-4;
  int checked = 0;
  for (const Named& each : all_curves())
    for (double at = 0.031; at < 1.0; at += 0.061) {
      if (std::abs(at - 0.5) < 2.0 * kStep) continue;
      INFO(each.name << " at " << at);
      const Point tangent =
          each.curve.point({at + kStep, 1.0}, 0.0) - each.curve.point({at - kStep, 1.0}, 0.0);
      CHECK(std::abs(tangent.normalized().dot(normal_at(each.curve, {at, 1.0}))) < 1e-6);
      CHECK(cross(tangent, normal_at(each.curve, {at, 1.0})) > 0.0);  // the outer side
      CHECK((each.curve.point({at, 1.0}, 0.7) - each.curve.point({at, 1.0}, 0.0)).norm() ==
            Approx(0.7).epsilon(1e-12));
      ++checked;
    }
  CHECK(checked > 100);
}

TEST_CASE("Mirror images of places are exact but for one rounding", "[curve]") {
  for (const Named& each : all_curves())
    for (int i = 0; i <= 17; ++i) {
      const Point left = each.curve.point({double(i), 17.0}, 0.4);
      const Point right = each.curve.point({double(17 - i), 17.0}, 0.4);
      INFO(each.name << " " << i);
      CHECK(std::abs(left.x() + right.x() - 2.0 * kMiddle.x()) < 4e-15 * 8.0);
      CHECK(left.y() == right.y());
    }
}

TEST_CASE("A three-centred arch has one tangent where its arcs meet, and springs upright", "[curve]") {
  const double haunch = roundest_haunch_radius(6.0, 2.0);
  const Curve curve = three_centred_arch(kMiddle, 6.0, 2.0, haunch);
  CHECK(normal_at(curve, {0.0, 1.0}).x() == Approx(-1.0).epsilon(1e-12));
  double sharpest = 1.0;
  for (int i = 0; i < 4000; ++i)
    sharpest =
        std::min(sharpest, normal_at(curve, {double(i), 4000.0}).dot(normal_at(curve, {i + 1.0, 4000.0})));
  CHECK(std::acos(sharpest) < 1.01 * curve.length / 4000.0 / haunch);  // the haunch bends most
  // No other haunch makes the two radii more alike.
  const auto ratio = [](double r) {
    const double out = 3.0 - r, above = 2.0 - r;
    return (2.0 + (out * out - above * above) / (2.0 * above)) / r;
  };
  CHECK(ratio(haunch) < ratio(1.001 * haunch));
  CHECK(ratio(haunch) < ratio(0.999 * haunch));
}

TEST_CASE("Which arcs meet in a point (closed form: the centre lies beyond the axis)", "[curve]") {
  CHECK(is_pointed(6.0, 4.0, pointed_radius(6.0, 4.0)));
  CHECK_FALSE(is_pointed(6.0, 3.0, pointed_radius(6.0, 3.0)));  // a semicircle
  CHECK_FALSE(is_pointed(6.0, 2.0, 3.25));                      // a segment of a circle
  CHECK(is_pointed(6.0, 2.0, 3.3));
  CHECK_FALSE(is_pointed(6.0, 2.0, 1.0));  // does not reach
}

TEST_CASE("A spline through points of a circle is that circle within its error (fourth order)", "[curve]") {
  std::vector<double> errors;
  for (const int count : {9, 17, 33}) {
    const Curve curve = spline_through(points_on_circle(count, 0.6));
    double error = 0.0;
    for (int i = 200; i <= 800; ++i)  // away from the ends, where a natural spline is straight
      error = std::max(
          error, std::abs((curve.point({double(i), 1000.0}, 0.0) - Point(kMiddle.x(), 0.0)).norm() - 5.0));
    errors.push_back(error);
  }
  // The straight ends are off by the sagitta of a piece, 0.014 m; a piece further in 0.27 times that.
  CHECK(errors[0] < 0.014 * std::pow(0.27, 1.6));
  CHECK(errors[1] < errors[0] / 8.0);
  CHECK(errors[2] < errors[1] / 8.0);
  const Curve fine = spline_through(points_on_circle(33, 0.6));
  CHECK(fine.length == Approx(2.0 * 5.0 * 0.6).epsilon(1e-5));
  CHECK((fine.point({0.0, 1.0}, 0.0) - points_on_circle(33, 0.6).front()).norm() < 1e-12);
  CHECK((fine.point({1.0, 1.0}, 0.0) - points_on_circle(33, 0.6).back()).norm() < 1e-12);
}

TEST_CASE("A spline through points of a straight line is that line", "[curve]") {
  const Curve line = spline_through({{0.0, 0.0}, {1.0, 0.5}, {4.0, 2.0}, {6.0, 3.0}});
  CHECK(line.length == Approx(std::hypot(6.0, 3.0)).epsilon(1e-14));
  CHECK((line.point({1.0, 3.0}, 0.0) - Point(2.0, 1.0)).norm() < 1e-12);
}
