#include "core/statics/quasi_static_solver.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/statics/equilibrium.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

double vertical_mm(const Model& bridge, const Solution& solution, const std::string& point) {
  for (const ControlPoint& p : bridge.control_points)
    if (p.name == point) return 1e3 * solution.displacement(1, value(p.node));
  throw std::runtime_error("no point " + point);
}

Eigen::VectorXd control_displacements(const Model& bridge, QuasiStaticSolver& solver,
                                      const std::string& scene) {
  const Solution solution = solver.solve(parse_scene(scene, bridge.layout));
  REQUIRE(solution.outcome == Outcome::standing);
  const Eigen::VectorXd d = readings_at(bridge.control_points, solution.displacement);
  return d.array().isNaN().select(0.0, d);
}

/// Forces that a block of the bridge, which nothing came before, gives the nodes of its neighbours [N].
Field carried_by(const Model& bridge, const State& state, BlockId block) {
  Field forces = Field::Zero(2, bridge.mesh.node_count());
  for (std::size_t j = 0; j < bridge.joints.size(); ++j) {
    const Joint& joint = bridge.joints[j];
    if (joint.first != block && joint.second != block) continue;
    const std::array<NodeId, 4> nodes = {joint.first_edge.from, joint.first_edge.to, joint.second_edge.from,
                                         joint.second_edge.to};
    Vector8d q;
    for (int i = 0; i < 4; ++i)
      q.segment<2>(2 * i) = state.displacement.col(value(nodes[static_cast<std::size_t>(i)]));
    const JointKinematics kinematics = joint_kinematics(make_joint_frame(joint, bridge.mesh), q);
    const double area = joint.length * joint_thickness(joint, bridge.parameters);
    const Vector8d nodal =
        -kinematics.gradient.transpose() *
        integrate_joint(joint_stiffness(bridge.parameters.joints[j], area), {}, kinematics.state).force;
    for (int i = joint.first == block ? 2 : 0, last = i + 2; i < last; ++i)
      forces.col(value(nodes[static_cast<std::size_t>(i)])) += nodal.segment<2>(2 * i);
  }
  return forces;
}

}  // namespace

TEST_CASE("The intact reference bridge has the published displacements within half a per cent", "[solver]") {
  const Model bridge = test::reference_bridge();
  const Solution solution = QuasiStaticSolver(bridge).solve(Scene{});
  REQUIRE(solution.outcome == Outcome::standing);
  CHECK(solution.iterations <= 8);
  // Oracle: an independent refined finite element contact model.
  CHECK(vertical_mm(bridge, solution, "T20") == Approx(-3.621).epsilon(0.005));
  CHECK(vertical_mm(bridge, solution, "T21") == Approx(-3.621).epsilon(0.005));
  for (const char* end : {"T1", "T2", "T3", "T4", "T5"})
    CHECK(vertical_mm(bridge, solution, end) == Approx(-0.78).margin(0.005));
}

TEST_CASE("Displacements are nearly proportional to the joints' compliance", "[solver]") {
  BridgeDescription soft;
  soft.joints.normal_stiffness = 1e8;
  soft.joints.tangential_stiffness = 1e7;
  const Model bridge = make_model(soft);
  const Solution solution = QuasiStaticSolver(bridge).solve(Scene{});
  // Published for p_n = 1e8: 7.7 mm at the ends and 36 mm at the centre.
  CHECK(vertical_mm(bridge, solution, "T1") == Approx(-7.7).epsilon(0.01));
  CHECK(vertical_mm(bridge, solution, "T20") == Approx(-36.0).epsilon(0.02));
}

TEST_CASE(
    "A bridge on joints so soft that it sags by more than the limit of a fall stands (equilibrium anew)",
    "[solver]") {
  BridgeDescription soft;
  soft.joints.normal_stiffness = 1e7;
  soft.joints.tangential_stiffness = 1e6;
  const Model bridge = make_model(soft);
  const Solution solution = QuasiStaticSolver(bridge).solve(Scene{});
  CHECK(solution.outcome == Outcome::standing);
  CHECK(solution.displacement.cwiseAbs().maxCoeff() > QuasiStaticSettings{}.collapse_displacement);
  CHECK(unbalanced_force(bridge, Scene{}, solution.displacement) < 1e-7);
}

