#pragma once
/// @file Scenes in motion side by side: their state, and what all scenes of a bridge share.

#include <array>
#include <cstddef>
#include <vector>

#include "core/law/triangle.h"
#include "core/motion/block_dynamics.h"
#include "core/motion/bonds.h"
#include "core/motion/contact.h"
#include "core/motion/contact_search.h"
#include "core/motion/pace.h"
#include "core/simd/pair.h"

namespace voussoir {

/// What all scenes of a variant share at one time step.
struct MotionModel {
  /// `bodies` as make_block_bodies gives them. The model must outlive this.
  MotionModel(const Model& model, std::vector<BlockBody> bodies, Pace pace, double damping,
              double contact_damping);

  double step() const { return pace.step; }
  bool carries(std::size_t block) const { return !carried_blocks.empty() && carried_blocks[block]; }

  const Structure* structure;  ///< outlives this
  Pace pace;
  double damping;          ///< of a scene at first: force on a mass per mass and velocity [1/s]
  double contact_damping;  ///< joints resist the gap and slip that they would have this much later [s]
  double gravity;          ///< [m/s2]
  ContactSearch search;
  std::vector<BondedJoint> bonds;
  std::vector<BlockBody> bodies;
  std::vector<double> responses;  ///< deformation_response of all blocks to their own steps, row by row
  std::vector<std::size_t> response_of_block;  ///< where each block's begins
  Eigen::VectorXd masses;                      ///< of the nodes [kg]
  std::vector<bool> held;                      ///< per displacement component
  std::vector<PlaneModuli> moduli;             ///< of each block
  std::vector<double> thickness;               ///< of each block [m]
  std::vector<TriangleShape> triangles;
  double weight = 0.0;                 ///< of the whole bridge [N]
  std::vector<double> per_weight;      ///< per block: 1 / its weight [1/N]
  std::vector<bool> carried_blocks{};  ///< per block: supports that hold all of it take it along ..
  Field carried{};                     ///< .. to here as gravity grows to all of it [m], 2 x nodes
};

/// The frame of a block: its centre, how far it has turned, and their rates.
template <class T>
struct BlockFrame {
  Pair<T> centre;    ///< [m]
  Pair<T> velocity;  ///< [m/s]
  Pair<T> rotation;  ///< (cos, sin) of the angle
  T spin;            ///< [rad/s]
};

/// Several scenes in motion, one in each lane.
template <class T>
struct Motion {
  std::vector<Pair<T>> places;    ///< of the nodes [m]
  std::vector<Pair<T>> moved;     ///< in the last step [m]
  std::vector<Pair<T>> forces;    ///< on the nodes [N]
  std::vector<Pair<T>> deformed;  ///< u of the nodes in their block's frame [m]
  std::vector<Pair<T>> rates;     ///< du/dt [m/s]; with explicit steps the nodes' velocities
  std::vector<BlockFrame<T>> frames;
  std::vector<Cell<T>> present;      ///< per block: 1, or 0 where it is removed
  std::vector<Pair<T>> pushes;       ///< forces on the nodes beside weight and joints [N]; empty: none. No
                                     ///< solver here sets any: LoadedBridge does, which lets blocks go slowly
                                     ///< (tools/validation/release.h)
  std::vector<Pair<T>> bond_forces;  ///< on the nodes [N]; empty: there are no bonds
  std::array<std::vector<MortarBond>, kLaneCount<T>> bonds;  ///< of each lane's scene
  std::vector<EdgePair> pairs;                               ///< that some lane's search has found, ascending
  std::vector<EdgeContact> contacts;                         ///< of `pairs`
  std::vector<int> quick_contacts;            ///< those of quick blocks, as positions in `pairs`
  std::vector<Cell<T>> found;                 ///< of `pairs`: 1 where the lane's own search has, otherwise 0
  std::vector<ContactShear<T>> shear;         ///< of `pairs`
  std::vector<Pair<T>> scratch;               ///< as long as the largest block
  alignas(sizeof(T)) T load{};                ///< share of gravity that acts
  alignas(sizeof(T)) T damping{};             ///< force on a mass per mass and velocity [1/s]
  alignas(sizeof(T)) T travel{};              ///< bound of any node's way since the last contact search [m]
  alignas(sizeof(T)) T unbalanced{};          ///< sum over blocks of the resultant forces [N]
  alignas(sizeof(T)) T largest_unbalanced{};  ///< largest resultant force of a block over its weight
};

/// Everything at rest; all lanes hold the intact bridge.
template <class T>
Motion<T> at_rest(const MotionModel& model);

/// Puts a scene at rest into a lane.
template <class T>
void place_scene(const MotionModel& model, const std::vector<bool>& removed, int lane_index,
                 Motion<T>& motion);

/// Share of a load that grows smoothly from 0 to 1 over the time `ramp` [s]; 0: at once.
double grown_share(double time, double ramp);

/// Looks for contacts anew in one lane; contacts that stay keep their shear. What the other lanes hold makes
/// no difference to this one, nor this one to them.
template <class T>
void search_contacts(const MotionModel& model, double margin, int lane_index, Motion<T>& motion);

/// Evaluates the bonds that hold, a time `contact_damping` ahead (core/motion/bonds.h); those that are worn
/// away turn into contacts at the next search.
template <class T>
void follow_bonds(const MotionModel& model, Motion<T>& motion);

/// Displacements in one lane [m], NaN at the nodes of removed blocks.
template <class T>
Field displacement(const MotionModel& model, const Motion<T>& motion, int lane_index);

/// Plastic slip of dry joints in one lane [m], 2 x joints: by how much more they have slipped than their
/// shear stress tells. Empty where joints have mortar.
template <class T>
Eigen::Matrix2Xd plastic_slip(const MotionModel& model, const Motion<T>& motion, int lane_index);

/// Kinetic energy in one lane [J].
template <class T>
double kinetic_energy(const MotionModel& model, const Motion<T>& motion, int lane_index);

}  // namespace voussoir
