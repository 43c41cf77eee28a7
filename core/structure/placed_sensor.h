#pragma once
/// @file From what a file says of a sensor to the nodes that it reads.

#include <vector>

#include "core/structure/reading_weights.h"
#include "core/structure/sensor_description.h"

namespace voussoir {

/// Places are given to the millimetre: as near [m] to a block they belong to it, and to both of two blocks.
inline constexpr double kPlaceTolerance = 1e-3;

/// A sensor on the bridge.
struct PlacedSensor {
  Point position;               ///< [m]; of a distance the middle, of a tilt that of the block
  std::vector<BlockId> blocks;  ///< one or, of a distance, two: without one of them the sensor shows nothing
  std::vector<NodeWeight> weights;  ///< of what it reads
};

/// Throws InputError (the message without the sensor's name) for a place outside the bridge or where blocks
/// meet and none is named, a distance between places that are one, blocks that do not exist or are not
/// there, and for places that are missing or that the quantity does not have.
PlacedSensor place_sensor(const SensorDescription& description, const BlockLayout& layout, const Mesh& mesh);

}  // namespace voussoir
