/// @file Parameters in standard deviations. Oracle: parameters_at, which makes parameters of them.

#include "lookup/readings/standardised_parameters.h"

#include <catch2/catch.hpp>

#include "tests/lookup/readings/sampled_site.h"

using namespace voussoir;
using namespace voussoir::test;
using Eigen::VectorXd;

namespace {

bool are_close(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > 1e-12 * std::abs(b[i])) return false;
  return !a.empty();
}

}  // namespace

TEST_CASE("Standardised parameters are those that give the variant's, whatever is uncertain") {
  Uncertainty all = small_bridge_file().description.uncertainty, only_own = all, only_common = all;
  only_own.common_stiffness = 0.0;
  only_common.joint_stiffness = 0.0;
  const Model& bridge = stored_bridge();
  for (const Uncertainty& uncertainty : {all, only_own, only_common}) {
    const UncertainParameters uncertain = uncertain_parameters(bridge, uncertainty);
    const VectorXd drawn = sampled_theta(uncertain.of_bridge.size(), 5);
    const VariantParameters variant = variant_parameters(parameters_at(bridge, uncertain, drawn));
    const VectorXd found = standardised_parameters(uncertain, variant_parameters(bridge.parameters), variant);
    const VariantParameters again = variant_parameters(parameters_at(bridge, uncertain, found));
    CHECK(are_close(again.normal_stiffness, variant.normal_stiffness));
    CHECK(are_close(again.tangential_stiffness, variant.tangential_stiffness));
    CHECK(are_close(again.friction_coefficient, variant.friction_coefficient));
    CHECK(are_close(again.young_modulus, variant.young_modulus));
    CHECK(are_close(again.density, variant.density));
  }
}

TEST_CASE("The common stiffness takes what joints' own factors have in common") {
  const UncertainParameters& uncertain = uncertain_of_stored_bridge();
  VectorXd theta = VectorXd::Zero(static_cast<Eigen::Index>(uncertain.of_bridge.size()));
  theta[0] = 1.25;
  const VectorXd found =
      standardised_parameters(uncertain, variant_parameters(stored_bridge().parameters),
                              variant_parameters(parameters_at(stored_bridge(), uncertain, theta)));
  CHECK(found.isApprox(theta, 1e-9));
}
