#pragma once
/// @file Files of readings.
///
/// A CSV table (csv_text.h, decimal_mark.h). A column `point`, naming control points and sensors, or the pair
/// `x_m,y_m` of control points; beside a name it is checked. One value: `uy_mm` (up is positive),
/// `settlement_mm` (down is positive), `value_mm` (whatever the sensor reads), `change_mm` (second epoch
/// minus first), or the pair `before_mm,after_mm`, which may be heights above any datum. `_m` in the place of
/// `_mm` is metres; a column `remark` is not read. Tilts are in mm per m in all columns of mm. Optionally
/// `sigma_mm`, the standard deviation of the row's value (of the change, where it is one), `load`, the load
/// case under which the reading was taken: the value is then what the load adds, and `levelling`, a name of
/// what was levelled at once: heights of one share its datum and tilt. There are at most 50.
///
/// An empty value or NaN is a sensor that gave no reading. Of two epochs: a sensor that fell silent after the
/// first; without a reading in the first it is as if there were no sensor, since it does not tell what the
/// bridge did in between.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lookup/readings/reading_kind.h"
#include "lookup/readings/sensor.h"

namespace voussoir {

/// A row. Displacements in metres, tilts in radians; NaN where the file says nothing.
struct Reading {
  long line = 0;
  std::size_t sensor = 0;   ///< number in the list of sensors
  std::string load{};       ///< none: the bridge's own weight alone
  std::string levelling{};  ///< none: of the one without a name
  double value = 0.0;       ///< of two epochs the change
  double before = 0.0;      ///< of two epochs
  double after = 0.0;
  double sigma = 0.0;
  bool silent = false;  ///< there is a sensor, but it gave no reading
};

struct ReadingsFile {
  std::string name;
  ReadingKind kind = ReadingKind::absolute;
  bool two_epochs = false;  ///< readings have `before` and `after`
  std::vector<Reading> readings;
};

/// Coordinates of a control point may be off by this much [m].
inline constexpr double kPointTolerance = 0.05;

/// Larger displacements [m] are taken for a mistake in the units, and so are larger heights, as values before
/// and after may be.
inline constexpr double kLargestDisplacement = 100.0, kLargestHeight = 1e4;

/// Reads a text (`name` is used in messages). Where two control points share a place (neighbouring blocks'
/// corners), the first row with its coordinates is the left block's, the second the right block's. Throws
/// InputError "file:line: ..." for anything else than the above, for a sensor that comes twice under the same
/// load, and for a file without any reading.
ReadingsFile parse_readings(std::string_view text, const std::string& name, const SensorList& list);

/// A file's text and what messages call it.
struct ReadingsText {
  std::string text, name;
};

/// Of a file; the path "-" is the standard input. Throws InputError naming it.
ReadingsText read_readings(const std::filesystem::path& path);

}  // namespace voussoir
