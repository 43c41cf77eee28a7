#include "lookup/readings/readings_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "lookup/readings/csv_text.h"
#include "lookup/readings/noise_scale.h"

namespace voussoir {
namespace {

/// To a tenth of a micrometre, and changes, which are smaller, to a nanometre; more finely where the errors
/// that were drawn are small: rounding shall be no error beside them, nor take bounded ones over their bound.
int decimals_of(double metres, ReadingKind kind, const NoiseModel* drawn) {
  constexpr double kDigitsOfError = 4.0;
  constexpr int kMost = 12;
  const int usual = kind == ReadingKind::absolute ? 4 : 6;
  if (drawn == nullptr || std::isnan(metres)) return usual;
  const double error =
      kMillimetres * noise_scale(drawn->relative.value_or(0.0), drawn->floor, std::abs(metres));
  const double needed = std::ceil(kDigitsOfError - std::log10(error));  // infinite without errors
  return static_cast<int>(std::clamp<double>(needed, usual, kMost));
}

std::string in_millimetres(double metres, int decimals) {
  return std::isnan(metres) ? "" : fmt::format("{:.{}f}", kMillimetres * metres, decimals);
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

std::string to_csv(const ReadingsFile& file, const SensorList& list, const NoiseModel* drawn) {
  const auto has_sigma = [](const Reading& reading) { return !std::isnan(reading.sigma); };
  const bool sigmas = std::any_of(file.readings.begin(), file.readings.end(), has_sigma);
  const bool loads = is_loaded(file.kind);
  std::string text = fmt::format("point,{}{}{}\n", loads ? "load," : "", value_columns(file, list),
                                 sigmas ? ",sigma_mm" : "");
  for (const Reading& reading : file.readings) {
    text += csv_field(list.sensors[reading.sensor].name) + ",";
    if (loads) text += csv_field(reading.load) + ",";
    const int decimals = decimals_of(reading.value, file.kind, drawn);
    if (file.two_epochs)
      text += in_millimetres(reading.before, decimals) + "," + in_millimetres(reading.after, decimals);
    else
      text += in_millimetres(reading.value, decimals);
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
