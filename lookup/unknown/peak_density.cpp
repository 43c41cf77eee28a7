#include "lookup/unknown/peak_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace voussoir {

using Eigen::Index;
using Eigen::MatrixXd;

ScatterLogs log_peak(const MatrixXd& noise, const MatrixXd& bridge) {
  const std::vector<double> none(static_cast<std::size_t>(noise.rows()), 0.0);
  return ScatterDensity()(none, lower_of(noise), lower_of(bridge));
}

ScatterLogs log_outside(const ScatterLogs& peaks, const MatrixXd& noise, const MatrixXd& bridge,
                        std::size_t directions) {
  const Index few = std::min(static_cast<Index>(directions), noise.rows());
  const ScatterLogs inside = log_peak(noise.topLeftCorner(few, few), bridge.topLeftCorner(few, few));
  const double powers = 0.5 * static_cast<double>(few) * std::log(2.0 * std::numbers::pi);
  ScatterLogs logs = peaks;
  for (std::size_t k = 0; k < logs.size(); ++k) logs[k] -= inside[k] + powers;
  return logs;
}

}  // namespace voussoir
