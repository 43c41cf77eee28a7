#include "core/structure/correlation_by_distance.h"

#include <cmath>

namespace voussoir {

Eigen::MatrixXd correlations_by_distance(const Structure& structure, const std::vector<Point>& places) {
  const auto x = structure.mesh.nodes.row(0);
  const double length = kAlikeShare * (x.maxCoeff() - x.minCoeff());
  const auto count = static_cast<Eigen::Index>(places.size());
  return Eigen::MatrixXd::NullaryExpr(count, count, [&](Eigen::Index one, Eigen::Index other) {
    const Point way = places[static_cast<std::size_t>(one)] - places[static_cast<std::size_t>(other)];
    return std::exp(-way.norm() / length);
  });
}

}  // namespace voussoir
