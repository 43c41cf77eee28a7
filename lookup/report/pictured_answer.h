#pragma once
/// @file An answer as the report page's pictures show it, sensor by sensor.

#include <string>
#include <string_view>
#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/readings/shown_readings.h"

namespace voussoir {

/// Precondition: the answer has a candidate.
struct PicturedAnswer {
  PicturedAnswer(const Answer& of, const Comparison& with);

  const Answer& answer;
  const Comparison& comparison;
  const Library& library;
  ShownReadings shown;                          ///< beside the first candidate as the bridge file states it
  std::vector<double> expected;                 ///< expected_readings
  std::vector<const SensorResidual*> residual;  ///< by point; null: see residual_of
  std::vector<OpenLoss> open_losses;            ///< as the verdict has them
  int decimals = 3;  ///< of readings in millimetres: more where errors are smaller than a micrometre
};

/// Where a sensor is: on a block of the arch; on top: one of heights on the upper face of a block of the
/// highest course, within kPointTolerance; or elsewhere, as in the middle of such a block.
enum class Site { arch, top, elsewhere };
Site site_of(const PicturedAnswer& report, std::size_t point);

/// Against what the answer lets expect; nothing where there is no reading, and without a noise model.
const SensorResidual* residual_of(const PicturedAnswer& report, std::size_t point);

/// Whether the reading is told to be far outside what the others show.
bool disagrees(const PicturedAnswer& report, std::size_t point);

/// "change" of readings that are changes, else "reading".
std::string_view reading_word(const PicturedAnswer& report);

/// Name, reading and what the answer lets expect, for pointing at it.
std::string point_tip(const PicturedAnswer& report, std::size_t point);

}  // namespace voussoir
