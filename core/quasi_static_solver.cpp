#include "core/quasi_static_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/equilibrium.h"
#include "core/sparse_solver.h"

namespace voussoir {
namespace {

constexpr double kLeastBonding =
    1e-3;  ///< first help for loose blocks: a thousandth of the joints' stiffness
constexpr double kBondingFactor = 10.0;  ///< more help for a step out of bounds, less after a step
constexpr int kMostHalvings = 4;
constexpr std::size_t kMemory =
    5;  ///< a step may rise to the worst of the last residuals: closing joints do so

/// How far a phase of the search lets a step go.
struct Boldness {
  double largest_step;  ///< in units of the largest displacement so far; loose blocks would jump further
  double rise;          ///< of the residual above the worst of the last ones
};
constexpr Boldness kSearching{.largest_step = 0.5, .rise = 1.0};
constexpr Boldness kFalling{.largest_step = 2.0, .rise = 3.0};

/// The tangent with all joints closed and sticking, the pivots' reference.
std::vector<double> bonded_tangent(const EquilibriumSystem& system) {
  std::vector<double> values;
  const Field rest = Field::Zero(2, system.bridge->mesh.node_count());
  assemble(system, std::vector<bool>(system.bridge->layout.size(), false), rest, 1.0, values);
  return values;
}

Eigen::VectorXd at_unknowns(const EquilibriumSystem& system, const Field& field) {
  Eigen::VectorXd vector(system.unknown_count());
  for (int i = 0; i < system.unknown_count(); ++i)
    vector[i] = field.data()[system.component[static_cast<std::size_t>(i)]];
  return vector;
}

Field moved(const EquilibriumSystem& system, const Field& field, double factor, const Eigen::VectorXd& step) {
  Field result = field;
  for (int i = 0; i < system.unknown_count(); ++i)
    result.data()[system.component[static_cast<std::size_t>(i)]] += factor * step[i];
  return result;
}

void fill_removed(const Mesh& mesh, const std::vector<bool>& removed, double filling, Field& field) {
  for (std::size_t block = 0; block < removed.size(); ++block)
    if (removed[block])
      field.middleCols(mesh.block_nodes[block].begin, mesh.block_nodes[block].size()).setConstant(filling);
}

/// Zero where the start says nothing, where supports hold and where blocks are gone.
Field admissible(const EquilibriumSystem& system, const std::vector<bool>& removed, const Field& start) {
  Field field = start.array().isNaN().select(0.0, start);
  for (std::size_t c = 0; c < system.unknown.size(); ++c)
    if (system.unknown[c] < 0) field.data()[c] = 0.0;
  fill_removed(system.bridge->mesh, removed, 0.0, field);
  return field;
}

/// Where a Newton search is.
struct Search {
  Field displacement;
  Field unbalanced;                    ///< at `displacement` [N]
  double bonding = 0.0;                ///< share of bonded joints in the tangent
  double last_step = 0.0;              ///< largest component [m]
  std::array<double, kMemory> recent;  ///< the last norms of `unbalanced`
  int iterations = 0;                  ///< factorisations, in all phases
};

double largest_displacement(const Search& search) {
  return search.displacement.cwiseAbs().maxCoeff();
}

}  // namespace

struct QuasiStaticSolver::Workspace {
  QuasiStaticSettings settings;
  EquilibriumSystem system;
  SparseSolver linear;
  std::vector<double> tangent;  ///< at the search's displacement and bonding
  std::vector<bool> removed;

  Workspace(const Bridge& bridge, QuasiStaticSettings settings_)
      : settings(settings_), system(bridge), linear(system.pattern, bonded_tangent(system)) {}

  Field rest() const { return Field::Zero(2, system.bridge->mesh.node_count()); }

