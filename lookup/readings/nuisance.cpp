#include "lookup/readings/nuisance.h"

#include <cmath>
#include <map>

namespace voussoir {
namespace {

/// The points with readings of each levelling.
std::map<int, std::vector<std::size_t>> points_by_levelling(const Comparison& comparison,
                                                            const Measurements& measured) {
  std::map<int, std::vector<std::size_t>> result;
  for (std::size_t i = 0; i < comparison.library.points.size(); ++i) {
    const int levelling = comparison.levelling.empty() ? 0 : comparison.levelling[i];
    if (levelling != kNoLevelling && !std::isnan(measured.displacement[i])) result[levelling].push_back(i);
  }
  return result;
}

}  // namespace

Eigen::MatrixXd levelling_columns(const Comparison& comparison, const Measurements& measured,
                                  const Nuisance& nuisance) {
  const auto points = static_cast<Eigen::Index>(comparison.library.points.size());
  Eigen::MatrixXd columns(points, 0);
  const auto add_column = [&](const std::vector<std::size_t>& places, const auto& value) {
    columns.conservativeResizeLike(Eigen::MatrixXd::Zero(points, columns.cols() + 1));
    for (const std::size_t i : places)
      columns(static_cast<Eigen::Index>(i), columns.cols() - 1) = value(comparison.library.points[i]);
  };
  const double times = std::sqrt(levellings(comparison.kind));
  for (const auto& [levelling, places] : points_by_levelling(comparison, measured)) {
    double mean_x = 0.0;
    for (const std::size_t i : places)
      mean_x += comparison.library.points[i].position.x() / static_cast<double>(places.size());
    if (nuisance.datum > 0.0) add_column(places, [&](const StoredPoint&) { return times * nuisance.datum; });
    if (nuisance.tilt > 0.0)
      add_column(places, [&, mean = mean_x](const StoredPoint& point) {
        return times * nuisance.tilt * (point.position.x() - mean);
      });
  }
  return columns;
}

}  // namespace voussoir
