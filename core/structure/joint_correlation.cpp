#include "core/structure/joint_correlation.h"

#include <cmath>

namespace voussoir {

Eigen::MatrixXd joint_correlations(const Structure& structure, const std::vector<std::size_t>& joints) {
  const auto x = structure.mesh.nodes.row(0);
  const double length = kAlikeShare * (x.maxCoeff() - x.minCoeff());
  std::vector<Point> places;
  for (const std::size_t joint : joints) places.push_back(middle_of(structure.joints[joint], structure.mesh));
  const auto count = static_cast<Eigen::Index>(joints.size());
  return Eigen::MatrixXd::NullaryExpr(count, count, [&](Eigen::Index one, Eigen::Index other) {
    const Point way = places[static_cast<std::size_t>(one)] - places[static_cast<std::size_t>(other)];
    return std::exp(-way.norm() / length);
  });
}

}  // namespace voussoir