  Solution solve(const Scene& scene, const Field* start);
  Search begin(const Field& start, double bonding, int iterations);
  void advance(Search& search, int most_iterations, const Boldness& boldness);
  bool find_step(Search& search, const Boldness& boldness, Eigen::VectorXd& step);
  void take_step(Search& search, const Boldness& boldness, const Eigen::VectorXd& step);
  double residual(const Search& search) const;
  bool in_equilibrium(const Search& search) const;
  bool fallen(const Search& search) const;
  Solution concluded(const Search& search) const;
};

Solution QuasiStaticSolver::Workspace::solve(const Scene& scene, const Field* start) {
  removed = removal_mask(scene, system.bridge->layout.size());
  Search search;
  if (start != nullptr) {
    search = begin(*start, 0.0, 0);
    advance(search, settings.most_warm_iterations, kSearching);
  }
  if (start == nullptr || !in_equilibrium(search)) {
    search = begin(rest(), 1.0, search.iterations);
    advance(search, settings.most_iterations, kSearching);
  }
  if (!in_equilibrium(search)) advance(search, settings.most_falling_iterations, kFalling);
  return concluded(search);
}

Search QuasiStaticSolver::Workspace::begin(const Field& start, double bonding, int iterations) {
  Search search;
  search.displacement = admissible(system, removed, start);
  search.unbalanced = assemble(system, removed, search.displacement, bonding, tangent);
  search.bonding = bonding;
  search.recent.fill(std::numeric_limits<double>::infinity());
  search.iterations = iterations;
  return search;
}

/// Newton steps until equilibrium, a fall, or the end of patience.
void QuasiStaticSolver::Workspace::advance(Search& search, int most_iterations, const Boldness& boldness) {
  const int last = search.iterations + most_iterations;
  Eigen::VectorXd step;
  while (search.iterations < last && !in_equilibrium(search) && !fallen(search)) {
    if (!find_step(search, boldness, step)) return;
    take_step(search, boldness, step);
  }
}

/// Newton direction, with as little bonding as keeps it within bounds. False if the matrix is singular all
/// the same.
bool QuasiStaticSolver::Workspace::find_step(Search& search, const Boldness& boldness,
                                             Eigen::VectorXd& step) {
  const double so_far = largest_displacement(search);
  const double bound =
      so_far > 0.0 ? boldness.largest_step * so_far : std::numeric_limits<double>::infinity();
  for (;;) {
    ++search.iterations;
    if (linear.factorise(tangent)) {
      step = at_unknowns(system, search.unbalanced);
      linear.solve(step);
      if (step.allFinite() && (search.bonding >= 1.0 || step.cwiseAbs().maxCoeff() <= bound)) return true;
    }
    if (search.bonding >= 1.0) return false;
    search.bonding = std::clamp(search.bonding * kBondingFactor, kLeastBonding, 1.0);
    assemble(system, removed, search.displacement, search.bonding, tangent);
  }
}

/// Halves the step while the unbalance rises too far.
void QuasiStaticSolver::Workspace::take_step(Search& search, const Boldness& boldness,
                                             const Eigen::VectorXd& step) {
  const double bound = boldness.rise * *std::max_element(search.recent.begin(), search.recent.end());
  const Field before = search.displacement;
  search.bonding = search.bonding > kLeastBonding ? search.bonding / kBondingFactor : 0.0;
  double factor = 1.0;
  double norm = 0.0;
  for (int halving = 0; halving <= kMostHalvings; ++halving, factor *= 0.5) {
    search.displacement = moved(system, before, factor, step);
    search.unbalanced = assemble(system, removed, search.displacement, search.bonding, tangent);
    search.last_step = factor * step.cwiseAbs().maxCoeff();
    norm = search.unbalanced.norm();
    if (norm < bound) break;
  }
  std::rotate(search.recent.begin(), search.recent.begin() + 1, search.recent.end());
  search.recent.back() = norm;
}

double QuasiStaticSolver::Workspace::residual(const Search& search) const {
  return search.unbalanced.cwiseAbs().maxCoeff() / system.largest_weight;
}

bool QuasiStaticSolver::Workspace::in_equilibrium(const Search& search) const {
  const double r = residual(search);
  const bool at_round_off = search.iterations > 0 && search.bonding == 0.0 &&
                            search.last_step <= settings.round_off * largest_displacement(search);
  return r <= settings.tolerance || (at_round_off && r <= settings.loose_tolerance);
}

bool QuasiStaticSolver::Workspace::fallen(const Search& search) const {
  const double largest = largest_displacement(search);
  return !std::isfinite(largest) || largest > settings.collapse_displacement;
}

Solution QuasiStaticSolver::Workspace::concluded(const Search& search) const {
  Solution solution;
  solution.displacement = search.displacement;
  solution.residual = residual(search);
  solution.iterations = search.iterations;
  if (fallen(search))
    solution.outcome = Outcome::collapsed;
  else if (in_equilibrium(search))
    solution.outcome = Outcome::standing;
  fill_removed(system.bridge->mesh, removed, std::numeric_limits<double>::quiet_NaN(), solution.displacement);
  return solution;
}

QuasiStaticSolver::QuasiStaticSolver(const Bridge& bridge, QuasiStaticSettings settings)
    : workspace_(std::make_unique<Workspace>(bridge, settings)) {}
QuasiStaticSolver::~QuasiStaticSolver() = default;
QuasiStaticSolver::QuasiStaticSolver(QuasiStaticSolver&&) noexcept = default;
QuasiStaticSolver& QuasiStaticSolver::operator=(QuasiStaticSolver&&) noexcept = default;

Solution QuasiStaticSolver::solve(const Scene& scene) {
  return workspace_->solve(scene, nullptr);
}

Solution QuasiStaticSolver::solve(const Scene& scene, const Field& start) {
  return workspace_->solve(scene, &start);
}

}  // namespace voussoir
