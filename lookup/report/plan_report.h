#pragma once
/// @file What sensors can show, as text, tables and a picture.

#include <string>

#include "lookup/plan/sensor_plan.h"
#include "lookup/report/report.h"

namespace voussoir {

/// What a plan is of.
struct PlannedBridge {
  const Database& database;
  const PlanSettings& settings;
};

/// For people; a list of all blocks as JSON or CSV: block, falls, seen, named, largest change [m],
/// where, sensors that fall silent, the block whose loss
/// looks most alike. JSON also has points and counts.
std::string plan_report(const SensorPlan& plan, const PlannedBridge& bridge, ReportFormat format);

/// The bridge, each block coloured by the chance that its loss is seen, and the sensors, with their names as
/// far as these have room (SVG file).
std::string plan_picture(const SensorPlan& plan, const PlannedBridge& bridge);

}  // namespace voussoir
