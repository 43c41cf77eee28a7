#include "lookup/readings/sampled_bridges.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "database/records/scene_change.h"
#include "database/records/stored_bridge.h"
#include "lookup/readings/standardised_parameters.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One state of the nominal bridge and of the sampled ones.
struct StateTables {
  SceneTable nominal;
  std::vector<SceneTable> sampled;
};

std::optional<std::span<const double>> standing_row(const SceneTable& table, const Scene& scene) {
  const auto row = table.find(scene);
  return row && table.may_stand(*row) ? std::optional(table.row(*row)) : std::nullopt;
}

/// How bridges differ from the nominal one in a scene [m]: points x bridges. Zero at points whose block is
/// gone, and for bridges in which the scene does not stand.
struct Sample {
  MatrixXd difference;
  VectorXd points_left;  ///< 1, or 0 where the block is gone
  std::vector<bool> stands;
  Index standing = 0;  ///< bridges
};

/// Nothing if the scene neither stands in the nominal bridge nor may.
std::optional<Sample> sample_of(const StateTables& tables, const Scene& scene) {
  const auto nominal = standing_row(tables.nominal, scene);
  if (!nominal) return std::nullopt;
  const auto points = static_cast<Index>(nominal->size());
  Sample sample{
      MatrixXd::Zero(points, static_cast<Index>(tables.sampled.size())), VectorXd::Zero(points), {}};
  for (Index i = 0; i < points; ++i)
    sample.points_left[i] = std::isnan((*nominal)[static_cast<std::size_t>(i)]) ? 0.0 : 1.0;
  for (const SceneTable& table : tables.sampled) {
    const auto shown = standing_row(table, scene);
    const auto bridge = static_cast<Index>(sample.stands.size());
    sample.stands.push_back(shown.has_value());
    if (!shown) continue;
    ++sample.standing;
    for (std::size_t i = 0; i < shown->size(); ++i)
      if (!std::isnan((*nominal)[i]))
        sample.difference(static_cast<Index>(i), bridge) = (*shown)[i] - (*nominal)[i];
  }
  return sample;
}

/// The first order's columns, and the samples' with the weight that makes their sum of squares a mean.
MatrixXd columns_of(const MatrixXd& first_order, const MatrixXd& left, Index standing) {
  MatrixXd columns(left.rows(), first_order.cols() + left.cols());
  columns.leftCols(first_order.cols()) = first_order;
  columns.rightCols(left.cols()) = left / std::sqrt(static_cast<double>(std::max<Index>(standing, 1)));
  return columns;
}

/// The first order, and where along its columns the sampled bridges are.
struct FirstOrder {
  const Sensitivities& sensitivities;
  MatrixXd positions;  ///< columns of the basis x bridges
};

SceneFactors owned(const FactorsView& factors) {
  return {factors.bridge, factors.epoch};
}

/// Makes the factors of one state.
class StateFactors {
 public:
  /// The first order may be null.
  StateFactors(const StateTables& tables, const FirstOrder* first_order, std::size_t state)
      : tables_(tables),
        first_order_(first_order),
        state_(state),
        intact_sample_(sample_of(tables, {}).value()),
        intact_first_(first_order ? owned(*first_order->sensitivities.find(state, {}))
                                  : SceneFactors{MatrixXd(points(), 0), MatrixXd(points(), 0)}) {
    MatrixXd left = intact_sample_.difference;
    if (first_order) left -= intact_first_.bridge * first_order->positions;
    intact_ = columns_of(intact_first_.bridge, left, intact_sample_.standing);
  }

  /// Not known if neither the first order nor enough bridges know it.
  SceneFactors operator()(const Scene& scene) const {
    if (scene.removed.empty()) return {intact_, intact_first_.epoch};
    const auto sample = sample_of(tables_, scene);
    if (!sample) return {};
    const auto first = first_order_ ? first_order_->sensitivities.find(state_, scene) : std::nullopt;
    const bool enough = sample->standing >= static_cast<Index>(kFewestBridges);
    if (!first && !enough) return {};
    const auto left = sample->points_left.asDiagonal();
    MatrixXd change = MatrixXd::Zero(points(), intact_first_.bridge.cols());
    if (first) change = first->bridge - left * intact_first_.bridge;
    const MatrixXd columns =
        enough
            ? columns_of(change, left_of(*sample, first ? &change : nullptr), sample->standing)
            : columns_of(first_widening() * change, MatrixXd::Zero(points(), sample->difference.cols()), 0);
    if (!first) return {left * intact_ + columns, left * intact_first_.epoch};
    return {left * intact_ + columns, first->epoch, first->left};
  }

