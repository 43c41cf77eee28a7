#pragma once
/// @file The report page's picture of the bridge.

#include "lookup/report/drawing/page.h"
#include "lookup/report/pictured_answer.h"

namespace voussoir {

/// The bridge: blocks coloured by the probability that they are missing, the first candidate's blocks
/// outlined, readings hanging from their places: of heights, and where there are several loads of the first.
Drawing draw_bridge(const PicturedAnswer& report);

/// The same with its caption and table.
Figure bridge_figure(const PicturedAnswer& report);

}  // namespace voussoir
