#include "generator/uncertainty/load_influence.h"

#include <algorithm>
#include <cmath>

#include "core/statics/transposed_solver.h"
#include "core/structure/top_surface.h"

namespace voussoir {
namespace {

constexpr double kSpacing = 0.5;  // [m] of places along the top: a wheel is not felt more sharply

/// Evenly along the bridge, where there is a block to carry a load [m].
std::vector<double> places_on_top(const Structure& structure, const TopSurface& top) {
  const auto x = structure.mesh.nodes.row(0);
  const double left = x.minCoeff(), length = x.maxCoeff() - left;
  const double intervals = std::clamp(std::round(length / kSpacing), 1.0, kMostLoadPlaces - 1.0);
  std::vector<double> places;
  for (double i = 0.0; i <= intervals; ++i)
    if (const double place = left + length * (i / intervals); top.is_under(place)) places.push_back(place);
  return places;
}

/// Of 1 N for each metre of the bridge's width at each of the places, down: a column each.
Eigen::SparseMatrix<double> forces_at(const std::vector<double>& places, const TopSurface& top, double width,
                                      Eigen::Index nodes) {
  Eigen::MatrixXd forces(2 * nodes, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    Field force = Field::Zero(2, nodes);
    top.add_force(places[i], width, force);
    forces.col(static_cast<Eigen::Index>(i)) = force.reshaped();
  }
  return forces.sparseView();
}

}  // namespace

/// By the adjoints of the readings: one factorisation for all places.
LoadInfluence find_load_influence(const SensitivityStudy& study, const SensitivityEquations& equations,
                                  const SceneStates& intact) {
  const auto history = SceneDerivatives(study, equations).history({}, kBuilt, intact, intact);
  if (!history) return {};
  const SolvedStep& end = history->back();
  ComponentRows adjoints = equations.readings;
  if (!TransposedSolver(equations.system).solve(end.equations, end.displacement, adjoints)) return {};
  const TopSurface top(study.bridge.mesh);
  const double width = study.description.material.thickness;
  LoadInfluence influence{places_on_top(study.bridge, top), {}};
  influence.readings =
      adjoints.transpose() * forces_at(influence.places, top, width, study.bridge.mesh.node_count());
  return influence;
}

}  // namespace voussoir