  /// What is left of epochs, which are not sampled.
  FirstOrderResidual residual() const {
    FirstOrderResidual result;
    if (first_order_) result = first_order_->sensitivities.residuals[state_];
    if (!first_order_) result.epoch = MatrixXd(points(), 0);
    result.bridge = MatrixXd(points(), 0);
    result.share = result.common = 0.0;
    return result;
  }

 private:
  Index points() const { return intact_sample_.difference.rows(); }

  /// What the first order leaves of signals where no samples show it, as ReadingFactors widens it.
  double first_widening() const {
    const FirstOrderResidual& residual = first_order_->sensitivities.residuals[state_];
    return widening(residual.share, residual.common);
  }

  /// Of a scene's signal in each bridge, less what the first order makes of it.
  MatrixXd left_of(const Sample& sample, const MatrixXd* first_order) const {
    MatrixXd left = MatrixXd::Zero(points(), sample.difference.cols());
    for (Index v = 0; v < left.cols(); ++v) {
      if (!sample.stands[static_cast<std::size_t>(v)]) continue;
      left.col(v) =
          sample.difference.col(v) - sample.points_left.cwiseProduct(intact_sample_.difference.col(v));
      if (first_order != nullptr) left.col(v) -= *first_order * first_order_->positions.col(v);
    }
    return left;
  }

  const StateTables& tables_;
  const FirstOrder* first_order_;
  std::size_t state_;
  Sample intact_sample_;
  SceneFactors intact_first_;
  MatrixXd intact_;
};

bool intact_stands(const Database& database, std::int32_t variant, std::size_t state) {
  return standing_row(database.table(variant, state), {}).has_value();
}

/// Variants of which the intact bridge stands wherever the nominal one does.
std::vector<std::int32_t> usable_variants(const Database& database) {
  std::vector<std::int32_t> usable;
  for (std::size_t v = 1; v < database.variant_count(); ++v) {
    const auto variant = static_cast<std::int32_t>(v);
    bool stands = true;
    for (std::size_t state = 0; state < database.states().size(); ++state)
      stands = stands &&
               (intact_stands(database, variant, state) || !intact_stands(database, kNominalVariant, state));
    if (stands) usable.push_back(variant);
  }
  return usable;
}

void require_enough(const Database& database, std::size_t usable, bool alone) {
  const std::size_t least = alone ? kFewestAlone : kFewestBridges;
  if (usable >= least) return;
  const std::string held =
      usable == 0 ? "no sampled bridge" : fmt::format("{} sampled bridge{}", usable, usable == 1 ? "" : "s");
  throw Failure(
      fmt::format("{}: holds {} standing when intact, evidence from variants takes at least {}{}: "
                  "see build-database --variants",
                  database.path().string(), held, least,
                  alone ? fmt::format(" ({} beside sensitivities)", kFewestBridges) : ""));
}

/// Where each of the variants is, from the parameters that it was solved with: the basis is L V with the
/// parameters' correlations L L^T, and theta = L z is at V^T z.
FirstOrder first_order_of(const Database& database, const std::vector<std::int32_t>& variants) {
  const Sensitivities& sensitivities = *database.sensitivities();
  const UncertainParameters uncertain =
      uncertain_parameters(bridge_of(database), description_of(database).uncertainty);
  if (uncertain.all() != sensitivities.parameters)
    throw Failure(
        fmt::format("{}: its sensitivities are of other parameters than its bridge file has: build "
                    "it anew (build-database --force)",
                    database.path().string()));
  const std::vector<VariantParameters>& parameters = database.variants();
  const auto factor = uncertain.correlation_factor.triangularView<Eigen::Lower>();
  const MatrixXd directions = factor.solve(sensitivities.basis);
  FirstOrder result{sensitivities, MatrixXd(sensitivities.basis.cols(), static_cast<Index>(variants.size()))};
  for (std::size_t i = 0; i < variants.size(); ++i)
    result.positions.col(static_cast<Index>(i)) =
        directions.transpose() *
        factor.solve(standardised_parameters(uncertain, parameters.front(),
                                             parameters[static_cast<std::size_t>(variants[i])]));
  return result;
}

/// Those of the first order and of the variants, ascending.
std::vector<Scene> scenes_of(const Sensitivities* first_order, const SceneTable& variant) {
  std::vector<Scene> scenes = first_order ? first_order->scenes : std::vector<Scene>();
  for (std::size_t row = 0; row < variant.rows; ++row) scenes.push_back(variant.scene(row));
  std::ranges::sort(scenes, [](const Scene& a, const Scene& b) {
    return row_order(kNominalVariant, a.removed, kNominalVariant, b.removed) < 0;
  });
  scenes.erase(std::unique(scenes.begin(), scenes.end()), scenes.end());
  return scenes;
}

