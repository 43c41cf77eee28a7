#include "generator/scenes/composition.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statics/elements.h"
#include "core/statics/sensitivity.h"
#include "core/statics/transposed_solver.h"
#include "database/format/field_codec.h"

namespace voussoir {
namespace {

/// Of a signal whose sum over so many points is this.
double allowed_error(double signal, double points) {
  return std::max(kComposedShare * signal, kComposedError * points);
}

}  // namespace

double composed_error(std::span<const double> composed, std::span<const double> solved,
                      std::span<const double> intact) {
  double error = 0.0, signal = 0.0, points = 0.0;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    if (std::isnan(solved[i])) continue;
    error += std::abs(composed[i] - solved[i]);
    signal += std::abs(solved[i] - intact[i]);
    points += 1.0;
  }
  return error / allowed_error(signal, points);
}

Composition::Composition(const StageEquations& intact, const Field& displacement) {
  const EquilibriumSystem& system = *intact.system;
  const Structure& structure = *system.structure;
  ComponentRows influence = reading_columns(structure, structure.control_points);
  if (TransposedSolver(system).solve(intact, displacement, influence)) influence_ = influence;
}

bool Composition::has_parts(const Scene& scene, const StartingFields& starts) const {
  return influence_.size() != 0 && scene.missing() == 3 &&
         std::ranges::all_of(starting_subsets(scene),
                             [&](const Scene& part) { return starts.find(part, kBuilt) != nullptr; });
}

std::optional<Solution> Composition::of(const Scene& scene, const StartingFields& starts,
                                        const StageEquations& equations) const {
  const Structure& structure = *equations.system->structure;
  const Field composed = to_storage_precision(*starts.start_for(scene, kBuilt));
  const Field unbalanced = unbalanced_forces(equations, composed);
  const Eigen::VectorXd error = influence_.transpose() * unbalanced.reshaped();
  const Field signal = composed - *starts.intact(kBuilt);
  double error_sum = 0.0, signal_sum = 0.0, points = 0.0;
  for (std::size_t i = 0; i < structure.control_points.size(); ++i) {
    const ControlPoint& point = structure.control_points[i];
    if (lacks(scene, point)) continue;
    error_sum += std::abs(error[static_cast<Eigen::Index>(i)]);
    signal_sum += std::abs(reading_at(point, signal));
    points += 1.0;
  }
  if (!(kComposedMargin * error_sum <= allowed_error(signal_sum, points))) return std::nullopt;
  Solution solution;
  solution.outcome = Outcome::standing;
  solution.origin = Origin::composed;
  solution.residual = unbalanced.cwiseAbs().maxCoeff() / equations.largest_load;
  solution.displacement = composed;
  fill_removed(equations, std::numeric_limits<double>::quiet_NaN(), solution.displacement);
  return solution;
}

}  // namespace voussoir
