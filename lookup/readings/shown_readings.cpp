#include "lookup/readings/shown_readings.h"

#include <span>

namespace voussoir {

ShownReadings shown_readings(const Comparison& comparison, std::size_t row) {
  const std::vector<double> origin = origin_of(comparison);
  const std::span<const double> prediction = comparison.library.table.row(row);
  ShownReadings shown{comparison.measured.displacement, {prediction.begin(), prediction.end()}};
  for (std::size_t i = 0; i < origin.size(); ++i) {
    shown.reading[i] -= origin[i];
    shown.expected[i] -= origin[i];
  }
  return shown;
}

}  // namespace voussoir