/// Nothing is known of states in which the intact bridge does not stand.
void add_state(const Database& database, const FirstOrder* first_order,
               const std::vector<std::int32_t>& variants, std::size_t state, Sensitivities& made) {
  if (!intact_stands(database, kNominalVariant, state) ||
      (first_order && !first_order->sensitivities.find(state, {})))
    return;
  StateTables tables{database.table_if_standing(state), {}};
  for (const std::int32_t variant : variants) tables.sampled.push_back(database.table(variant, state));
  const StateFactors factors(tables, first_order, state);
  for (std::size_t i = 0; i < made.scenes.size(); ++i) made.set(state, i, factors(made.scenes[i]));
  made.residuals[state] = factors.residual();
}

/// Calls for what every loss changes in A in every state.
template <class Function>
void for_each_change(const Sensitivities& sensitivities, Function function) {
  for (std::size_t state = 0; state < sensitivities.residuals.size(); ++state)
    for (const Scene& scene : sensitivities.scenes)
      if (const auto own = sensitivities.find(state, scene); own && !scene.removed.empty())
        function(change_of(owned(*own), owned(*sensitivities.find(state, {}))).bridge);
}

/// Turns the samples' columns to their principal directions and puts all columns in the order of what losses
/// change in them: readers take the first ones for what losses have in common.
void order_columns(Index samples, Sensitivities& sensitivities) {
  const Index all = sensitivities.basis.cols(), first = all - samples;
  MatrixXd product = MatrixXd::Zero(samples, samples);
  VectorXd sizes = VectorXd::Zero(all);
  for_each_change(sensitivities, [&](const MatrixXd& change) {
    product.noalias() += change.rightCols(samples).transpose() * change.rightCols(samples);
    sizes.head(first) += change.leftCols(first).colwise().squaredNorm();
  });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(product);
  sizes.tail(samples) = principal.eigenvalues();
  std::vector<Index> order(static_cast<std::size_t>(all));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return sizes[a] > sizes[b]; });
  for (std::size_t place = 0; place < sensitivities.known.size(); ++place) {
    if (!sensitivities.is_known(place)) continue;
    MatrixXd columns = sensitivities.bridge[place];
    columns.rightCols(samples) = (columns.rightCols(samples) * principal.eigenvectors()).eval();
    sensitivities.bridge.own(place) = columns(Eigen::all, order);
  }
  sensitivities.basis = sensitivities.basis(Eigen::all, order).eval();
}

}  // namespace

SampledBridges sampled_bridges(const Database& database) {
  const Sensitivities* const sensitivities = database.sensitivities();
  const std::vector<std::int32_t> variants = usable_variants(database);
  require_enough(database, variants.size(), sensitivities == nullptr);
  const auto samples = static_cast<Index>(variants.size());
  SampledBridges result{variants.size(), sensitivities != nullptr, {}};
  Sensitivities& made = result.sensitivities;
  made.scenes = scenes_of(sensitivities, database.table(variants.front(), 0));
  if (made.scenes.size() < 2)
    throw Failure(
        fmt::format("{}: its sampled bridges are intact ones only, expected their singles: "
                    "build-database --variants {} --scenes singles",
                    database.path().string(), variants.size()));
  std::optional<FirstOrder> first_order;
  made.basis = MatrixXd(0, samples);
  if (sensitivities != nullptr) {
    first_order.emplace(first_order_of(database, variants));
    made.parameters = sensitivities->parameters;
    made.unevenness = sensitivities->unevenness;
    made.load = sensitivities->load;
    made.basis = MatrixXd::Zero(sensitivities->basis.rows(), sensitivities->basis.cols() + samples);
    made.basis.leftCols(sensitivities->basis.cols()) = sensitivities->basis;
  }
  made.make_room(database.states().size(), static_cast<Index>(database.control_points().size()),
                 sensitivities != nullptr ? sensitivities->left.columns() : 0);
  for (std::size_t state = 0; state < database.states().size(); ++state)
    add_state(database, first_order ? &*first_order : nullptr, variants, state, made);
  order_columns(samples, made);
  return result;
}

std::shared_ptr<const SampledBridges> sampled_bridges(const Database& database, ScatterEvidence evidence) {
  if (evidence == ScatterEvidence::first_order) return nullptr;
  return std::make_shared<const SampledBridges>(sampled_bridges(database));
}

}  // namespace voussoir
