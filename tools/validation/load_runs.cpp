#include "tools/validation/load_runs.h"

#include <stdexcept>

#include "tools/validation/assemblies.h"
#include "tools/validation/hard_case_runs.h"
#include "tools/validation/history.h"

namespace voussoir::validation {
namespace {

constexpr double kWallLength = 4.0;  ///< [m]
constexpr double kOnLine = 1e-9;     ///< [m]

double largest_change(const Solution& from, const Solution& to) {
  return (to.displacement - from.displacement).array().abs().maxCoeff();
}

}  // namespace

Model rough_wall() {
  std::vector<Polygon> blocks;
  for (int course = 0; course < 3; ++course) {
    const double y = 0.5 * course;
    std::vector<double> cuts = {0.0};
    for (double x = course % 2 == 0 ? 0.5 : 1.0; x < kWallLength; x += 1.0) cuts.push_back(x);
    cuts.push_back(kWallLength);
    for (std::size_t i = 1; i < cuts.size(); ++i)
      blocks.push_back(rectangle({cuts[i - 1], y}, cuts[i] - cuts[i - 1], 0.5));
  }
  BridgeDescription description;
  description.wall.length = 25.0 * kWallLength;  // the right side is free
  description.supports = {.base = SupportKind::roller, .sides = SupportKind::roller};
  description.joints.friction_angle = 1.5;
  return assemble_blocks(description, blocks);
}

Field side_pressure(const Model& bridge, double x, double pressure) {
  Field forces = Field::Zero(2, bridge.mesh.node_count());
  for (const BoundaryEdge& edge : bridge.mesh.edges) {
    const Point from = bridge.mesh.position(edge.from);
    const Point to = bridge.mesh.position(edge.to);
    if (std::abs(from.x() - x) > kOnLine || std::abs(to.x() - x) > kOnLine) continue;
    const double half = 0.5 * pressure * bridge.parameters.blocks.front().thickness * (to - from).norm();
    forces(0, value(edge.from)) -= half;
    forces(0, value(edge.to)) -= half;
  }
  return forces;
}

Field point_load(const Model& bridge, NodeId node, double force) {
  Field load = Field::Zero(2, bridge.mesh.node_count());
  load(1, value(node)) = -force;
  return load;
}

double reciprocity_error(const Model& bridge, const Stage& first, const std::vector<int>& components,
                         double force) {
  QuasiStaticSolver solver(bridge, tightest());
  const Solution before = solver.solve({.stage = first});
  const auto n = static_cast<Eigen::Index>(components.size());
  Eigen::MatrixXd answers(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    Field change = Field::Zero(2, bridge.mesh.node_count());
    for (const double sign : {1.0, -1.0}) {
      const int component = components[static_cast<std::size_t>(j)];
      Field load = Field::Zero(2, bridge.mesh.node_count());
      load.data()[component] = sign * force;
      const History loaded = followed_by({"", {{"", first}}}, "", load);
      change +=
          0.5 * sign *
          solver
              .solve({.stage = loaded.stages.back().stage, .start = &before.displacement, .before = &before})
              .displacement;
    }
    for (Eigen::Index i = 0; i < n; ++i)
      answers(i, j) = change.data()[components[static_cast<std::size_t>(i)]];
  }
  return (answers - answers.transpose()).cwiseAbs().maxCoeff() / answers.cwiseAbs().maxCoeff();
}

LoadTrace load_trace(const Model& bridge, const Stage& first, const Field& load, int steps) {
  QuasiStaticSolver solver(bridge);
  History history = followed_by(followed_by({"", {{"", first}}}, "loaded", load), "unloaded", -load);
  for (std::size_t i = 1; i < history.stages.size(); ++i) history.stages[i].steps = steps;
  const std::vector<Solution> states = solve_history(solver, history);
  if (states.size() != history.stages.size() || states.back().outcome != Outcome::standing)
    throw std::runtime_error("the bridge does not carry the load");
  return {.under_load = largest_change(states[0], states[1]), .left = largest_change(states[0], states[2])};
}

}  // namespace voussoir::validation
