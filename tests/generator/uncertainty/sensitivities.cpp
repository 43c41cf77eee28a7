/// @file Sensitivities as build-database finds them. Oracles: bridges solved anew with other parameters, the
/// definition of a basis, a build with other threads.

#include "generator/uncertainty/sensitivities.h"

#include <hdf5.h>

#include <catch2/catch.hpp>

#include "core/structure/unevenness.h"
#include "database/format/hdf5_handle.h"
#include "database/records/schema.h"
#include "database/records/stored_bridge.h"
#include "generator/build.h"
#include "generator/uncertainty/first_order_residual.h"
#include "generator/verify/sensitivity_check.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"
#include "tools/validation/history.h"

namespace voussoir {
namespace {

BuildSummary build(const std::filesystem::path& path, int threads, bool known_bridge = false) {
  BuildRequest request;
  request.bridge = test::small_bridge_file();
  request.output = path;
  request.histories = "built,lost";
  request.scenes = "intact;4,*";
  request.threads = threads;
  request.known_bridge = known_bridge;
  Progress quiet(Progress::Mode::quiet);
  return build_database(request, quasi_static(), quiet);
}

/// A little more stiffness of all joints and of those near one of them, beside what makes the mean of others
/// one.
struct Change {
  Eigen::VectorXd nominal, of_bridge, along, of_epoch;  ///< along the basis's directions

  Change(const UncertainParameters& uncertain, const Sensitivities& found)
      : nominal(Eigen::VectorXd::Zero(found.of_bridge())), of_epoch(Eigen::VectorXd::Zero(found.of_epoch())) {
    for (std::size_t i = 0; i < uncertain.of_bridge.size(); ++i)
      if (uncertain.of_bridge[i].has_mean_one)
        nominal[static_cast<Eigen::Index>(i)] = 0.5 * uncertain.of_bridge[i].parameter.sigma;
    Eigen::VectorXd independent = Eigen::VectorXd::Zero(found.of_bridge());
    independent[0] = 1e-3;
    independent[20] = 5e-3;
    of_bridge = uncertain.correlation_factor * independent;
    along = uncertain.correlation_factor.triangularView<Eigen::Lower>().solve(found.basis).transpose() *
            independent;
    of_epoch[0] = 1e-3;
  }
};

/// A central difference of a bridge solved anew, of one standard deviation.
Eigen::VectorXd solved_anew(QuasiStaticSolver& solver, const Model& bridge, const UncertainAction& action) {
  constexpr double step = 1e-4;  // of the stiffness's logarithm, or [K]
  const auto settled = [&](double way) {
    Stage stage{.uneven_temperature = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(bridge.layout.size())),
                .joint_stiffness = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(bridge.joints.size()))};
    for (const std::size_t joint : action.joints)
      stage.joint_stiffness[static_cast<Eigen::Index>(joint)] = std::exp(way);
    for (const std::size_t block : action.blocks)
      stage.uneven_temperature[static_cast<Eigen::Index>(block)] = way;
    const Solution solution = solver.solve(StageTask{.stage = stage});
    REQUIRE(stands(solution));
    return readings_at(bridge.control_points, solution.displacement);
  };
  return action.parameter.sigma * (settled(step) - settled(-step)) / (2.0 * step);
}

Eigen::MatrixXd covariance_anew(QuasiStaticSolver& solver, const Model& bridge,
                                const UnevenQuantity& uneven) {
  Eigen::MatrixXd derivatives(static_cast<Eigen::Index>(bridge.control_points.size()),
                              static_cast<Eigen::Index>(uneven.actions.size()));
  for (std::size_t i = 0; i < uneven.actions.size(); ++i)
    derivatives.col(static_cast<Eigen::Index>(i)) = solved_anew(solver, bridge, uneven.actions[i]);
  return derivatives * uneven.correlations * derivatives.transpose();
}

