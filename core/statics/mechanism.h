#pragma once
/// @file Proofs that blocks fall: where no forces in the joints can carry them (rigid-block limit analysis).
///
/// A joint's force on a block is a sum of non-negative multiples of four: at either end of the stretch, from
/// either edge of Coulomb's cone, n +- mu t. With these as columns of A and the forces and moments that would
/// carry the blocks' weight as g, the blocks can be in equilibrium only if A x = g for some x >= 0. The x
/// with the least |A x - g| leaves r = g - A x, and for that r, as virtual velocities upwards,
///     A^T r <= 0 and r . g = |r|^2
/// (Farkas' lemma): if r is not zero, the weight does work, in going down by r, that no joint resists.
/// Geometry is that of the bridge as built and blocks are rigid, so the share of the work has to be clearly
/// positive.
///
/// A scene with more blocks missing has fewer joints, so what proves its fall is the work alone that r does
/// on the blocks which it still has.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/statics/equilibrium.h"
#include "core/statics/solution.h"

namespace voussoir {

/// Blocks that fall without those of `scene`, and what r does on each.
struct Mechanism {
  Scene scene;
  std::vector<BlockId> blocks;     ///< ascending
  std::vector<double> work;        ///< r . g [N2]
  std::vector<double> load;        ///< g . g [N2]
  std::vector<double> unbalanced;  ///< the force in r over the bridge's weight [-]
};

/// Why these blocks cannot all stay without the scene's if nothing beyond them moves; nothing if some forces
/// could carry them, and nothing where joints have mortar, whose strength is not looked at. Blocks that a
/// support holds are taken for fixed. Only the weight acts.
std::optional<Mechanism> find_mechanism(const Model& model, const Coefficients& coefficients,
                                        const Scene& scene, std::span<const BlockId> blocks);

/// The same of the blocks beside the missing ones, which are few and fall most often, without asking what
/// moves: `blocks` are those of them that fall. More than a third of random bridges' falls are proved so, in
/// a tenth of a millisecond.
std::optional<Mechanism> find_mechanism_beside(const Model& model, const Coefficients& coefficients,
                                               const Scene& scene);

/// Does the mechanism prove that this scene falls? So it can if the scene lacks all that its own does.
bool proves_fall(const Mechanism& mechanism, const Scene& scene);

/// What is known of a scene that one of the mechanisms proves to fall: `moving` are the blocks that it has of
/// all mechanisms that do, `residual` is the sum of their unbalanced forces over the bridge's weight in that
/// where it is largest; no field (NaN). Nothing if none does.
std::optional<Solution> proved_fall(std::span<const Mechanism* const> mechanisms, const Scene& scene,
                                    const Structure& structure);

}  // namespace voussoir
