#pragma once
/// @file The report page's figures of readings from left to right.

#include <vector>

#include "lookup/report/drawing/page.h"
#include "lookup/report/pictured_answer.h"

namespace voussoir {

/// Readings, what the answer lets expect and the band about it (expected_readings.h): a figure for the
/// heights on top and on the arch under each load, and for each other quantity, as far as there are such
/// sensors.
std::vector<Figure> profile_figures(const PicturedAnswer& report);

/// How far each reading is from that, in what residuals are divided by; none without a noise model.
std::vector<Figure> residual_figures(const PicturedAnswer& report);

}  // namespace voussoir