TEST_CASE("Loads too small to be squared are carried like any other (proportionality)", "[solver]") {
  BridgeDescription description = test::small_description();
  const Scene scene = parse_scene("4,2", test::small_bridge().layout);
  description.gravity = 1.0;
  const Model usual_bridge = make_model(description);
  const Solution usual = QuasiStaticSolver(usual_bridge).solve(scene);
  description.gravity = 1e-300;
  const Model bridge = make_model(description);
  const Solution tiny = QuasiStaticSolver(bridge).solve(scene);
  REQUIRE(tiny.outcome == Outcome::standing);
  const Field scaled = without_nan(usual.displacement) * 1e-300;
  // Turns and strains of 1e-5 under usual gravity make the answer depart from proportionality by a few of
  // them.
  CHECK((without_nan(tiny.displacement) - scaled).cwiseAbs().maxCoeff() <
        2e-4 * scaled.cwiseAbs().maxCoeff());
}

TEST_CASE("A dead load equal to the weight does what twice the gravity does (superposition of loads)",
          "[solver]") {
  const Model once = test::small_bridge();
  Field weight = Field::Zero(2, once.mesh.node_count());
  weight.row(1) = -Coefficients(EquilibriumSystem(once), once.parameters).weight.transpose();
  const Scene scene = parse_scene("4,2", once.layout);
  QuasiStaticSolver solver(once);
  const Field loaded = without_nan(solver.solve({.stage = {.scene = scene, .load = weight}}).displacement);
  Parameters twice = once.parameters;
  twice.gravity *= 2.0;
  const Field heavy =
      without_nan(solver.solve({.stage = {.scene = scene}, .parameters = &twice}).displacement);
  CHECK((loaded - heavy).cwiseAbs().maxCoeff() < 1e-9 * heavy.cwiseAbs().maxCoeff());
}

TEST_CASE("A stage in two steps lets go what a lost block's joints carried, half by half (brute force)",
          "[solver]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  const Solution intact = solver.solve(Scene{});
  const Scene scene = parse_scene("10,12", bridge.layout);
  const Stage whole{.scene = scene};
  const Solution steps =
      solver.solve({.stage = whole, .start = &intact.displacement, .before = &intact, .steps = 2});

  const Stage half{.scene = scene, .load = 0.5 * carried_by(bridge, intact, scene.removed.front())};
  const Solution first = solver.solve({.stage = half, .start = &intact.displacement, .before = &intact});
  const Solution second = solver.solve({.stage = whole, .start = &first.displacement, .before = &first});
  REQUIRE(steps.outcome == Outcome::standing);
  REQUIRE(second.outcome == Outcome::standing);
  CHECK(steps.iterations > std::max(first.iterations, second.iterations));
  CHECK(steps.iterations <= first.iterations + second.iterations);  // the first ends sooner
  const Field expected = without_nan(second.displacement);
  // Newton leaves 1e-8 of a node's load unbalanced.
  CHECK((without_nan(steps.displacement) - expected).cwiseAbs().maxCoeff() <
        1e-8 * expected.cwiseAbs().maxCoeff());
  const Solution once = solver.solve({.stage = whole, .start = &intact.displacement, .before = &intact});
  CHECK((without_nan(once.displacement) - expected).cwiseAbs().maxCoeff() >
        1e-4 * expected.cwiseAbs().maxCoeff());  // a sliver slides on the way and stops
}

TEST_CASE("Stages of one, two and more steps side by side have the bits of each alone", "[solver]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  const Solution intact = solver.solve(Scene{});
  std::vector<StageTask> tasks;
  for (const char* text : {"4,2", "0,5", "5,5", "3,2", "2,1", "4,4"})
    tasks.push_back({.stage = {.scene = parse_scene(text, bridge.layout)},
                     .start = &intact.displacement,
                     .before = &intact,
                     .steps = 1 + static_cast<int>(tasks.size()) % 3});
  const std::vector<Solution> together = solver.solve(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Solution alone = solver.solve(tasks[i]);
    INFO(to_string(tasks[i].stage.scene, bridge.layout));
    CHECK(alone.outcome == together[i].outcome);
    CHECK(alone.iterations == together[i].iterations);
    CHECK(alone.memory == together[i].memory);
    CHECK(without_nan(alone.displacement) == without_nan(together[i].displacement));
  }
}

