#include "core/geometry/spline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <memory>

namespace voussoir {
namespace {

/// One piece between two points; t in [0, chord].
struct Piece {
  std::array<Point, 4> coefficients;  ///< of t^0 to t^3
  double chord = 0.0;                 ///< [m]
  double before = 0.0;                ///< length of the curve up to this piece [m]

  Point at(double t) const {
    const auto& [a, b, c, d] = coefficients;
    return a + t * (b + t * (c + t * d));
  }
  Point slope(double t) const {
    const auto& [a, b, c, d] = coefficients;
    return b + t * (2.0 * c + 3.0 * t * d);
  }
  /// Length from the piece's beginning to t [m], by Gauss's rule with five points on eight parts: exact to
  /// round-off for curves that bend as arches do.
  double length_to(double t) const {
    static constexpr std::array<double, 3> kPlaces = {0.0, 0.5384693101056831, 0.9061798459386640};
    static constexpr std::array<double, 3> kWeights = {0.5688888888888889, 0.4786286704993665,
                                                       0.2369268850561891};
    constexpr int kParts = 8;
    const double half = 0.5 * t / kParts;
    double sum = 0.0;
    for (int part = 0; part < kParts; ++part) {
      const double middle = (2 * part + 1) * half;
      sum += kWeights[0] * slope(middle).norm();
      for (std::size_t i = 1; i < 3; ++i)
        sum += kWeights[i] *
               (slope(middle - half * kPlaces[i]).norm() + slope(middle + half * kPlaces[i]).norm());
    }
    return half * sum;
  }
  double parameter_at(double length) const {
    double low = 0.0, high = chord;
    for (double middle = 0.5 * high; low < middle && middle < high; middle = 0.5 * (low + high))
      (length_to(middle) < length ? low : high) = middle;
    return high;
  }
};

/// Second derivatives at the points, zero at both ends (tridiagonal equations, solved by elimination).
std::vector<Point> second_derivatives(const std::vector<Point>& points, const std::vector<double>& chords) {
  const std::size_t n = points.size();
  std::vector<double> diagonal(n, 1.0);
  std::vector<Point> right(n, Point::Zero());
  std::vector<double> above(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = chords[i - 1], after = chords[i];
    const double factor = i > 1 ? before / diagonal[i - 1] : 0.0;
    diagonal[i] = 2.0 * (before + after) - factor * above[i - 1];
    above[i] = after;
    right[i] = 6.0 * ((points[i + 1] - points[i]) / after - (points[i] - points[i - 1]) / before) -
               factor * right[i - 1];
  }
  std::vector<Point> result(n, Point::Zero());
  for (std::size_t i = n - 1; i-- > 1;) result[i] = (right[i] - above[i] * result[i + 1]) / diagonal[i];
  return result;
}

std::vector<Piece> pieces_through(const std::vector<Point>& points) {
  std::vector<double> chords;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) chords.push_back((points[i + 1] - points[i]).norm());
  const std::vector<Point> bend = second_derivatives(points, chords);
  std::vector<Piece> pieces;
  double length = 0.0;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const double h = chords[i];
    const Point slope = (points[i + 1] - points[i]) / h - h / 6.0 * (2.0 * bend[i] + bend[i + 1]);
    pieces.push_back(
        {{points[i], slope, 0.5 * bend[i], (bend[i + 1] - bend[i]) / (6.0 * h)}, chords[i], length});
    length += pieces.back().length_to(h);
  }
  return pieces;
}

}  // namespace

Curve spline_through(const std::vector<Point>& points) {
  const auto pieces = std::make_shared<const std::vector<Piece>>(pieces_through(points));
  const double whole = pieces->back().before + pieces->back().length_to(pieces->back().chord);
  Curve curve{.length = whole, .point = {}, .has_corner = false};
  curve.point = [pieces, whole](const CurvePlace& place, double offset) -> Point {
    const double length = whole * place.part / place.parts;
    const auto after = std::upper_bound(pieces->begin() + 1, pieces->end(), length,
                                        [](double l, const Piece& piece) { return l < piece.before; });
    const Piece& piece = *std::prev(after);
    const double t = place.part == place.parts ? piece.chord : piece.parameter_at(length - piece.before);
    const Point along = piece.slope(t).normalized();
    return piece.at(t) + offset * Point(-along.y(), along.x());
  };
  return curve;
}

}  // namespace voussoir
