#pragma once
/// @file The report page's picture of the bridge.

#include "lookup/report/drawing/page.h"
#include "lookup/report/report_points.h"

namespace voussoir {

/// The bridge: blocks coloured by the probability that they are missing, the first candidate's blocks
/// outlined, readings hanging from their places: of heights, and where there are several loads of the first.
Drawing draw_bridge(const ReportPictures& report);

/// The same with its caption and table.
Figure bridge_figure(const ReportPictures& report);

}  // namespace voussoir