/// By how much an epoch, which the intact bridge enters before the loss, changes what the loss changes [m];
/// nothing if anything on the way does not stand.
std::optional<Eigen::VectorXd> signal_changed(const Model& bridge, const Stage& epoch, const Scene& scene) {
  QuasiStaticSolver solver(bridge);
  std::vector<validation::NamedStage> stages = {{"", {}}};
  const auto signal_after = [&](Stage loss) -> std::optional<Eigen::VectorXd> {
    const Solution intact = validation::solve_history(solver, {"", stages}).back();
    std::vector<validation::NamedStage> lost = stages;
    loss.scene = scene;
    lost.push_back({"", loss});
    const Solution single = validation::solve_history(solver, {"", lost}).back();
    if (!stands(intact) || !stands(single)) return std::nullopt;
    return readings_at(bridge.control_points, single.displacement) -
           readings_at(bridge.control_points, intact.displacement);
  };
  const auto at_rest = signal_after({});
  for (int part = 1; part <= kPartsOfEpoch; ++part)
    stages.push_back({"", on_the_way({}, epoch, static_cast<double>(part) / kPartsOfEpoch)});
  const auto in_epoch = signal_after(epoch);
  if (!at_rest || !in_epoch) return std::nullopt;
  return *in_epoch - *at_rest;
}

}  // namespace

TEST_CASE("A database's sensitivities predict what a little more stiffness and heat do (solved anew)",
          "[sensitivity][many-solutions]") {
  const test::TemporaryFolder folder;
  build(folder / "small.h5", 2);
  const Database database = Database::open(folder / "small.h5");
  const Sensitivities* found = database.sensitivities();
  REQUIRE(found != nullptr);
  const Model bridge = test::small_bridge();
  const UncertainParameters uncertain = uncertain_parameters(bridge, {});
  CHECK(found->parameters == uncertain.all());
  const Change change(uncertain, *found);
  const Parameters parameters = parameters_at(bridge, uncertain, change.nominal + change.of_bridge);
  QuasiStaticSolver solver(bridge);
  int compared = 0;
  for (const Scene& scene : found->scenes)
    for (const auto& [name, history] :
         {std::pair{"built", validation::built(scene)}, std::pair{"lost", validation::lost(scene)}}) {
      const std::size_t state = *database.find_state(name);
      const auto factors = found->find(state, scene);
      if (!factors || found->find_fall(state, scene)) continue;
      validation::History moved = history;
      for (validation::NamedStage& stage : moved.stages)
        stage.stage = in_epoch(stage.stage, bridge, uncertain, change.of_epoch);
      const auto solutions = validation::solve_history(solver, moved, &parameters);
      REQUIRE(solutions.back().outcome == Outcome::standing);
      const Eigen::VectorXd now = readings_at(bridge.control_points, solutions.back().displacement);
      const auto table = database.table(kNominalVariant, state);
      const auto row = table.row(*database.find(scene));
      const Eigen::VectorXd before = Eigen::Map<const Eigen::VectorXd>(row.data(), now.size());
      const Eigen::VectorXd predicted = factors->bridge * change.along + factors->epoch * change.of_epoch;
      Eigen::VectorXd error = now - before - predicted;
      error = error.array().isNaN().select(0.0, error);
      INFO(name << " " << to_string(scene, bridge.layout));
      CHECK(error.norm() < 0.02 * predicted.norm());  // what the basis leaves out and the second order
      ++compared;
    }
  CHECK(compared >= 8);
}

TEST_CASE("Unevenness is what single joints and blocks do, as far as they vary together (solved anew)",
          "[sensitivity][many-solutions]") {
  const test::TemporaryFolder folder;
  build(folder / "small.h5", 2);
  const Database database = Database::open(folder / "small.h5");
  const std::vector<Eigen::MatrixXd>& found = database.sensitivities()->unevenness;
  REQUIRE(found.size() == 2);
  const Model bridge = test::small_bridge();
  const Unevenness uneven = unevenness_of(bridge, {});
  QuasiStaticSettings exact;
  exact.tolerance = 1e-11;
  QuasiStaticSolver solver(bridge, exact);
  const Eigen::MatrixXd of_joints = covariance_anew(solver, bridge, uneven.stiffness),
                        of_heat = covariance_anew(solver, bridge, uneven.temperature);
  CHECK(of_joints.norm() > 0.01 * of_heat.norm());  // neither is hidden by the other
  for (const Eigen::MatrixXd& one : found)          // the intact bridge is the same before and after a loss
    for (const Eigen::MatrixXd& other : found)
      CHECK((one * other.transpose() - of_joints - of_heat).norm() < 1e-5 * of_joints.norm());
}

