#include "core/structure/uneven_stiffness.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/structure/joint_correlation.h"

namespace voussoir {

UnevenStiffness uneven_stiffness(const Structure& structure, const Uncertainty& uncertainty) {
  UnevenStiffness uneven{own_stiffness(structure, log_deviation(uncertainty.epoch_unevenness)), {}};
  uneven.correlations = joint_correlations(structure, first_joints(uneven.joints));
  return uneven;
}

Eigen::ArrayXd sampled_shares(const Structure& structure, const UnevenStiffness& uneven, std::uint64_t seed) {
  const auto pairs = static_cast<Eigen::Index>(uneven.joints.size());
  const Eigen::VectorXd theta =
      uneven.correlations.llt().matrixL() * sampled_theta(uneven.joints.size(), seed);
  Eigen::ArrayXd shares = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(structure.joints.size()));
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const UncertainAction& pair = uneven.joints[static_cast<std::size_t>(i)];
    for (const std::size_t joint : pair.joints)
      shares[static_cast<Eigen::Index>(joint)] = std::exp(pair.parameter.sigma * theta[i]);
  }
  return shares;
}

}  // namespace voussoir
