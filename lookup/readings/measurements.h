#pragma once
/// @file What was measured: vertical displacements at some of the control points.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

/// Readings in the order of the database's control points.
struct Measurements {
  std::vector<double> displacement;  ///< [m] up is positive; NaN where there is no reading
  std::vector<double> sigma;         ///< [m] the sensor's own standard deviation; NaN where none is stated
  std::vector<bool> silent;          ///< there is a sensor, but it gave no reading

  std::size_t count() const;  ///< readings
};

/// Displacements [m] as readings of sensors at all points, those that are NaN being silent.
Measurements as_measurements(std::span<const double> displacements);

/// Coordinates in a measurements file may be off by this much [m] from the control point that they mean.
inline constexpr double kPointTolerance = 0.05;

/// Larger displacements [m] are taken for a mistake in the units.
inline constexpr double kLargestDisplacement = 100.0;

/// Reads a measurements file (CSV with a header; '#' starts a comment; UTF-8, LF or CRLF):
/// `point` or the pair `x_m,y_m`; one of `uy_mm`, `uy_m` (up is positive), `settlement_mm` (down is
/// positive); optionally `sigma_mm`. An empty value or NaN is a sensor without a reading. Where two control
/// points share a place (neighbouring blocks' corners), the first row with its coordinates is the left
/// block's, the second the right block's. The path "-" is the standard input. Throws InputError "file:line:
/// ..." for anything else, and for a file without any reading.
Measurements read_measurements(const std::filesystem::path& path, const std::vector<StoredPoint>& points);

/// The same for a text in memory (`name` is used in messages).
Measurements parse_measurements(std::string_view text, const std::string& name,
                                const std::vector<StoredPoint>& points);

}  // namespace voussoir
