#pragma once
/// @file Databases of the small bridge, as built and as lost, with sampled bridges that are made up.

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "core/random.h"
#include "core/structure/uncertain_parameters.h"
#include "database/records/database.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir::test {

inline constexpr std::size_t kStates = 2;
inline const Scene kIntact;

inline Scene single(int block) {
  return {{BlockId{block}}};
}

/// The small bridge as the database has it, with its uncertain parameters.
inline const Model& stored_bridge() {
  static const Model bridge = make_model(small_bridge_file().description);
  return bridge;
}
inline const UncertainParameters& uncertain_of_stored_bridge() {
  static const UncertainParameters uncertain =
      uncertain_parameters(stored_bridge(), small_bridge_file().description.uncertainty);
  return uncertain;
}

/// A number between -1 and 1 for each of them, the same each time.
inline double number_of(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  Random random(series_seed(series_seed(series_seed(series_seed(11, a), b), c), d));
  return 2.0 * random.uniform() - 1.0;
}

inline std::size_t block_of(const Scene& scene) {
  return scene.removed.empty() ? 0 : 1 + static_cast<std::size_t>(value(scene.removed.back()));
}

/// What every variant has values of its own of: stiffness ratio, friction, Young's modulus and density, which
/// lie beside each other, and one joint that is stiffer as another one is softer.
inline constexpr Eigen::Index kFirstVaried = 1, kVaried = 5;

/// The basis: the parameters along these directions of independent ones, each of norm 1.
inline Eigen::MatrixXd varied_basis() {
  const Eigen::MatrixXd& factor = uncertain_of_stored_bridge().correlation_factor;
  Eigen::VectorXd joints = Eigen::VectorXd::Zero(factor.rows());
  joints[kFirstVaried + kVaried + 7] = 1.0;
  joints[kFirstVaried + kVaried + 20] = -1.0;
  Eigen::MatrixXd basis =
      Eigen::MatrixXd::Identity(factor.rows(), factor.rows()).middleCols(kFirstVaried, kVaried);
  basis.rightCols(1) = joints / factor.fullPivLu().solve(joints).norm();
  return basis;
}

/// Where a variant is along them.
inline Eigen::VectorXd position_of(std::int32_t variant) {
  return Eigen::VectorXd::NullaryExpr(kVaried, [&](Eigen::Index i) {
    return variant == kNominalVariant
               ? 0.0
               : 1.5 * number_of(static_cast<std::size_t>(variant), 3, 3, static_cast<std::size_t>(i));
  });
}

inline Eigen::VectorXd theta_of(std::int32_t variant) {
  return varied_basis() * position_of(variant);
}

/// How a variant differs from the nominal bridge at a control point in a state [m].
using Difference = std::function<double(const RecordKey& key, std::size_t state, Eigen::Index point)>;

struct Making {
  std::size_t variants = 12;  ///< beside the nominal one
  Difference difference{};
  std::optional<Sensitivities> first_order{};
  std::function<bool(const RecordKey& key)> falls = [](const RecordKey&) { return false; };
  int most_missing = 1;
};

inline Solution made_up_state(const Making& making, const RecordKey& key, std::size_t state) {
  Solution solution = made_up_solution(stored_bridge(), key.scene);
  solution.outcome = making.falls(key) ? Outcome::collapsed : Outcome::standing;
  solution.moving.clear();
  if (making.falls(key)) solution.moving = {BlockId{0}};
  solution.extent = collapse_extent(stored_bridge().layout, solution.moving);
  solution.origin = Origin::solved;
  Field field = solution.displacement;
  const auto& points = stored_bridge().control_points;
  for (std::size_t i = 0; i < points.size() && key.variant != kNominalVariant; ++i)
    field(1, value(points[i].node)) += making.difference(key, state, static_cast<Eigen::Index>(i));
  solution.displacement = to_storage_precision(field);
  return solution;
}

/// A database of the small bridge, as built and as lost.
class Site {
 public:
  explicit Site(const Making& making) : database_(make(making)) {}
  const Database& database() const { return database_; }

 private:
  Database make(const Making& making) const {
    const std::vector<Scene> scenes = all_scenes(stored_bridge().layout.size(), making.most_missing);
    DatabaseContent content = made_up_content(small_bridge_file(), stored_bridge(), scenes, KeepField::no,
                                              1 + making.variants, kStates);
    content.states = {kBuiltState, kLostState};
    content.sensitivities = making.first_order;
    for (std::size_t v = 1; v < content.variants.size(); ++v)
      content.variants[v] = variant_parameters(parameters_at(stored_bridge(), uncertain_of_stored_bridge(),
                                                             theta_of(static_cast<std::int32_t>(v))));
    write_database(folder_ / "made-up.h5", content, [&](std::size_t row) {
      std::vector<Solution> solutions;
      for (std::size_t state = 0; state < kStates; ++state)
        solutions.push_back(made_up_state(making, content.keys[row], state));
      return make_record(content.keys[row], solutions, stored_bridge().control_points, KeepField::no,
                         KeepField::no);
    });
    return Database::open(folder_ / "made-up.h5");
  }

