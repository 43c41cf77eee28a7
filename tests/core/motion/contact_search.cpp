#include "core/motion/contact_search.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "core/structure/model.h"

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
            if (!absent[first] && !absent[second] && facing && boxes_near(places, edge_a, edge_b, 0.05))
              expected.emplace_back(a, b);
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

}  // namespace voussoir
