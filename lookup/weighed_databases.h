#pragma once
/// @file Which databases may be weighed against each other: those that say something of the same readings, of
/// one bridge.

#include <map>
#include <set>
#include <span>
#include <string>

#include "lookup/lookup.h"

namespace voussoir {

/// What a sensor reads where.
struct ReadPlace {
  Point position;  ///< [m]
  Quantity quantity;
};

/// What one database makes of a file of readings.
struct DatabaseReadings {
  std::string file;                          ///< of the database
  double width = 0.0;                        ///< [m] from its first control point to its last
  std::map<std::string, ReadPlace> sensors;  ///< that the readings are of
  std::set<std::string> counted;             ///< of these, whose readings count
};

DatabaseReadings database_readings(const std::string& file, const std::vector<StoredPoint>& control_points,
                                   const Comparison& comparison, const Answer& answer);

/// Sensors of one name are at one place of one bridge if they are at most half a metre apart, of short
/// bridges a share of their width: what is built otherwise than drawn (a thinner ring, longer blocks) moves
/// them less.
inline constexpr double kMostApart = 0.5, kMostApartOfWidth = 0.05;

/// Throws InputError naming a sensor, both databases and both places or quantities unless all are of one
/// bridge.
void require_one_bridge(std::span<const DatabaseReadings> all);

/// What one database leaves out speaks for it. Throws InputError naming a reading that counts in one and not
/// in another.
void require_same_readings(std::span<const DatabaseReadings> all);

}  // namespace voussoir
