#pragma once
/// @file The pictures of the report page.

#include <vector>

#include "lookup/lookup.h"
#include "lookup/report/drawing/page.h"

namespace voussoir {

/// What the pictures show. Precondition: the answer has a candidate.
struct ReportPictures {
  const Answer& answer;
  const Library& library;
  const Measurements& measurements;
};

/// The bridge: blocks coloured by the probability that they are missing, the first candidate's blocks
/// outlined, readings hanging from their control points.
Drawing draw_bridge(const ReportPictures& report);

/// The same with its caption and table.
Figure bridge_figure(const ReportPictures& report);

/// Readings, the first candidate's displacements and the noise band about them: on top and on the arch, as
/// far as the bridge has such points.
std::vector<Figure> profile_figures(const ReportPictures& report);

/// How far each reading is from the first candidate, in units of the noise; none without a noise model.
std::vector<Figure> residual_figures(const ReportPictures& report);

}  // namespace voussoir
