#pragma once
/// @file Databases of one bridge under different assumptions (supports, shape), asked about the same
/// readings: which may be weighed against each other, and how likely each one's assumptions are.

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/answer/verdict.h"
#include "lookup/readings/comparison.h"

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

/// What one of them says, if its assumptions hold.
struct AskedDatabase {
  std::string file, bridge, digest;
  Verdict verdict = Verdict::unexplained;
  std::string first{};        ///< its first candidate; empty: no scene is possible
  double intact = 0.0;        ///< probability that no block is missing
  double log_evidence = 0.0;  ///< Posterior::log_evidence
  double probability = 0.0;   ///< that its assumptions hold: see weigh
};

/// A database that is less likely than this does not contest what another one says.
inline constexpr double kCounting = 0.05;

/// Fills in the probabilities, if all assumptions are as likely beforehand and one of them holds; the
/// likeliest comes first. Precondition: the same readings with the same errors were asked about.
void weigh(std::vector<AskedDatabase>& databases);

/// Does a database that counts say anything else than the first: another verdict, or another scene where both
/// name one?
bool is_contested(std::span<const AskedDatabase> databases);

}  // namespace voussoir
