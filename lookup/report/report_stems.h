#pragma once
/// @file Readings in the picture of the bridge: lines that hang from the sensors, and their scale.

#include <string>

#include "lookup/report/drawing/bridge_drawing.h"
#include "lookup/report/pictured_answer.h"

namespace voussoir {

/// Room that the readings need above the bridge [units]: for names, and for the top's, which hang from a line
/// above it.
double room_for_stems(const PicturedAnswer& report);

/// All sensors at their places, those of one place side by side, hollow without a reading; heights as lines
/// (under several loads of the first), the largest ones and all that disagree with their names.
std::string stem_elements(const PicturedAnswer& report, const BridgeFrame& frame);

/// How long a line is for a reading, its upper end at `at`; nothing if there are no lines.
std::string stem_scale(const PicturedAnswer& report, const Point& at);

/// Lines that would be far longer than most are cut, and are arrows.
bool cuts_stems(const PicturedAnswer& report);

/// Whether the picture shows any reading as a line, one that hangs from above the bridge, a sensor without
/// reading, or one that disagrees.
struct ShownStems {
  bool lines = false, lifted = false, silent = false, odd = false;
};
ShownStems shown_stems(const PicturedAnswer& report);

}  // namespace voussoir
