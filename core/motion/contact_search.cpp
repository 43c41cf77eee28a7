#include "core/motion/contact_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/geometry/box.h"

namespace voussoir {
namespace {

/// Angles this close to a straight one belong to nodes inside a straight side [rad].
constexpr double kStraight = 1e-6;

bool near(const Box& a, const Box& b, double margin) {
  return a.min().x() <= b.max().x() + margin && b.min().x() <= a.max().x() + margin &&
         a.min().y() <= b.max().y() + margin && b.min().y() <= a.max().y() + margin;
}

/// A boundary edge where it is now.
struct PlacedEdge {
  Box box;
  Point from;
  Point along;  ///< from its first node to its second [m]
  double squared_length;
  double behind;  ///< how far its block reaches behind it [m]
};

std::vector<PlacedEdge> placed_edges(const Mesh& mesh, const Eigen::Matrix2Xd& places,
                                     const std::vector<double>& behind) {
  std::vector<PlacedEdge> edges;
  edges.reserve(mesh.edges.size());
  for (const BoundaryEdge& edge : mesh.edges) {
    const Point a = places.col(value(edge.from));
    const Point b = places.col(value(edge.to));
    edges.push_back(
        {Box(a.cwiseMin(b), a.cwiseMax(b)), a, b - a, (b - a).squaredNorm(), behind[edges.size()]});
  }
  return edges;
}

/// Per block: the box around its edges.
std::vector<Box> boxes_of_blocks(const Mesh& mesh, const std::vector<PlacedEdge>& edges) {
  std::vector<Box> boxes(mesh.block_edges.size());
  for (std::size_t block = 0; block < boxes.size(); ++block)
    for (int e = mesh.block_edges[block].begin; e < mesh.block_edges[block].end; ++e)
      boxes[block].extend(edges[static_cast<std::size_t>(e)].box);
  return boxes;
}

/// Pairs of blocks, in ascending order of their first.
using BlockPairs = std::vector<std::pair<int, int>>;

/// By counting, as there are few blocks.
BlockPairs in_order_of_first(const BlockPairs& pairs, std::size_t block_count) {
  std::vector<std::size_t> next(block_count + 1, 0);
  for (const auto& [first, second] : pairs) ++next[static_cast<std::size_t>(first) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  BlockPairs ordered(pairs.size());
  for (const auto& pair : pairs) ordered[next[static_cast<std::size_t>(pair.first)]++] = pair;
  return ordered;
}

/// Pairs of blocks whose boxes are near, by a sweep from left to right.
BlockPairs near_blocks(const std::vector<Box>& boxes, const std::vector<bool>& absent, double margin) {
  std::vector<std::pair<double, int>> from_left;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (!absent[b]) from_left.emplace_back(boxes[b].min().x(), static_cast<int>(b));
  std::sort(from_left.begin(), from_left.end());
  BlockPairs pairs;
  for (std::size_t i = 0; i < from_left.size(); ++i) {
    const int one = from_left[i].second;
    const Box& box = boxes[static_cast<std::size_t>(one)];
    for (std::size_t j = i + 1; j < from_left.size() && from_left[j].first <= box.max().x() + margin; ++j) {
      const int other = from_left[j].second;
      if (near(box, boxes[static_cast<std::size_t>(other)], margin))
        pairs.emplace_back(std::min(one, other), std::max(one, other));
    }
  }
  return in_order_of_first(pairs, boxes.size());
}

/// Contact ends at 60 degrees; the rest is for rotations until the next search.
bool may_face(const PlacedEdge& a, const PlacedEdge& b) {
  constexpr double kCosine = 0.25881904510252074;  // of 75 degrees
  const double cosine = a.along.dot(b.along);
  return cosine < 0.0 && cosine * cosine > kCosine * kCosine * a.squared_length * b.squared_length;
}

/// Is some of the other edge on this one's own side, where its block is?
bool is_behind(const PlacedEdge& edge, const PlacedEdge& other) {
  const Point to_other = other.from - edge.from;
  return cross(edge.along, to_other) > 0.0 || cross(edge.along, to_other + other.along) > 0.0;
}

/// EdgeContact::deepest of two edges with so much of their blocks behind them [m].
double deepest_of(double behind_a, double behind_b) {
  return 0.5 * (behind_a + behind_b);
}

/// Are faces of a joint within each other and no deeper than faces may be that touch? Others are left out:
/// behind a thin block's face lies its neighbour's, which faces it, too.
bool is_closed_joint(const PlacedEdge& a, const PlacedEdge& b, double margin) {
  return near(a.box, b.box, margin + deepest_of(a.behind, b.behind)) && is_behind(a, b) && is_behind(b, a);
}

/// Adds the pairs of two blocks' edges that may face each other and are near, or form a joint that is closed
/// by more than the margin.
void add_near_edges(const std::vector<PlacedEdge>& edges, const IndexRange& first, const IndexRange& second,
                    const Box& second_box, double margin, const std::vector<EdgePair>& joined,
                    std::vector<EdgePair>& pairs) {
  for (int a = first.begin; a < first.end; ++a) {
    const PlacedEdge& edge_a = edges[static_cast<std::size_t>(a)];
    if (!near(edge_a.box, second_box, margin)) continue;
    for (int b = second.begin; b < second.end; ++b) {
      const PlacedEdge& edge_b = edges[static_cast<std::size_t>(b)];
      if (!may_face(edge_a, edge_b)) continue;
      if (near(edge_a.box, edge_b.box, margin) ||
          (is_closed_joint(edge_a, edge_b, margin) &&
           std::binary_search(joined.begin(), joined.end(), EdgePair(a, b))))
        pairs.emplace_back(a, b);
    }
  }
}

/// 1 / tan(half the interior angle) at the node between two edges; 0 at straight and re-entrant angles.
double corner_share(const Point& before, const Point& after) {
  const double turn = std::atan2(cross(before, after), before.dot(after));  // pi minus the interior angle
  return turn > kStraight ? std::tan(0.5 * turn) : 0.0;
}

/// How far a block's nodes reach behind one of its edges, at rest [m].
double reach_behind(const Mesh& mesh, const BoundaryEdge& edge, const IndexRange& nodes) {
  const Point from = mesh.position(edge.from);
  const Point along = (mesh.position(edge.to) - from).normalized();
  double farthest = 0.0;
  for (int node = nodes.begin; node < nodes.end; ++node)
    farthest = std::max(farthest, cross(along, mesh.nodes.col(node) - from));
  return farthest;
}

/// Per node: the boundary edge that begins there.
std::vector<int> edges_by_first_node(const Mesh& mesh) {
  std::vector<int> edge_from(static_cast<std::size_t>(mesh.node_count()), -1);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    edge_from[static_cast<std::size_t>(value(mesh.edges[e].from))] = static_cast<int>(e);
  return edge_from;
}

}  // namespace

double search_margin(const Structure& structure) {
  return 0.02 * mean_block_size(structure);
}

ContactMaterial::ContactMaterial(const JointMaterial& joint, double thickness)
    : normal(joint.normal_stiffness * thickness),
      tangential(joint.tangential_stiffness * thickness),
      friction(joint.friction_coefficient()),
      half_compliance(0.5 / normal),
      sixth_compliance(1.0 / (6.0 * normal)),
      per_tangential(1.0 / tangential) {}

ContactSearch::ContactSearch(const Model& model)
    : mesh_(&model.mesh),
      parameters_(&model.parameters),
      edge_block_(model.mesh.edges.size()),
      corner_share_(static_cast<std::size_t>(model.mesh.node_count())),
      behind_(model.mesh.edges.size()) {
  const Mesh& mesh = model.mesh;
  const auto along = [&](const BoundaryEdge& e) -> Point {
    return mesh.position(e.to) - mesh.position(e.from);
  };
  for (std::size_t block = 0; block < mesh.block_edges.size(); ++block) {
    const auto first = mesh.edges.begin() + mesh.block_edges[block].begin;
    const auto last = mesh.edges.begin() + mesh.block_edges[block].end;
    std::fill(edge_block_.begin() + mesh.block_edges[block].begin,
              edge_block_.begin() + mesh.block_edges[block].end, static_cast<int>(block));
    for (auto edge = first; edge != last; ++edge) {
      behind_[static_cast<std::size_t>(edge - mesh.edges.begin())] =
          reach_behind(mesh, *edge, mesh.block_nodes[block]);
      const auto next = std::find_if(first, last, [&](const BoundaryEdge& e) { return e.from == edge->to; });
      corner_share_[static_cast<std::size_t>(value(edge->to))] = corner_share(along(*edge), along(*next));
    }
  }
  edge_from_ = edges_by_first_node(mesh);
  std::map<EdgePair, ContactMaterial> joined;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    joined[pair_of(joint)] =
        ContactMaterial(model.parameters.joints[j], joint_thickness(joint, model.parameters));
  }
  for (const auto& [pair, material] : joined) {
    joined_.push_back(pair);
    joined_material_.push_back(material);
  }
}

EdgePair ContactSearch::pair_of(const Joint& joint) const {
  const auto edge = [&](const BoundaryEdge& e) {
    return edge_from_[static_cast<std::size_t>(value(e.from))];
  };
  return {edge(joint.first_edge), edge(joint.second_edge)};
}

std::vector<EdgePair> ContactSearch::candidates(const Eigen::Matrix2Xd& places,
                                                const std::vector<bool>& absent, double margin) const {
  const std::vector<PlacedEdge> edges = placed_edges(*mesh_, places, behind_);
  const std::vector<Box> boxes = boxes_of_blocks(*mesh_, edges);
  const BlockPairs blocks = near_blocks(boxes, absent, margin);
  std::vector<EdgePair> pairs;
  for (std::size_t i = 0; i < blocks.size();) {
    const int first = blocks[i].first;
    const auto begin = static_cast<std::ptrdiff_t>(pairs.size());
    for (; i < blocks.size() && blocks[i].first == first; ++i) {
      const auto second = static_cast<std::size_t>(blocks[i].second);
      add_near_edges(edges, mesh_->block_edges[static_cast<std::size_t>(first)], mesh_->block_edges[second],
                     boxes[second], margin, joined_, pairs);
    }
    std::sort(pairs.begin() + begin, pairs.end());
  }
  return pairs;
}

EdgeContact ContactSearch::contact(const EdgePair& pair) const {
  const auto a = static_cast<std::size_t>(pair.first);
  const auto b = static_cast<std::size_t>(pair.second);
  const BoundaryEdge& edge_a = mesh_->edges[a];
  const BoundaryEdge& edge_b = mesh_->edges[b];
  const auto found = std::lower_bound(joined_.begin(), joined_.end(), pair);
  const bool joined = found != joined_.end() && *found == pair;
  const auto share = [&](NodeId node) {
    return joined ? 0.0 : corner_share_[static_cast<std::size_t>(value(node))];
  };
  const auto per_length = [&](const BoundaryEdge& e) {
    return 1.0 / (mesh_->position(e.to) - mesh_->position(e.from)).norm();
  };
  return {.nodes = {value(edge_a.from), value(edge_a.to), value(edge_b.from), value(edge_b.to)},
          .per_length = {per_length(edge_a), per_length(edge_b)},
          .corner_share = {share(edge_a.from), share(edge_a.to), share(edge_b.from), share(edge_b.to)},
          .joined = joined,
          .deepest = deepest_of(behind_[a], behind_[b]),
          .material = joined ? joined_material_[static_cast<std::size_t>(found - joined_.begin())]
                             : new_contact(edge_block_[a], edge_block_[b])};
}

std::array<std::size_t, 2> ContactSearch::blocks(const EdgePair& pair) const {
  const auto block_of = [&](int edge) {
    return static_cast<std::size_t>(edge_block_[static_cast<std::size_t>(edge)]);
  };
  return {block_of(pair.first), block_of(pair.second)};
}

ContactMaterial ContactSearch::new_contact(int block_a, int block_b) const {
  const auto a = static_cast<std::size_t>(block_a);
  const auto b = static_cast<std::size_t>(block_b);
  const std::vector<double>& share = parameters_->contact_share;
  const double softening = share.empty() ? 1.0 : std::min(share[a], share[b]);
  return ContactMaterial(softened(parameters_->contact, softening),
                         std::min(parameters_->blocks[a].thickness, parameters_->blocks[b].thickness));
}

}  // namespace voussoir