TEST_CASE("What is left of signals is what sampled bridges show beyond the first order (each by itself)",
          "[sensitivity][many-solutions]") {
  const test::TemporaryFolder folder;
  build(folder / "small.h5", 2);
  const Database database = Database::open(folder / "small.h5");
  const Sensitivities& found = *database.sensitivities();
  const std::size_t state = *database.find_state("lost");
  const Model nominal = test::small_bridge();
  const UncertainParameters uncertain = uncertain_parameters(nominal, {});
  int compared = 0;
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{kBridgesWithSingles - 1}}) {
    const SampledBridge sample = draw_bridge(nominal, uncertain, kFirstSampledSeed + number);
    for (std::size_t i = 1; i < found.scenes.size(); ++i) {
      const auto factors = found.find(state, found.scenes[i]);
      const auto changed =
          signal_changed(with_parameters(nominal, sample.parameters), sample.epoch, found.scenes[i]);
      if (!factors || found.find_fall(state, found.scenes[i])) continue;
      const Eigen::VectorXd left = factors->left.col(static_cast<Eigen::Index>(number));
      CHECK(left.isZero() == !changed);
      if (!changed) continue;
      const Eigen::MatrixXd slope = factors->epoch - found.find(state, {})->epoch;
      Eigen::VectorXd expected =
          (*changed - slope * sample.of_epoch) / std::sqrt(static_cast<double>(kBridgesWithSingles));
      expected = changed->array().isNaN().select(0.0, expected);
      CHECK((left - expected).cwiseAbs().maxCoeff() < 1e-4 * expected.cwiseAbs().maxCoeff() + 1e-9);
      ++compared;
    }
  }
  CHECK(compared >= 6);
}

TEST_CASE("Sensitivities and digest are the same for all numbers of threads",
          "[sensitivity][many-solutions]") {
  const test::TemporaryFolder folder;
  CHECK(build(folder / "one.h5", 1).digest == build(folder / "three.h5", 3).digest);
}

TEST_CASE("A bridge that is said to be known has no sensitivities; without that word it gets them",
          "[sensitivity]") {
  const test::TemporaryFolder folder;
  build(folder / "small.h5", 2, true);
  CHECK(Database::open(folder / "small.h5").sensitivities() == nullptr);
  CHECK(build(folder / "small.h5", 2, true).up_to_date);
  const BuildSummary again = build(folder / "small.h5", 2);
  CHECK_FALSE(again.up_to_date);
  CHECK(again.computed == 0);
  CHECK(Database::open(folder / "small.h5").sensitivities() != nullptr);
  CHECK(build(folder / "small.h5", 2).up_to_date);
}

TEST_CASE("A file of before what is left of signals was kept is made again from its own records",
          "[sensitivity]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "small.h5";
  const std::string digest = build(path, 2).digest;
  {
    const auto lock = lock_hdf5();
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    REQUIRE(H5Ldelete(file.get(), dataset::kSignalLeft, H5P_DEFAULT) >= 0);
  }
  CHECK(Database::open(path).sensitivities()->left.columns() == 0);
  const BuildSummary again = build(path, 2);
  CHECK_FALSE(again.up_to_date);
  CHECK(again.computed == 0);
  CHECK(again.digest == digest);
  CHECK(Database::open(path).sensitivities()->left.columns() == kBridgesWithSingles);
  CHECK(build(path, 2).up_to_date);
}

