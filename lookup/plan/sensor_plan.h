#pragma once
/// @file From sensors to what they can show: the flow of plan-sensors.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "database/records/database.h"
#include "lookup/plan/detectability.h"

namespace voussoir {

struct PlanSettings {
  std::vector<std::string> points = {};   ///< of the database that may be read; empty: all
  double sigma = 0.0;                     ///< [m] standard deviation of the change at each of them
  std::map<Quantity, double> sigma_of{};  ///< [m, or of tilts rad] the same of sensors of a quantity
  std::optional<std::size_t>
      choose{};  ///< how many of them, with which most is seen (rows_that_help); nothing: all
  std::optional<std::string> history{};  ///< as in ComparisonSettings
  Conditions conditions = Conditions::uncertain;
  double datum = 0.0;  ///< [m] Nuisance
};

struct SensorPlan {
  std::string history;                ///< that changes are compared with
  std::vector<std::string> points;    ///< that are read
  std::vector<std::string> chosen{};  ///< the same, those first that help most; empty: none was chosen
  std::vector<Sight> sights;          ///< of the blocks without which the bridge stands, or may
  std::vector<BlockId> may_fall{};    ///< those of them without which only some bridges stand
  std::vector<BlockId> falls{};       ///< blocks whose loss lets something fall: nobody needs to measure
  std::vector<BlockId> unknown{};     ///< whose loss has no answer, or stands without sensitivities
  const std::string& point_of(const Sight& sight) const {  ///< with the largest change
    return points[static_cast<std::size_t>(sight.largest_at)];
  }
};

/// A loss is seen, a block named, if the chance is at least this.
inline constexpr double kSure = 0.9;

/// What changes between two levellings would show of a bridge that is as uncertain as its file states.
/// Throws InputError for points and histories that the database does not have, Failure for one that does not
/// know what is uncertain, or has no singles.
SensorPlan plan_sensors(const Database& database, const PlanSettings& settings);

}  // namespace voussoir