  TemporaryFolder folder_;
  Database database_;
};

/// What all scenes of a variant have in common, and a fifth of it in each scene of its own.
inline double scattered(const RecordKey& key, std::size_t state, Eigen::Index point) {
  const auto variant = static_cast<std::size_t>(key.variant), at = static_cast<std::size_t>(point);
  const double own = key.scene.removed.empty() ? 0.0 : number_of(variant, state, at, block_of(key.scene));
  return 1e-4 * (number_of(variant, 0, at, 0) + 0.2 * own);
}

/// A first order that varies from scene to scene, zero where a block is gone; it leaves a little.
inline Sensitivities first_order_of_stored_bridge() {
  const auto& points = stored_bridge().control_points;
  const auto p = static_cast<Eigen::Index>(points.size());
  const auto epoch = static_cast<Eigen::Index>(uncertain_of_stored_bridge().of_epoch.size());
  Sensitivities made;
  made.parameters = uncertain_of_stored_bridge().all();
  made.basis = varied_basis();
  made.scenes = all_scenes(stored_bridge().layout.size(), 1);
  constexpr Eigen::Index samples = 2;
  made.make_room(kStates, p, samples);
  for (std::size_t state = 0; state < kStates; ++state) {
    for (std::size_t k = 0; k < made.scenes.size(); ++k) {
      const Scene& scene = made.scenes[k];
      const std::size_t block = block_of(scene);
      const auto number = [&](std::size_t kind, Eigen::Index i, Eigen::Index j) {
        if (scene.lacks(points[static_cast<std::size_t>(i)].block)) return 0.0;
        const auto column = kind + static_cast<std::size_t>(j), at = static_cast<std::size_t>(i);
        return 1e-4 * (number_of(column, 0, at, 0) +
                       (block == 0 ? 0.0 : 0.2 * number_of(column, 1 + state, at, block)));
      };
      SceneFactors factors;
      factors.bridge = Eigen::MatrixXd::NullaryExpr(
          p, kVaried, [&](Eigen::Index i, Eigen::Index j) { return number(1000, i, j); });
      factors.epoch = Eigen::MatrixXd::NullaryExpr(
          p, epoch, [&](Eigen::Index i, Eigen::Index j) { return number(2000, i, j); });
      factors.left = Eigen::MatrixXd::NullaryExpr(
          p, samples, [&](Eigen::Index i, Eigen::Index j) { return block == 0 ? 0.0 : number(3000, i, j); });
      made.set(state, k, factors);
    }
    made.residuals[state] = {
        Eigen::MatrixXd::Constant(p, 1, 1e-5), Eigen::MatrixXd::Constant(p, 1, 1e-5), 0.3, 0.4, 0.1, 0.2};
  }
  return made;
}

inline Eigen::VectorXd shown(const Database& database, std::int32_t variant, std::size_t state,
                             const Scene& scene) {
  const SceneTable table = database.table(variant, state);
  const auto row = table.row(table.find(scene).value());
  const Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(row.data(), static_cast<Eigen::Index>(row.size()));
  return values.array().isNaN().select(0.0, values);
}

/// How far a variant is from the nominal bridge: of the intact bridge's displacements, then of the scene's
/// signal, which is zero where its block is gone [m].
inline Eigen::VectorXd difference_of(const Database& database, std::int32_t variant, std::size_t state,
                                     const Scene& scene) {
  const Eigen::VectorXd gone = shown(database, kNominalVariant, state, scene);
  const auto signal = [&](std::int32_t of) -> Eigen::VectorXd {
    return (gone.array() == 0.0)
        .select(0.0, shown(database, of, state, scene) - shown(database, of, state, kIntact));
  };
  Eigen::VectorXd difference(2 * gone.size());
  difference << shown(database, variant, state, kIntact) - shown(database, kNominalVariant, state, kIntact),
      signal(variant) - signal(kNominalVariant);
  return difference;
}

/// The first order's columns in the same rows.
inline Eigen::MatrixXd columns_of(const Sensitivities& from, std::size_t state, const Scene& scene,
                                  double widening = 1.0) {
  const Eigen::MatrixXd intact = from.find(state, kIntact)->bridge, own = from.find(state, scene)->bridge;
  const Eigen::Index p = intact.rows();
  Eigen::MatrixXd columns(2 * p, intact.cols());
  columns << intact, widening * (own - intact);
  for (Eigen::Index i = 0; i < p; ++i)
    if (own.row(i).isZero(0.0)) columns.row(p + i).setZero();
  return columns;
}

}  // namespace voussoir::test
