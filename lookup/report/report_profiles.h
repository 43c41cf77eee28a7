#pragma once
/// @file The report page's figures of readings from left to right.

#include <vector>

#include "lookup/report/drawing/page.h"
#include "lookup/report/pictured_answer.h"

namespace voussoir {

/// Readings, what the first candidate lets expect and the noise band about it: a figure for the heights on
/// top and on the arch under each load, and for each other quantity, as far as there are such sensors.
std::vector<Figure> profile_figures(const PicturedAnswer& report);

/// How far each reading is from the first candidate, in units of the noise; none without a noise model.
std::vector<Figure> residual_figures(const PicturedAnswer& report);

}  // namespace voussoir