TEST_CASE("The basis is of orthonormal directions and leaves little of every kind (definition)",
          "[sensitivity]") {
  constexpr Eigen::Index kParameters = 40;  // more than there are readings
  const Eigen::MatrixXd factor =
      Eigen::MatrixXd::NullaryExpr(kParameters, kParameters, [](Eigen::Index i, Eigen::Index j) {
        return i < j    ? 0.0
               : i == j ? 1.0 + 0.1 * static_cast<double>(i)
                        : 0.3 * std::cos(static_cast<double>(2 * i + j));
      });
  Derivatives derivatives(1);
  for (int scene = 0; scene < 5; ++scene) {
    Eigen::MatrixXd one(6, kParameters + 2);
    for (Eigen::Index i = 0; i < one.size(); ++i)
      one.data()[i] =
          1e-4 * std::sin(1.3 * static_cast<double>(i) + 0.4 * scene * static_cast<double>(i % 7));
    derivatives[0].push_back(one);
  }
  const Eigen::MatrixXd basis = factor.inverse() * sensitivity_basis(derivatives, factor);
  CHECK((basis.transpose() * basis - Eigen::MatrixXd::Identity(basis.cols(), basis.cols())).norm() < 1e-12);
  const auto left = [&](const Eigen::MatrixXd& all) {
    const Eigen::MatrixXd own = all.leftCols(kParameters) * factor;
    return (own - own * basis * basis.transpose()).eval();
  };
  CHECK(left(derivatives[0][0]).norm() < 10.0 * kLeastDeviation);
  double share = 0.0;
  for (std::size_t i = 1; i < 5; ++i) {
    const Eigen::MatrixXd signal = derivatives[0][i] - derivatives[0][0];
    share += left(signal).squaredNorm() / (signal.leftCols(kParameters) * factor).squaredNorm() / 4.0;
  }
  CHECK(share <= kLeftOfSignals * (1.0 + 1e-9));
  CHECK(sensitivity_basis(derivatives, factor, 1) == sensitivity_basis(derivatives, factor, 3));
}

TEST_CASE("The basis of a bridge that does not depend on its parameters has no directions", "[sensitivity]") {
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(6, 12);
  const Eigen::MatrixXd independent = Eigen::MatrixXd::Identity(10, 10);
  CHECK(sensitivity_basis({{nothing, nothing}}, independent).cols() == 0);
  CHECK(sensitivity_basis({{Eigen::MatrixXd(), nothing}}, independent).cols() == 0);
}

TEST_CASE("Stored sensitivities are those of the fields, and changed ones are found",
          "[sensitivity][many-solutions]") {
  const test::TemporaryFolder folder;
  build(folder / "small.h5", 2);
  const Database database = Database::open(folder / "small.h5");
  const Model bridge = bridge_of(database);
  const StatePlan plan = plan_states(database.states(), bridge, description_of(database));
  BridgeDescription description = description_of(database);
  const SensitivityCheck right = check_sensitivities(database, bridge, description, plan);
  CHECK(right.scenes == kCheckedSensitivities);
  CHECK(right.problems.empty());
  description.uncertainty.young_modulus = 0.3;
  CHECK(check_sensitivities(database, bridge, description, plan).problems.size() >= 4);
}

TEST_CASE(
    "Where no signal can be compared the first order counts as wrong by as much as it says (one block)") {
  const test::TemporaryFolder folder;
  BuildRequest request;
  request.bridge = parse_bridge_file(
      "spans = []\n[wall]\nlength_m = 1\ncourses = 1\nbond = \"stack\"\n[supports]\nsides = \"free\"\n",
      "one");
  request.output = folder / "one.h5";
  request.scenes = "intact";
  Progress quiet(Progress::Mode::quiet);
  build_database(request, quasi_static(), quiet);
  const Database database = Database::open(request.output);
  REQUIRE(database.sensitivities() != nullptr);
  const FirstOrderResidual& left = database.sensitivities()->residuals.at(0);
  CHECK(std::array{left.share, left.common, left.epoch_share, left.epoch_common} ==
        std::array{1.0, 0.0, 1.0, 0.0});
}

}  // namespace voussoir
