#include "core/statics/stresses.h"

#include <algorithm>
#include <cmath>

#include "core/statics/elements.h"

namespace voussoir {
namespace {

double tresca_of(const TriangleStress& stress) {
  const double mean = 0.5 * (stress.xx + stress.yy);
  const double radius = std::hypot(0.5 * (stress.xx - stress.yy), stress.xy);
  return std::max(mean + radius, stress.zz) - std::min(mean - radius, stress.zz);
}

}  // namespace

std::vector<TriangleStress> triangle_stresses(const StageEquations& equations, const Parameters& parameters,
                                              const Field& displacement) {
  const EquilibriumSystem& system = *equations.system;
  std::vector<TriangleStress> stresses(system.triangles.size());
  for_present_triangles(equations, [&](std::size_t t, std::size_t block) {
    const Eigen::Vector3d cauchy =
        cauchy_stress(system.triangles[t], equations.coefficients->moduli[block],
                      gathered(displacement, system.structure->mesh.triangles[t].nodes));
    const Material& material = parameters.blocks[block];
    TriangleStress& stress = stresses[t];
    stress = {cauchy[0], cauchy[1], cauchy[2], 0.0, 0.0};
    if (material.plane == PlaneState::strain) stress.zz = material.poisson_ratio * (stress.xx + stress.yy);
    stress.tresca = tresca_of(stress);
  });
  return stresses;
}

}  // namespace voussoir
