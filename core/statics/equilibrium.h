#pragma once
/// @file The discrete equations of a bridge: which displacements are free, what forces unbalance them, and
/// the tangent.
///
///   r(u) = load - internal forces of the triangles - forces of the joints,   tangent = - dr/du
///
/// Removed blocks keep their places in the vectors and the matrix (unit diagonal, zero residual), so that all
/// scenes of a bridge share one sparsity pattern and one symbolic factorisation.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/law/joint_kinematics.h"
#include "core/law/triangle.h"
#include "core/structure/bridge.h"

namespace voussoir {

/// Everything about the equations that no scene and no displacement changes.
struct EquilibriumSystem {
  /// `dead_load`: forces on the nodes beside the blocks' weight [N], 2 x nodes, of fixed direction; empty for
  /// none. Those on removed blocks and held components do not act.
  explicit EquilibriumSystem(const Bridge& bridge, const Field& dead_load = {},
                             JointRule rule = JointRule::exact);

  const Bridge* bridge;  ///< outlives the system
  JointRule joint_rule;
  PlaneModuli moduli;
  std::vector<TriangleShape> triangles;
  std::vector<JointFrame> joints;
  std::vector<BlockId> triangle_block;
  Eigen::VectorXd weight;      ///< of each node [N], positive
  Field load;                  ///< weight and dead load of each node [N]
  double largest_load;         ///< component of `load` [N]: the unit of residuals; 1 if nothing is loaded
  std::vector<int> unknown;    ///< per displacement component 2 node + axis: its unknown, or -1 if held
  std::vector<int> component;  ///< the inverse: per unknown its displacement component
  Eigen::SparseMatrix<double> pattern;              ///< of the tangent, all values zero
  std::vector<std::array<int, 36>> triangle_slots;  ///< position of each entry in the value array, -1 if held
  std::vector<std::array<int, 64>> joint_slots;
  std::vector<int> diagonal_slots;

  int unknown_count() const { return static_cast<int>(component.size()); }
};

/// Unbalanced force of every displacement component [N] (2 x nodes); zero at removed blocks and held
/// components.
Field unbalanced_forces(const EquilibriumSystem& system, const std::vector<bool>& removed,
                        const Field& displacement);

/// Where an assembly writes a matrix: value i of the pattern at first[i * stride]. A stride lets matrices lie
/// side by side.
struct TangentTarget {
  double* first;
  std::size_t stride = 1;
};

/// The same, and the tangent's values in the order of `system.pattern`. `bonding` in [0,1] mixes the tangent
/// of bonded (closed and sticking) joints into the exact one: 0 is the exact derivative, 1 the linear bridge
/// without openings; in between, loose blocks are held just enough to make the matrix regular. Forces are
/// exact always.
Field assemble(const EquilibriumSystem& system, const std::vector<bool>& removed, const Field& displacement,
               double bonding, TangentTarget tangent);

/// Per block: is it missing?
std::vector<bool> removal_mask(const Scene& scene, std::size_t block_count);

/// Largest unbalanced force component of a field over the largest nodal weight, computed from the field alone
/// (NaN at nodes of removed blocks is expected and ignored). What a stored field is checked by.
double unbalanced_force(const Bridge& bridge, const Scene& scene, const Field& displacement);

}  // namespace voussoir
