#pragma once
/// @file What the text and the picture of a plan say in the same words.

#include <string>

#include "lookup/report/plan_report.h"

namespace voussoir {

/// "changes between two times at 12 points; standard deviations of 0.02 mm, of tilt 0.01 mm per m"
std::string planned_in_words(const SensorPlan& plan, const PlannedBridge& bridge);

/// Of the bridge: "uncertain as its file states, as are temperature and supports"
std::string conditions_in_words(const PlannedBridge& bridge);

/// Is the point one of those that the plan reads?
bool is_read(const SensorPlan& plan, const StoredPoint& point);

}  // namespace voussoir
