#include "core/structure/uneven_stiffness.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace voussoir {

double UnevenStiffness::correlation(std::size_t one, std::size_t other) const {
  return std::exp(-(places[one] - places[other]).norm() / length);
}

Eigen::VectorXd UnevenStiffness::correlations(std::size_t one) const {
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(joints.size()), [&](Eigen::Index other) {
    return correlation(one, static_cast<std::size_t>(other));
  });
}

UnevenStiffness uneven_stiffness(const Structure& structure, const Uncertainty& uncertainty) {
  UnevenStiffness uneven{own_stiffness(structure, uncertainty.epoch_unevenness), {}, 1.0};
  for (const UncertainAction& pair : uneven.joints)
    uneven.places.push_back(middle_of(structure.joints[pair.joints.front()], structure.mesh));
  const auto x = structure.mesh.nodes.row(0);
  uneven.length = kAlikeShare * (x.maxCoeff() - x.minCoeff());
  return uneven;
}

Eigen::ArrayXd sampled_shares(const Structure& structure, const UnevenStiffness& uneven, std::uint64_t seed) {
  const auto pairs = static_cast<Eigen::Index>(uneven.joints.size());
  Eigen::MatrixXd correlations(pairs, pairs);
  for (Eigen::Index i = 0; i < pairs; ++i)
    correlations.col(i) = uneven.correlations(static_cast<std::size_t>(i));
  const Eigen::VectorXd theta = correlations.llt().matrixL() * sampled_theta(uneven.joints.size(), seed);
  Eigen::ArrayXd shares = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(structure.joints.size()));
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const UncertainAction& pair = uneven.joints[static_cast<std::size_t>(i)];
    for (const std::size_t joint : pair.joints)
      shares[static_cast<Eigen::Index>(joint)] = std::exp(pair.parameter.sigma * theta[i]);
  }
  return shares;
}

}  // namespace voussoir
