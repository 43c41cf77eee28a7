/// @file Adjoint sensitivities. Oracle: central differences of bridges solved anew.

#include "core/statics/sensitivity.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.h"
#include "tests/support/bridges.h"
#include "tools/validation/history.h"

using namespace voussoir;

namespace {

/// Solved so tightly that differences of parameters by 3e-5 standard deviations have six digits. With kept
/// matrices what a search leaves goes with the parameter's step, in loads by up to 3e-6 of the difference.
QuasiStaticSettings tight() {
  QuasiStaticSettings settings;
  settings.tolerance = settings.step_tolerance = 1e-12;
  settings.round_off = 1e-15;
  settings.skips.kept_factors = false;
  return settings;
}

struct Bench {
  Model bridge = test::small_bridge();
  UncertainParameters uncertain = uncertain_parameters(bridge, {});
  QuasiStaticSolver solver{bridge, tight()};
  Coefficients coefficients{solver.system(), bridge.parameters};
  Eigen::MatrixXd readings = reading_columns(bridge, bridge.control_points);
  SensitivitySolver sensitivities{solver.system(), uncertain};

  std::size_t of_bridge() const { return uncertain.of_bridge.size(); }
  std::size_t parameters() const { return of_bridge() + uncertain.of_epoch.size(); }

  /// Where all factors are 1: a joint's own has its mean there.
  Eigen::VectorXd nominal() const {
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters()));
    for (std::size_t i = 0; i < of_bridge(); ++i)
      if (uncertain.of_bridge[i].has_mean_one)
        theta[static_cast<Eigen::Index>(i)] = 0.5 * uncertain.of_bridge[i].parameter.sigma;
    return theta;
  }

  std::vector<validation::NamedStage> stages(const std::string& kind, const Scene& scene) const {
    if (kind == "built") return validation::built(scene).stages;
    Field load = Field::Zero(2, bridge.mesh.node_count());
    load(1, value(bridge.control_points[5].node)) = -2e4;
    return kind == "lost" ? validation::lost(scene).stages
                          : validation::followed_by(validation::lost(scene), "load", load).stages;
  }

  /// `near`: solutions of the same stages to start from.
  std::vector<Solution> solve(const std::vector<validation::NamedStage>& stages, const Eigen::VectorXd& theta,
                              const std::vector<Solution>* near) {
    const Parameters own =
        parameters_at(bridge, uncertain, theta.head(static_cast<Eigen::Index>(of_bridge())));
    std::vector<Solution> solutions;
    solutions.reserve(stages.size());
    for (const validation::NamedStage& next : stages) {
      const Solution* before = solutions.empty() ? nullptr : &solutions.back();
      if (before != nullptr && before->outcome != Outcome::standing) break;
      const Field* start = before != nullptr ? &before->displacement : nullptr;
      if (near != nullptr && next.steps == 1) start = &(*near)[solutions.size()].displacement;
      const Eigen::VectorXd epoch = theta.tail(static_cast<Eigen::Index>(uncertain.of_epoch.size()));
      solutions.push_back(solver.solve(StageTask{.stage = in_epoch(next.stage, bridge, uncertain, epoch),
                                                 .start = start,
                                                 .before = before,
                                                 .parameters = &own,
                                                 .steps = next.steps,
                                                 .keeps_steps = true}));
    }
    return solutions;
  }

  Eigen::MatrixXd derivatives(const std::vector<validation::NamedStage>& stages,
                              const std::vector<Solution>& solutions) {
    SolvedHistory history;
    for (std::size_t i = 0; i < stages.size(); ++i)
      append_stage(solver.system(), coefficients, stages[i].stage, solutions[i], stages[i].steps, history);
    return sensitivities.solve(history, readings).value();
  }
};

bool stand(const std::vector<Solution>& solutions, std::size_t stages) {
  return solutions.size() == stages && solutions.back().outcome == Outcome::standing;
}

/// What is differentiated by what.
struct Draw {
  std::string kind;
  Scene scene;
  Eigen::Index parameter, reading;

  Draw(const Bench& bench, int trial, Random& random)
      : kind(std::vector<std::string>{"built", "lost", "load"}[static_cast<std::size_t>(trial % 3)]) {
    const auto below = [&](Eigen::Index bound) {
      return static_cast<Eigen::Index>(random.below(static_cast<std::uint32_t>(bound)));
    };
    if (trial % 10 != 0) scene.removed = {BlockId{static_cast<std::int32_t>(below(38))}};
    parameter = below(bench.parameters());
    reading = below(bench.readings.cols());
  }
};

