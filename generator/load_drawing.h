#pragma once
/// @file Load cases in the picture of a bridge file.

#include <string>

#include "core/structure/bridge_description.h"
#include "core/structure/model.h"

namespace voussoir {

inline constexpr double kLoadRow = 30.0;  ///< [px] above the bridge, of each load case

/// Where the picture has the bridge.
struct LoadFrame {
  double origin = 0.0;  ///< [px] of x = 0
  double scale = 1.0;   ///< [px/m]
  double low = 0.0;     ///< [m] the bridge's ends
  double high = 0.0;
  double width = 0.0;  ///< [px] of the picture
  double top = 0.0;    ///< [px] of the bridge

  double operator()(double x) const { return origin + scale * x; }
};

/// <text>, of this class of the picture's style [px].
std::string text_at(const Point& at, const char* css_class, const std::string& text);

/// A row above the bridge for each load case: an arrow with its force for each axle and point, a bar along
/// each line, and what acts in all: on its width out of plane, and on the model's thickness.
std::string load_elements(const Model& bridge, const BridgeDescription& description, const LoadFrame& across);

}  // namespace voussoir
