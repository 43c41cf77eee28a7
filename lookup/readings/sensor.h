#pragma once
/// @file Sensors that readings may name: those of the database, and others that its fields show.

#include <string>
#include <string_view>
#include <vector>

#include "core/structure/reading_weights.h"
#include "database/records/database.h"

namespace voussoir {

struct Sensor {
  std::string name;
  Quantity quantity = Quantity::uy;
  Point position;                     ///< [m]; of a distance the middle
  std::vector<BlockId> blocks;        ///< without one of them the sensor shows nothing
  std::vector<NodeWeight> weights{};  ///< none for those of the database: it has what they show
};

/// As files and answers have readings: "mm", or "mm per m" of tilts.
std::string_view unit_of(Quantity quantity);

/// Sensors that readings may name.
struct SensorList {
  std::vector<Sensor> sensors;     ///< those of the database first
  std::size_t control_points = 0;  ///< how many of them are the database's: its control points and sensors
};

/// The database's points as sensors, in their order.
SensorList control_point_sensors(const std::vector<StoredPoint>& points);

}  // namespace voussoir
