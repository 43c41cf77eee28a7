#include "core/motion/contact_search.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "core/motion/dynamic_solver.h"
#include "core/structure/model.h"
#include "tools/validation/assemblies.h"

namespace voussoir {
namespace {

Model three_courses() {
  BridgeDescription description;
  description.wall = {.length = 4.0, .courses = 3};
  description.spans.clear();
  return make_model(description);
}

bool boxes_near(const Eigen::Matrix2Xd& places, const BoundaryEdge& a, const BoundaryEdge& b, double margin) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto at = [&](NodeId node) { return places(axis, value(node)); };
    if (std::min(at(a.from), at(a.to)) > std::max(at(b.from), at(b.to)) + margin) return false;
    if (std::min(at(b.from), at(b.to)) > std::max(at(a.from), at(a.to)) + margin) return false;
  }
  return true;
}

/// Has the other edge an end on this one's left, where its block is?
bool has_end_behind(const Eigen::Matrix2Xd& places, const BoundaryEdge& edge, const BoundaryEdge& other) {
  const auto at = [&](NodeId node) -> Point { return places.col(value(node)); };
  const Point along = at(edge.to) - at(edge.from), left(-along.y(), along.x());
  return left.dot(at(other.from) - at(edge.from)) > 0.0 || left.dot(at(other.to) - at(edge.from)) > 0.0;
}

/// Is an edge's box near that around all nodes of a block?
bool is_near_block(const Eigen::Matrix2Xd& places, const BoundaryEdge& edge, const IndexRange& nodes,
                   double margin) {
  const auto block = places.middleCols(nodes.begin, nodes.size());
  for (int axis = 0; axis < 2; ++axis) {
    const double a = places(axis, value(edge.from)), b = places(axis, value(edge.to));
    if (std::min(a, b) > block.row(axis).maxCoeff() + margin) return false;
    if (std::max(a, b) < block.row(axis).minCoeff() - margin) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("The contact search finds every pair of edges that brute force finds, in order and once") {
  const Model bridge = three_courses();
  const ContactSearch search(bridge);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.2, 0.2);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix2Xd places = bridge.mesh.nodes;
    for (const IndexRange& nodes : bridge.mesh.block_nodes) {
      const Point shift(any(random), any(random));
      places.middleCols(nodes.begin, nodes.size()).colwise() += shift;
    }
    std::vector<bool> absent(bridge.layout.size(), false);
    absent[static_cast<std::size_t>(trial) % absent.size()] = true;

    std::vector<EdgePair> expected;
    for (std::size_t first = 0; first < bridge.layout.size(); ++first)
      for (std::size_t second = first + 1; second < bridge.layout.size(); ++second)
        for (int a = bridge.mesh.block_edges[first].begin; a < bridge.mesh.block_edges[first].end; ++a)
          for (int b = bridge.mesh.block_edges[second].begin; b < bridge.mesh.block_edges[second].end; ++b) {
            const BoundaryEdge& edge_a = bridge.mesh.edges[static_cast<std::size_t>(a)];
            const BoundaryEdge& edge_b = bridge.mesh.edges[static_cast<std::size_t>(b)];
            const Point along_a = places.col(value(edge_a.to)) - places.col(value(edge_a.from));
            const Point along_b = places.col(value(edge_b.to)) - places.col(value(edge_b.from));
            const bool facing = along_a.normalized().dot(along_b.normalized()) < -0.5;
            const bool within = search.contact({a, b}).joined &&
                                is_near_block(places, edge_a, bridge.mesh.block_nodes[second], 0.05) &&
                                boxes_near(places, edge_a, edge_b, 0.05 + search.contact({a, b}).deepest) &&
                                has_end_behind(places, edge_a, edge_b) &&
                                has_end_behind(places, edge_b, edge_a);
            const bool touches = within || boxes_near(places, edge_a, edge_b, 0.05);
            if (!absent[first] && !absent[second] && facing && touches) expected.emplace_back(a, b);
          }
    std::sort(expected.begin(), expected.end());
    CHECK(search.candidates(places, absent, 0.05) == expected);
  }
}

TEST_CASE("All joints at rest are among the candidates and own their corners") {
  const Model bridge = three_courses();
  const ContactSearch search(bridge);
  const std::vector<EdgePair> pairs =
      search.candidates(bridge.mesh.nodes, std::vector<bool>(bridge.layout.size(), false), 1e-3);
  std::size_t joined = 0;
  for (const EdgePair& pair : pairs) {
    const EdgeContact contact = search.contact(pair);
    joined += contact.corner_share == std::array<double, 4>{};
  }
  CHECK(joined == bridge.joints.size());
  CHECK(pairs.size() > joined);  // edges that meet at a corner only
}

TEST_CASE(
    "A joint that closes by more than the contact search's margin carries its block (weight over p_n)") {
  BridgeDescription description;
  description.wall.length = 3.0;
  description.spans.clear();
  description.supports.sides = SupportKind::free;
  description.joints.normal_stiffness = description.joints.tangential_stiffness = 2e5;
  const Model bridge = validation::assemble_blocks(
      description,
      {validation::rectangle(Point(1.0, 0.0), 1.0, 0.5), validation::rectangle(Point(1.0, 0.5), 1.0, 0.5)});
  const double closure = validation::kSpecificWeight * 0.5 / description.joints.normal_stiffness;
  REQUIRE(closure > 3.0 * search_margin(bridge));
  DynamicSettings settings;
  settings.decision.latest_decision = 10.0;
  const Solution rests = DynamicSolver(bridge, settings).solve(Scene{}).solution;
  CHECK(rests.outcome == Outcome::standing);
  const IndexRange& upper = bridge.mesh.block_nodes[1];
  for (int node = upper.begin; node < upper.end; ++node)
    CHECK(-rests.displacement(1, node) == Approx(closure).epsilon(0.01));
}

}  // namespace voussoir