double reading_of(const Bench& bench, const std::vector<Solution>& solutions, Eigen::Index reading) {
  return readings_at(bench.bridge.control_points, solutions.back().displacement)[reading];
}

struct Readings {
  double behind, here, ahead;
};

/// The reading at the nominal bridge, and a step of the parameter before and after it.
Readings readings_about(Bench& bench, const Draw& draw, const std::vector<validation::NamedStage>& stages,
                        const std::vector<Solution>& nominal, double step) {
  const auto moved = [&](double way) {
    Eigen::VectorXd there = bench.nominal();
    there[draw.parameter] += way;
    const auto solutions = bench.solve(stages, there, &nominal);
    REQUIRE(stand(solutions, stages.size()));
    return reading_of(bench, solutions, draw.reading);
  };
  return {moved(-step), reading_of(bench, nominal, draw.reading), moved(step)};
}

}  // namespace

TEST_CASE(
    "Adjoint sensitivities are central differences, of built, lost in sixteen steps, and a load after it",
    "[sensitivity][many-solutions]") {
  constexpr double kStep = 3e-5;      // [standard deviations]
  constexpr double kResolved = 1e-9;  // [m] what rounding leaves of a difference is 1e-7 of that
  constexpr int kWanted = 50;
  Bench bench;
  Random random(4);
  int compared = 0, kinks = 0;
  for (int trial = 0; compared < kWanted && trial < 400; ++trial) {
    const Draw draw(bench, trial, random);
    const auto stages = bench.stages(draw.kind, draw.scene);
    const Eigen::VectorXd theta = bench.nominal();
    const auto nominal = bench.solve(stages, theta, nullptr);
    if (!stand(nominal, stages.size())) continue;
    if (std::ranges::any_of(nominal, [](const Solution& one) { return has_slipped(one); }))
      continue;  // what a jump has slid is taken as given
    const Eigen::MatrixXd derivatives = bench.derivatives(stages, nominal);
    const double scale = derivatives.col(draw.parameter).cwiseAbs().maxCoeff();
    if (scale < kResolved) continue;
    const auto [behind, here, ahead] = readings_about(bench, draw, stages, nominal, kStep);
    if (std::isnan(here)) {
      CHECK(derivatives(draw.reading, draw.parameter) == 0.0);
      continue;
    }
    ++compared;
    // Where a joint changes its state within the step, the differences of both sides are not alike.
    if (std::abs((ahead - here) - (here - behind)) > 1e-4 * scale * kStep) {
      ++kinks;
      continue;
    }
    INFO(draw.kind << " " << to_string(draw.scene, bench.bridge.layout) << " "
                   << bench.uncertain.all()[static_cast<std::size_t>(draw.parameter)].name);
    CHECK(std::abs((ahead - behind) / (2.0 * kStep) - derivatives(draw.reading, draw.parameter)) <
          1e-6 * scale);
  }
  CHECK(compared == kWanted);
  CHECK(kinks <= 2);
}

TEST_CASE("Adjoint sensitivities of all that an epoch may do are central differences", "[sensitivity]") {
  constexpr double kStep = 3e-5;  // [standard deviations]
  Bench bench;
  const auto stages = bench.stages("built", parse_scene("5,2", bench.bridge.layout));
  const auto nominal = bench.solve(stages, bench.nominal(), nullptr);
  const Eigen::MatrixXd derivatives = bench.derivatives(stages, nominal);
  const auto vertical_at = [&](Eigen::Index parameter, double way) {
    Eigen::VectorXd there = bench.nominal();
    there[parameter] += way;
    return Eigen::VectorXd(
        readings_at(bench.bridge.control_points, bench.solve(stages, there, &nominal).back().displacement));
  };
  for (std::size_t i = bench.of_bridge(); i < bench.parameters(); ++i) {
    INFO(bench.uncertain.all()[i].name);
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd difference =
        (vertical_at(column, kStep) - vertical_at(column, -kStep)) / (2.0 * kStep);
    const double scale = derivatives.col(column).cwiseAbs().maxCoeff();
    CHECK(scale > 1e-6);
    for (Eigen::Index point = 0; point < difference.size(); ++point)
      if (!std::isnan(difference[point]))
        CHECK(std::abs(difference[point] - derivatives(point, column)) < 1e-6 * scale);
  }
}

