#pragma once
/// @file Readings written as a file that read_readings takes.

#include <string>

#include "lookup/readings/measurements.h"
#include "lookup/readings/noise_model.h"
#include "lookup/readings/readings_file.h"

namespace voussoir {

/// Comma-separated, in millimetres (tilts: mm per m) with decimal points; silent sensors without a value. The
/// columns load and sigma_mm are there if some row has one. With as many decimals as the errors need that
/// were drawn, if they are given.
std::string to_csv(const ReadingsFile& file, const SensorList& list, const NoiseModel* drawn = nullptr);

/// Absolute readings at control points, without sigmas.
std::string to_csv(const Measurements& readings, const std::vector<StoredPoint>& points);

}  // namespace voussoir
