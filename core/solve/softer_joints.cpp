#include "core/solve/softer_joints.h"

#include <algorithm>

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
  settings.follow_falls = false;
  settings.most_warm_iterations = settings.most_iterations = kMostIterations;
  return settings;
}

std::vector<Approach> approach_from_softer_joints(QuasiStaticSolver& solver, const Parameters& parameters,
                                                  double softest, std::span<const StageTask> tasks) {
  std::vector<StageTask> left(tasks.begin(), tasks.end());
  for (StageTask& task : left) task.start = nullptr;
  std::vector<std::size_t> places(tasks.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  std::vector<Approach> approaches(tasks.size());
  for (const double share : shares_from(softest)) {
    Parameters softer = parameters;
    for (JointMaterial& joint : softer.joints) joint = softened(joint, share);
    for (StageTask& task : left) task.parameters = &softer;
    std::vector<Solution> found = solver.solve(left);
    std::vector<StageTask> going_on;
    std::vector<std::size_t> their_places;
    for (std::size_t k = 0; k < left.size(); ++k) {
      Solution& solution = approaches[places[k]].solution;
      found[k].iterations += solution.iterations;
      solution = std::move(found[k]);
      if (solution.outcome != Outcome::standing) {
        solution.outcome = Outcome::unresolved;
        continue;
      }
      approaches[places[k]].reached = share;
      going_on.push_back(left[k]);
      going_on.back().start = &solution.displacement;
      their_places.push_back(places[k]);
    }
    left = std::move(going_on);
    places = std::move(their_places);
  }
  return approaches;
}

}  // namespace voussoir
