#include "lookup/readings/readings_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "lookup/readings/csv_text.h"

namespace voussoir {
namespace {

/// To a tenth of a micrometre, and changes, which are smaller, to a nanometre.
std::string in_millimetres(double metres, ReadingKind kind) {
  if (std::isnan(metres)) return "";
  return fmt::format("{:.{}f}", kMillimetres * metres, kind == ReadingKind::absolute ? 4 : 6);
}

std::string value_columns(const ReadingsFile& file, const SensorList& list) {
  if (file.two_epochs) return "before_mm,after_mm";
  if (is_change(file.kind)) return "change_mm";
  const bool heights = std::all_of(file.readings.begin(), file.readings.end(), [&](const Reading& reading) {
    return list.sensors[reading.sensor].quantity == Quantity::uy;
  });
  return heights ? "uy_mm" : "value_mm";
}

}  // namespace

std::string to_csv(const ReadingsFile& file, const SensorList& list) {
  const auto has_sigma = [](const Reading& reading) { return !std::isnan(reading.sigma); };
  const bool sigmas = std::any_of(file.readings.begin(), file.readings.end(), has_sigma);
  const bool loads = is_loaded(file.kind);
  std::string text = fmt::format("point,{}{}{}\n", loads ? "load," : "", value_columns(file, list),
                                 sigmas ? ",sigma_mm" : "");
  for (const Reading& reading : file.readings) {
    text += csv_field(list.sensors[reading.sensor].name) + ",";
    if (loads) text += csv_field(reading.load) + ",";
    if (file.two_epochs)
      text += in_millimetres(reading.before, file.kind) + "," + in_millimetres(reading.after, file.kind);
    else
      text += in_millimetres(reading.value, file.kind);
    if (sigmas) text += "," + (has_sigma(reading) ? fmt::format("{:g}", kMillimetres * reading.sigma) : "");
    text += "\n";
  }
  return text;
}

std::string to_csv(const Measurements& readings, const std::vector<StoredPoint>& points) {
  ReadingsFile file{"", ReadingKind::absolute, false, {}};
  const double none = std::nan("");
  for (std::size_t i = 0; i < points.size(); ++i)
    file.readings.push_back(
        {.sensor = i, .value = readings.displacement[i], .before = none, .after = none, .sigma = none});
  return to_csv(file, control_point_sensors(points));
}

}  // namespace voussoir