TEST_CASE("Kept factors change no field of a later stage (the tangent factorised anew in every step)",
          "[solver]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSettings settings;
  settings.step_tolerance = settings.tolerance;
  QuasiStaticSolver keeping(bridge, settings);
  settings.skips.kept_factors = false;
  QuasiStaticSolver renewing(bridge, settings);
  const Solution intact = keeping.solve(Scene{});
  CHECK(intact.displacement == renewing.solve(Scene{}).displacement);  // the first stage keeps none
  std::vector<StageTask> tasks;
  for (const char* text : {"10,4", "10,12", "8,8", "4,2+11,3", "4,10+2,6", "6,4+7,7"})
    tasks.push_back({.stage = {.scene = parse_scene(text, bridge.layout)},
                     .start = &intact.displacement,
                     .before = &intact,
                     .steps = 1 + 3 * (static_cast<int>(tasks.size()) % 2)});
  const std::vector<Solution> kept = keeping.solve(tasks);
  const std::vector<Solution> renewed = renewing.solve(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    INFO(to_string(tasks[i].stage.scene, bridge.layout));
    REQUIRE(kept[i].outcome == Outcome::standing);
    REQUIRE(renewed[i].outcome == Outcome::standing);
    CHECK(kept[i].iterations != renewed[i].iterations);
    const Field expected = without_nan(renewed[i].displacement);
    // Either leaves 1e-8 of a node's load unbalanced.
    CHECK((without_nan(kept[i].displacement) - expected).cwiseAbs().maxCoeff() <
          1e-8 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("What a loss's steps leave unbalanced is let go in the next (all steps as balanced as the last)",
          "[solver][many-solutions]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSettings settings;
  QuasiStaticSolver usual(bridge, settings);
  settings.step_tolerance = settings.tolerance;
  QuasiStaticSolver strict(bridge, settings);
  const Solution intact = usual.solve(Scene{});
  for (const char* text : {"10,4", "10,12", "10,3+11,4", "4,10+2,6"}) {
    INFO(text);
    const StageTask task{.stage = {.scene = parse_scene(text, bridge.layout)},
                         .start = &intact.displacement,
                         .before = &intact,
                         .steps = 16};
    const Solution found = usual.solve(task), expected = strict.solve(task);
    REQUIRE(found.outcome == Outcome::standing);
    CHECK(found.residual <= settings.tolerance);
    const Field change = without_nan(expected.displacement) - without_nan(intact.displacement);
    CHECK((without_nan(found.displacement) - without_nan(expected.displacement)).lpNorm<1>() <
          1e-4 * change.lpNorm<1>());
    CHECK(found.iterations < 0.9 * expected.iterations);
  }
}

TEST_CASE("A mirrored scene has the mirrored field", "[solver]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  for (const char* name : {"intact", "10,4", "2,6", "4,10+2,6", "10,12"}) {
    const Scene scene = parse_scene(name, bridge.layout);
    const Field direct = without_nan(solver.solve(mirrored(scene, *bridge.symmetry)).displacement);
    const Field image = without_nan(mirrored(solver.solve(scene).displacement, *bridge.symmetry));
    INFO(name);
    CHECK((direct - image).cwiseAbs().maxCoeff() < 1e-12 * image.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("Every wall single of the reference bridge stands, no arch single does",
          "[solver][many-solutions]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  const Solution intact = solver.solve(Scene{});
  for (const Scene& scene : all_scenes(bridge.layout.size(), 1)) {
    INFO(to_string(scene, bridge.layout));
    const bool lacks_arch_block =
        scene.missing() == 1 && bridge.layout[scene.removed[0]].role == BlockRole::ring;
    const Solution solution = solver.solve({.stage = {.scene = scene}, .start = &intact.displacement});
    CHECK((solution.outcome == Outcome::standing) == !lacks_arch_block);
    if (solution.outcome == Outcome::standing)
      CHECK(unbalanced_force(bridge, scene, solution.displacement) < 1e-7);
  }
}

TEST_CASE("Pairs that need care in the search stand (equilibrium anew)", "[solver]") {
  const Model bridge = test::reference_bridge();
  QuasiStaticSolver solver(bridge);
  for (const char* name : {"10,4+10,12", "9,8+9,11", "4,2+11,3", "4,10+2,6"}) {
    const Scene scene = parse_scene(name, bridge.layout);
    const Solution solution = solver.solve(scene);
    INFO(name);
    CHECK(solution.outcome == Outcome::standing);
    CHECK(unbalanced_force(bridge, scene, solution.displacement) < 1e-7);
  }
}

TEST_CASE("The answer depends on the scene, not on the start or on earlier scenes", "[solver]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  const Scene scene = parse_scene("4,2", bridge.layout);
  const Field first = without_nan(solver.solve(scene).displacement);
  const Field intact = solver.solve(Scene{}).displacement;
  solver.solve(parse_scene("0,5", bridge.layout));
  CHECK((without_nan(solver.solve(scene).displacement) - first).norm() == 0.0);
  const Field warm = without_nan(solver.solve({.stage = {.scene = scene}, .start = &intact}).displacement);
  CHECK((warm - first).cwiseAbs().maxCoeff() < 1e-9 * first.cwiseAbs().maxCoeff());
}

TEST_CASE("A removed block has no displacement and the others have one", "[solver]") {
  const Model bridge = test::small_bridge();
  const Scene scene = parse_scene("5,2", bridge.layout);
  const Solution solution = QuasiStaticSolver(bridge).solve(scene);
  const IndexRange gone = bridge.mesh.block_nodes[static_cast<std::size_t>(value(scene.removed[0]))];
  CHECK(solution.displacement.middleCols(gone.begin, gone.size()).array().isNaN().all());
  CHECK(solution.displacement.array().isNaN().count() == 2 * gone.size());
}

TEST_CASE("The signal of a removal is within two per cent of the converged answer",
          "[solver][many-solutions]") {
  // Oracle: the same bridge with two more levels of refinement (16 times the triangles).
  BridgeDescription fine_description;
  fine_description.mesh.refinement = 2;
  const Model fine = make_model(fine_description);
  const Model usual = test::reference_bridge();
  QuasiStaticSolver fine_solver(fine);
  QuasiStaticSolver usual_solver(usual);
  const Eigen::VectorXd fine_intact = control_displacements(fine, fine_solver, "intact");
  const Eigen::VectorXd usual_intact = control_displacements(usual, usual_solver, "intact");
  CHECK((usual_intact - fine_intact).lpNorm<1>() < 0.002 * fine_intact.lpNorm<1>());
  for (const char* scene : {"10,4", "6,4", "2,6", "4,10", "8,12", "10,12"}) {
    const Eigen::VectorXd exact = control_displacements(fine, fine_solver, scene) - fine_intact;
    const Eigen::VectorXd signal = control_displacements(usual, usual_solver, scene) - usual_intact;
    INFO(scene);
    CHECK((signal - exact).lpNorm<1>() < 0.02 * exact.lpNorm<1>());
  }
}

TEST_CASE("Scenes solved side by side have the very bits of scenes solved alone", "[solver]") {
  const Model bridge = test::small_bridge();
  QuasiStaticSolver solver(bridge);
  const Field intact = solver.solve(Scene{}).displacement;
  std::vector<StageTask> tasks;
  for (const Scene& scene : all_scenes(bridge.layout.size(), 1))
    tasks.push_back({.stage = {.scene = scene}, .start = &intact});
  const std::vector<Solution> together = solver.solve(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Solution alone = solver.solve(tasks[i]);
    INFO(to_string(tasks[i].stage.scene, bridge.layout));
    CHECK(alone.outcome == together[i].outcome);
    CHECK(alone.iterations == together[i].iterations);
    CHECK(without_nan(alone.displacement) == without_nan(together[i].displacement));
  }
}

TEST_CASE("Lanes with different joints and blocks have the very bits of each alone", "[solver]") {
  const Model bridge = test::small_bridge();
  std::vector<Parameters> variants(5, bridge.parameters);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    for (std::size_t j = 0; j < variants[v].joints.size(); ++j) {
      variants[v].joints[j].normal_stiffness *= 1.0 + 0.1 * static_cast<double>((j * 7 + v * 3) % 11);
      variants[v].joints[j].tangential_stiffness *= 1.0 + 0.2 * static_cast<double>((j + v) % 5);
    }
    for (std::size_t b = 0; b < variants[v].blocks.size(); ++b)
      variants[v].blocks[b].young_modulus *= 1.0 + 0.1 * static_cast<double>((b + v) % 3);
  }
  const Scene scene = parse_scene("4,2", bridge.layout);
  std::vector<StageTask> tasks;
  for (const Parameters& variant : variants)
    tasks.push_back({.stage = {.scene = scene}, .parameters = &variant});
  QuasiStaticSolver solver(bridge);
  const std::vector<Solution> together = solver.solve(tasks);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    Model alone = bridge;
    alone.parameters = variants[v];
    const Solution expected = QuasiStaticSolver(alone).solve(scene);
    CHECK(expected.outcome == Outcome::standing);
    CHECK(without_nan(expected.displacement) == without_nan(together[v].displacement));
    for (std::size_t other = 0; other < v; ++other)
      CHECK(without_nan(together[other].displacement) != without_nan(together[v].displacement));
  }
}
