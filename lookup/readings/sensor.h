#pragma once
/// @file Sensors: what is read where. Every reading is a weighted sum of the displacements of the nodes about
/// the sensor, so that a new sensor needs no new solution.

#include <string>
#include <vector>

#include "database/records/database.h"

namespace voussoir {

enum class Quantity {
  ux,       ///< displacement to the right [m]
  uy,       ///< displacement up [m]
  tilt,     ///< rotation of a block [rad], counter-clockwise
  distance  ///< how much longer the way between two places becomes [m]
};

/// A displacement of this node counts this much in each direction.
struct NodeWeight {
  NodeId node;
  Point weight;
};

struct Sensor {
  std::string name;
  Quantity quantity = Quantity::uy;
  Point position;                     ///< [m]; of a distance the middle
  std::vector<BlockId> blocks;        ///< without one of them the sensor shows nothing
  std::vector<NodeWeight> weights{};  ///< none for control points: the database has their displacements
};

/// Sensors that readings may name.
struct SensorList {
  std::vector<Sensor> sensors;     ///< control points first
  std::size_t control_points = 0;  ///< how many of them are control points
};

/// The control points as sensors, in their order.
SensorList control_point_sensors(const std::vector<StoredPoint>& points);

/// A place of the bridge and the block that it belongs to.
struct Place {
  Point position;  ///< [m]
  BlockId block;
};

/// Weights by which the displacement of a place in a direction follows from the nodes of the triangle about
/// it (linear shape functions).
std::vector<NodeWeight> displacement_weights(const Place& place, const Point& direction, const Mesh& mesh);

/// Rotation of a block: least squares over its nodes, all counting the same.
std::vector<NodeWeight> rotation_weights(BlockId block, const Mesh& mesh);

/// Change of the distance of two places, first order. Precondition: they are not one place.
std::vector<NodeWeight> distance_weights(const Place& from, const Place& to, const Mesh& mesh);

/// What the sensor shows [m or rad]; NaN if one of its nodes has no displacement.
double reading_of(const Sensor& sensor, const Field& field);

}  // namespace voussoir
