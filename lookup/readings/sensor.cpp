#include "lookup/readings/sensor.h"

namespace voussoir {

std::string_view unit_of(Quantity quantity) {
  return quantity == Quantity::tilt ? "mm per m" : "mm";
}

SensorList control_point_sensors(const std::vector<StoredPoint>& points) {
  SensorList list{{}, points.size()};
  for (const StoredPoint& point : points) {
    Sensor& sensor =
        list.sensors.emplace_back(point.name, point.quantity, point.position, std::vector{point.block});
    if (point.other_block) sensor.blocks.push_back(*point.other_block);
  }
  return list;
}

}  // namespace voussoir