TEST_CASE("Sensitivities of what is not there or does not act are zero", "[sensitivity]") {
  Bench bench;
  const Scene scene = parse_scene("5,2", bench.bridge.layout);
  const auto stages = bench.stages("built", scene);
  const Eigen::MatrixXd derivatives =
      bench.derivatives(stages, bench.solve(stages, bench.nominal(), nullptr));
  int gone = 0;
  for (std::size_t i = 0; i < bench.of_bridge(); ++i)
    if (bench.uncertain.of_bridge[i].has_mean_one) {
      const Joint& joint = bench.bridge.joints[bench.uncertain.of_bridge[i].joints.front()];
      if (!scene.lacks(joint.first) && !scene.lacks(joint.second)) continue;
      ++gone;
      CHECK(derivatives.col(static_cast<Eigen::Index>(i)).isZero(0.0));
    }
  CHECK(gone >= 3);
  for (std::size_t i = 0; i < bench.bridge.control_points.size(); ++i)
    if (scene.lacks(bench.bridge.control_points[i].block))
      CHECK(derivatives.row(static_cast<Eigen::Index>(i)).isZero(0.0));
}

TEST_CASE("All joints' own factors together are the common one (sum rule)", "[sensitivity]") {
  Bench bench;
  const auto stages = bench.stages("lost", parse_scene("4,2", bench.bridge.layout));
  const Eigen::MatrixXd derivatives =
      bench.derivatives(stages, bench.solve(stages, bench.nominal(), nullptr));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(derivatives.rows());
  for (std::size_t i = 0; i < bench.of_bridge(); ++i)
    if (bench.uncertain.of_bridge[i].has_mean_one)
      sum += derivatives.col(static_cast<Eigen::Index>(i)) / bench.uncertain.of_bridge[i].parameter.sigma;
  const Eigen::VectorXd common = derivatives.col(0) / bench.uncertain.of_bridge[0].parameter.sigma;
  CHECK((sum - common).cwiseAbs().maxCoeff() < 1e-9 * common.cwiseAbs().maxCoeff());
}

TEST_CASE("Adjoint sensitivities are central differences where joints have slipped beforehand",
          "[sensitivity]") {
  constexpr double kStep = 3e-5;  // [standard deviations]
  Bench bench;
  const Scene scene = parse_scene("4,2", bench.bridge.layout);
  const Eigen::Matrix2Xd slip = Eigen::Matrix2Xd::NullaryExpr(
      2, static_cast<Eigen::Index>(bench.bridge.joints.size()),
      [](Eigen::Index, Eigen::Index joint) { return 2e-6 * std::sin(0.7 * joint); });
  const auto solve = [&](const Eigen::VectorXd& theta) {
    const Parameters own = parameters_at(bench.bridge, bench.uncertain,
                                         theta.head(static_cast<Eigen::Index>(bench.of_bridge())));
    Solution found =
        bench.solver.solve(StageTask{.stage = {.scene = scene}, .slipped = &slip, .parameters = &own});
    REQUIRE(stands(found));
    return found;
  };
  const Solution nominal = solve(bench.nominal());
  CHECK(nominal.slipped == slip);
  SolvedHistory history;
  append_stage(bench.solver.system(), bench.coefficients, {.scene = scene}, nominal, 1, history);
  const Eigen::MatrixXd adjoint = bench.sensitivities.solve(history, bench.readings).value();
  const auto vertical = [&](const Solution& solution) {
    return readings_at(bench.bridge.control_points, solution.displacement);
  };
  int compared = 0;
  for (std::size_t parameter = 0; parameter < bench.of_bridge(); parameter += 7) {
    const auto column = static_cast<Eigen::Index>(parameter);
    Eigen::VectorXd ahead = bench.nominal(), behind = ahead;
    ahead[column] += kStep;
    behind[column] -= kStep;
    const Eigen::VectorXd difference = (vertical(solve(ahead)) - vertical(solve(behind))) / (2.0 * kStep);
    if (difference.cwiseAbs().maxCoeff() < 1e-8) continue;
    INFO(bench.uncertain.of_bridge[parameter].parameter.name);
    CHECK((difference - adjoint.col(column)).cwiseAbs().maxCoeff() < 1e-4 * difference.cwiseAbs().maxCoeff());
    ++compared;
  }
  CHECK(compared > 5);
}
