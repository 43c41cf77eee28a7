#pragma once
/// @file Readings of a bridge that is not exactly known, as one Gaussian for each scene:
///
///   y | scene, kappa ~ N(mean, kappa A A^T + E E^T + noise)
///
/// A, E: what a standard deviation of the bridge's and of each epoch's parameters changes (ReadingFactors);
/// kappa: by how much the bridge's scatter differs from what the bridge file states (scatter_factor.h);
/// noise: instruments, levellings, the model's own error, what is uneven in an epoch
/// (core/structure/unevenness.h), and what the first order leaves of the intact bridge.
///
/// The factors of two or three blocks are those of the intact bridge and what each block changes alone,
/// unless the database has the scene's own; the model's errors in both add up. What a scene's signal is
/// beyond that of its blocks with known factors counts as uncertain as signals typically are: by one factor,
/// and where not all blocks have factors once more at each point by itself. So scenes without factors (that
/// collapse, or with a block whose loss alone makes a collapse) are told less sharply, not excluded. Blocks
/// that touch change much together: at each point by itself that would widen the covariance in all
/// directions, and another scene, which explains less, would be likelier.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "lookup/readings/observation.h"

namespace voussoir {

/// A number of y: after * (channel in the second epoch) + before * (in the first, with no block missing).
struct ReadingRow {
  std::size_t channel = 0;
  double before = 0.0;
  double after = 1.0;

  double of_bridge() const { return before + after; }  ///< how what is the same in both epochs counts
};

/// What the first of two epochs tells.
enum class Epochs {
  change,  ///< only the difference counts: readings before have a datum of their own at every point
  both     ///< the first's are displacements since the bridge carried nothing, and teach what it is like
};

/// Temperature, movements of supports and a factor on the joints' stiffness, which every epoch has of its
/// own. What is uneven is uncertain either way: no readings can be corrected for that.
enum class Conditions {
  uncertain,  ///< as the bridge file states, or less (case_noise.h)
  known       ///< they are those of the model, or readings have been corrected for them
};

struct UnknownSettings {
  Epochs epochs = Epochs::change;
  Conditions conditions = Conditions::uncertain;
  double scale = 0.0;  ///< Nuisance::scale
};

/// In rows of y what a matrix whose rows are channels shows before and after.
Eigen::MatrixXd in_rows(const std::vector<ReadingRow>& rows, const Eigen::MatrixXd& before,
                        const Eigen::MatrixXd& after);

/// In rows of y a product by channel, each row with its weight.
Eigen::MatrixXd product_in_rows(const std::vector<ReadingRow>& rows, const Eigen::MatrixXd& by_channel,
                                double (*weight)(const ReadingRow&));

/// The loss of a block, or of several with factors of their own, in rows of y.
struct Loss {
  const LossFactors* factors = nullptr;  ///< none if they are not known
  Eigen::VectorXd signal{};              ///< [m] NaN at readings that the loss makes impossible
  double bridge_variance = 0.0;  ///< [m2] that parameters of the bridge give the signal, summed over rows
  double epoch_variance = 0.0;   ///< [m2] the same of those of an epoch, as the bridge file states them
  bool may_fall = false;         ///< in the nominal bridge it does (SceneTable::is_uncertain_fall)
  double log_weight = 0.0;       ///< SceneTable::log_weight
  bool known() const { return factors != nullptr; }
};

struct UnknownBridge {
  const ReadingFactors* factors = nullptr;
  std::vector<ReadingRow> rows;
  Eigen::VectorXd reading;     ///< [m] less what the intact bridge shows
  Eigen::VectorXd movement;    ///< [m] of the intact bridge, as a common factor counts it
  std::vector<Loss> losses;    ///< by block, then of `several`
  std::vector<Scene> several;  ///< scenes of several blocks with factors of their own, in ascending order
  std::size_t blocks = 0;
  Eigen::Index epochs = 1;  ///< in y, each with its own columns of E
  Conditions conditions = Conditions::uncertain;
  double scale = 0.0;  ///< [-] of a factor on all movements, as far as it was asked for
  double model_error =
      0.0;  ///< [-] standard deviation of the model's own error: a factor of a loss's signal. The
            ///< mesh errs to one side; an error of each point by itself would say more than is known
  Eigen::MatrixXd fixed_noise;  ///< [m2] of all scenes, but for the instruments and
  Eigen::MatrixXd unevenness;   ///< [m2] of them: of what is uneven in an epoch
  Eigen::MatrixXd epoch_noise;  ///< what the first order leaves of conditions as the file states them

  const Loss& loss_of(BlockId block) const { return losses[static_cast<std::size_t>(value(block))]; }
  bool has_first_epoch() const { return rows.front().after == 0.0; }  ///< before the rows of changes
};

/// Preconditions: the comparison has factors, the observation Gaussian noise and at least one reading.
UnknownBridge unknown_bridge(const Comparison& comparison, const Observation& observation,
                             const UnknownSettings& settings);

/// The losses with factors that a scene is made of: places in UnknownBridge::losses. Of what falls those do
/// not count that only some bridges survive.
inline constexpr std::size_t kMostLosses = 3;
struct KnownLosses {
  std::array<std::size_t, kMostLosses> place{};
  std::size_t count = 0;
  bool all = true;  ///< does the scene lack no block besides?
};

/// Of a scene that has factors of its own, its place in UnknownBridge::losses.
std::optional<std::size_t> place_of_several(const UnknownBridge& bridge, const Scene& scene);
/// Asked for millions of rows.
inline KnownLosses known_losses(const UnknownBridge& bridge, const SceneTable& table, std::size_t row) {
  if (!bridge.several.empty())
    if (const auto own = place_of_several(bridge, table.scene(row))) return {{*own}, 1};
  KnownLosses found;
  for (const std::int32_t block : table.removed.subspan(row * table.most_missing, table.most_missing)) {
    if (block < 0) continue;
    const Loss& loss = bridge.losses[static_cast<std::size_t>(block)];
    const bool is_known = loss.known() && !(loss.may_fall && !table.may_stand(row));
    if (is_known && found.count < kMostLosses)
      found.place[found.count++] = static_cast<std::size_t>(block);
    else
      found.all = false;
  }
  return found;
}

/// What one scene lacks, in rows of y.
struct SceneLoss {
  std::vector<const Loss*> known;  ///< with factors: of its blocks, or its own
  Eigen::VectorXd signal;          ///< [m] less what the intact bridge shows
  Eigen::VectorXd beyond;          ///< [m] of it what is not that of the known losses
  double square_at_points = 0.0;  ///< [m2] mean square of that over the rows after, if not all blocks' losses
                                  ///< are known; otherwise 0
};

/// Nothing if the scene is impossible: a block with a reading is missing.
std::optional<SceneLoss> scene_loss(const UnknownBridge& bridge, const Observation& observation,
                                    const SceneTable& table, std::size_t row);

/// A A^T of the intact bridge.
Eigen::MatrixXd intact_product(const UnknownBridge& bridge);

/// A of a scene: a column for each column of the basis of the bridge's parameters.
Eigen::MatrixXd bridge_columns(const UnknownBridge& bridge, const Scene& scene);

/// E of a scene, conditions being as the bridge file states: a column for each epoch in y and parameter.
Eigen::MatrixXd epoch_columns(const UnknownBridge& bridge, const SceneLoss& loss);

/// Columns of what else is uncertain of a scene in all cases: the common factor, and the model's own error in
/// each of its known losses.
Eigen::MatrixXd other_columns(const UnknownBridge& bridge, const SceneLoss& loss);

}  // namespace voussoir
