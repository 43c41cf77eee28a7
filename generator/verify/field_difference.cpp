#include "generator/verify/field_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0.0;
  const double apart = std::abs(a - b);
  return std::isnan(apart) ? std::numeric_limits<double>::infinity() : apart;
}

}  // namespace

double largest_difference(const Eigen::Ref<const Eigen::VectorXd>& first,
                          const Eigen::Ref<const Eigen::VectorXd>& second) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < first.size(); ++i)
    largest = std::max(largest, difference(first[i], second[i]));
  return largest;
}

}  // namespace voussoir
