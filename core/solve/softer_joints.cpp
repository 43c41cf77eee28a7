#include "core/solve/softer_joints.h"

#include <numeric>

namespace voussoir {
namespace {

constexpr double kStiffer = 10.0;  ///< from one equilibrium to the next
constexpr int kMostIterations = 25;

/// Shares of the joints' stiffness, the last one 1.
std::vector<double> shares_from(double softest) {
  std::vector<double> shares;
  for (double share = softest; share < 1.0; share *= kStiffer) shares.push_back(share);
  shares.push_back(1.0);
  return shares;
}

}  // namespace

QuasiStaticSettings approaching(QuasiStaticSettings settings) {
  settings.follow_falls = settings.patient_first = false;
  settings.most_warm_iterations = settings.most_iterations = kMostIterations;
  return settings;
}

std::vector<Approach> approach_from_softer_joints(QuasiStaticSolver& solver, const Parameters& parameters,
                                                  double softest, std::span<const StageTask> tasks) {
  std::vector<Approach> approaches(tasks.size());
  std::vector<std::size_t> open(tasks.size());  // that stood so far
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (const double share : shares_from(softest)) {
    if (open.empty()) break;
    Parameters softer = parameters;
    for (JointMaterial& joint : softer.joints) joint = softened(joint, share);
    std::vector<StageTask> next;
    for (const std::size_t i : open) {
      next.push_back(tasks[i]);
      next.back().parameters = &softer;
      next.back().start = approaches[i].reached > 0.0 ? &approaches[i].solution.displacement : nullptr;
    }
    std::vector<Solution> found = solver.solve(next);
    std::vector<std::size_t> standing;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Approach& approach = approaches[open[k]];
      found[k].iterations += approach.solution.iterations;
      approach.solution = std::move(found[k]);
      if (approach.solution.outcome == Outcome::standing) {
        approach.reached = share;
        standing.push_back(open[k]);
      } else {
        approach.solution.outcome = Outcome::unresolved;
      }
    }
    open = std::move(standing);
  }
  return approaches;
}

}  // namespace voussoir
