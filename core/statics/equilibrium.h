#pragma once
/// @file The discrete equations of a bridge: which displacements are free, what forces unbalance them, and
/// the tangent.
///
///   r(u) = load - internal forces of the triangles - forces of the joints,   tangent = - dr/du
///
/// Removed blocks keep their places in the vectors and the matrix (unit diagonal, zero residual), so that all
/// scenes and all variants of a bridge share one sparsity pattern and one symbolic factorisation.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "core/law/cohesive_law.h"
#include "core/law/joint_kinematics.h"
#include "core/law/joint_quadrature.h"
#include "core/law/state.h"
#include "core/law/triangle.h"
#include "core/structure/model.h"
#include "core/structure/stage.h"

namespace voussoir {

/// Everything about the equations that no parameter, no scene and no displacement changes.
struct EquilibriumSystem {
  explicit EquilibriumSystem(const Structure& structure, JointRule rule = JointRule::exact);

  const Structure* structure;  ///< outlives the system
  JointRule joint_rule;
  std::vector<TriangleShape> triangles;
  std::vector<JointFrame> joints;
  std::vector<int> unknown;    ///< per displacement component 2 node + axis: its unknown, or -1 if held
  std::vector<int> component;  ///< the inverse: per unknown its displacement component
  Eigen::SparseMatrix<double> pattern;              ///< of the tangent, all values zero
  std::vector<std::array<int, 36>> triangle_slots;  ///< position of each entry in the value array, -1 if held
  std::vector<std::array<int, 64>> joint_slots;
  std::vector<int> diagonal_slots;

  int unknown_count() const { return static_cast<int>(component.size()); }
};

/// What a variant's parameters make of the equations.
struct Coefficients {
  Coefficients(const EquilibriumSystem& system, const Parameters& parameters);

  std::vector<PlaneModuli> moduli;                       ///< of each block
  std::vector<double> thickness;                         ///< of each block [m]
  std::vector<double> thermal;                           ///< thermal_pressure of each block [Pa/K]
  std::vector<JointStiffness> joints;                    ///< of each joint
  std::vector<std::optional<CohesiveStiffness>> mortar;  ///< of each joint; empty if all are dry
  Eigen::VectorXd weight;                                ///< of each node under full gravity [N], positive
  std::vector<double> elastic;  ///< the triangles' part of the tangent at rest, in the order of the pattern

  /// Null if the joint is dry.
  const CohesiveStiffness* mortar_of(std::size_t joint) const {
    return mortar.empty() || !mortar[joint] ? nullptr : &*mortar[joint];
  }
};

/// The same with this share of p_n and p_t of each joint that is dry.
Coefficients with_joint_stiffness(Coefficients coefficients, const Eigen::ArrayXd& shares);

/// What a very viscous bath would do in one implicit step of time: it holds each node back, with its weight
/// for each `reach` [m] that the node moves. So what nothing else holds sinks by `reach`.
struct Drag {
  double reach;
  Field place;  ///< that nodes move from; no NaN
};

/// The equations of one stage of one variant. Shares `system` and `coefficients`, which must outlive it.
struct StageEquations {
  /// `memory`: of each joint, what the stages before have left; empty: nothing. The stage's load on removed
  /// blocks and held components does not act.
  StageEquations(const EquilibriumSystem& system, const Coefficients& coefficients, const Stage& stage,
                 std::vector<JointMemory> memory = {});

  const EquilibriumSystem* system;
  const Coefficients* coefficients;
  std::vector<bool> removed;  ///< per block
  std::vector<JointMemory> memory;
  double gravity_share;  ///< of the stage
  std::vector<double>
      heat;  ///< what the stage's temperature presses each block with [Pa]: Coefficients::thermal
  Field support_movement;  ///< of the stage; empty: none
  Field load;              ///< weight and load of the stage on present blocks [N]
  double largest_load;     ///< component of the load on the whole bridge [N]: the unit of residuals; 1 if
                           ///< nothing is loaded
  std::optional<Drag> drag{};
};

/// What a joint does in this state, by the law that it has.
JointResponse joint_response(const StageEquations& equations, std::size_t joint, const JointState& state);

/// Unbalanced force of every displacement component [N] (2 x nodes); zero at removed blocks and held
/// components.
Field unbalanced_forces(const StageEquations& equations, const Field& displacement);

/// Forces by which the supports hold the structure [N] (2 x nodes): zero at free components.
Field support_forces(const StageEquations& equations, const Field& displacement);

/// Where an assembly writes a matrix: value i of the pattern at first[i * stride]. A stride lets matrices lie
/// side by side.
struct TangentTarget {
  double* first;
  std::size_t stride = 1;
};

/// How an assembly has the triangles' part of the tangent.
enum class ElasticPart {
  exact,
  at_rest  ///< no triangle's tangent is worked out: off by the blocks' rotations and strains, which are small
           ///< where a bridge stands, but not the exact derivative
};

/// The same, and the tangent's values in the order of `system.pattern`. `bonding` in [0,1] mixes the tangent
/// of bonded (closed and sticking) joints into the exact one: 0 is the exact derivative, 1 the linear bridge
/// without openings; in between, loose blocks are held just enough to make the matrix regular. Forces are
/// exact always.
Field assemble(const StageEquations& equations, const Field& displacement, double bonding,
               TangentTarget tangent, ElasticPart elastic = ElasticPart::exact);

/// What the joints remember when the stage ends with this displacement.
std::vector<JointMemory> updated_memory(const StageEquations& equations, const Field& displacement);

/// The nearest field that the supports allow: their movement where they hold, zero where the field says
/// nothing (NaN) and where blocks are gone.
Field admissible(const StageEquations& equations, const Field& field);

/// Per block: is it missing?
std::vector<bool> removal_mask(const Scene& scene, std::size_t block_count);

/// Largest unbalanced force component of a field over the largest nodal weight, computed from the field alone
/// (NaN at nodes of removed blocks is expected and ignored). What a stored field is checked by.
double unbalanced_force(const StageEquations& equations, const Field& displacement);

/// The same for a scene under its weight whose joints have slipped beforehand as in Solution.
double unbalanced_force(const Model& model, const Scene& scene, const Field& displacement,
                        const Eigen::Matrix2Xd& slipped = {});

}  // namespace voussoir
