#include "core/statics/mechanism.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "core/geometry/polygon.h"
#include "core/statics/non_negative_least_squares.h"
#include "core/structure/neighbours.h"

namespace voussoir {
namespace {

/// Of g . g, the least work that proves a fall. Turns of the joints before blocks fall are of the order of
/// 1e-3, and so is what they change; collapses of the reference bridge's arch have 0.05 to 0.18.
constexpr double kLeastShare = 0.01;
constexpr double kAtRest = 1e-6;  ///< of the largest velocity: what is less is round-off

/// Blocks that may move, each with a place about which moments are taken and a length that makes forces of
/// them.
class MovingBlocks {
 public:
  MovingBlocks(const Model& model, const Scene& scene, std::span<const BlockId> blocks) : model_(model) {
    const std::vector<bool> held = held_components(model.supports, model.mesh);
    place_.assign(model.layout.size(), -1);
    for (const BlockId block : blocks) {
      const IndexRange nodes = model.mesh.block_nodes[static_cast<std::size_t>(value(block))];
      const auto from = held.begin() + 2 * nodes.begin;
      if (scene.lacks(block) || std::find(from, from + 2 * nodes.size(), true) != from + 2 * nodes.size())
        continue;
      place_[static_cast<std::size_t>(value(block))] = static_cast<int>(blocks_.size());
      blocks_.push_back(block);
      const Polygon& polygon = model.layout[block].polygon;
      centres_.push_back(centroid(polygon));
      sizes_.push_back(std::sqrt(area(polygon)));
    }
  }

  const std::vector<BlockId>& blocks() const { return blocks_; }
  Eigen::Index rows() const { return 3 * static_cast<Eigen::Index>(blocks_.size()); }
  bool moves(BlockId block) const { return place_[static_cast<std::size_t>(value(block))] >= 0; }

  /// Adds a force at a point to a block's forces and moment; nothing if the block does not move.
  void add(BlockId block, const Point& at, const Point& force, Eigen::Ref<Eigen::VectorXd> column) const {
    const int place = place_[static_cast<std::size_t>(value(block))];
    if (place < 0) return;
    const auto k = static_cast<std::size_t>(place);
    column.segment<3>(3 * place) +=
        Eigen::Vector3d(force.x(), force.y(), cross(at - centres_[k], force) / sizes_[k]);
  }

  /// What carries the blocks' weight.
  Eigen::VectorXd carrying(const Coefficients& coefficients) const {
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(rows());
    for (const BlockId block : blocks_) {
      const IndexRange nodes = model_.mesh.block_nodes[static_cast<std::size_t>(value(block))];
      for (int node = nodes.begin; node < nodes.end; ++node)
        add(block, model_.mesh.position(NodeId{node}), Point(0.0, coefficients.weight[node]), forces);
    }
    return forces;
  }

 private:
  const Model& model_;
  std::vector<BlockId> blocks_;
  std::vector<int> place_;  ///< of each block of the bridge; -1: it does not move
  std::vector<Point> centres_;
  std::vector<double> sizes_;
};

/// The edges of Coulomb's cones at the ends of all stretches that touch a moving block.
Eigen::MatrixXd cone_edges(const Model& model, const MovingBlocks& moving, const Scene& scene) {
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    if (scene.lacks(joint.first) || scene.lacks(joint.second)) continue;
    if (!moving.moves(joint.first) && !moving.moves(joint.second)) continue;
    const std::array<Point, 2> ends = ends_of(joint, model.mesh);
    const Point direction = (ends[1] - ends[0]).normalized();
    const Point normal(direction.y(), -direction.x());
    const double friction = model.parameters.joints[j].friction_coefficient();
    for (const Point& end : ends)
      for (const double slope : {-friction, friction}) {
        Eigen::VectorXd& column = columns.emplace_back(Eigen::VectorXd::Zero(moving.rows()));
        moving.add(joint.first, end, -normal - slope * direction, column);
        moving.add(joint.second, end, normal + slope * direction, column);
      }
  }
  Eigen::MatrixXd matrix(moving.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
  return matrix;
}

/// The mechanism without the blocks that stay where they are or only turn: their weight does no work.
Mechanism falling_part(const Mechanism& mechanism) {
  const double most = *std::ranges::max_element(mechanism.unbalanced);
  Mechanism part{mechanism.scene, {}, {}, {}, {}};
  for (std::size_t i = 0; i < mechanism.blocks.size(); ++i) {
    if (mechanism.unbalanced[i] < kAtRest * most) continue;
    part.blocks.push_back(mechanism.blocks[i]);
    part.work.push_back(mechanism.work[i]);
    part.load.push_back(mechanism.load[i]);
    part.unbalanced.push_back(mechanism.unbalanced[i]);
  }
  return part;
}

/// Sums over the mechanism's blocks that a scene has.
double sum_over_present(const Mechanism& mechanism, const Scene& scene, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mechanism.blocks.size(); ++i)
    if (!scene.lacks(mechanism.blocks[i])) sum += values[i];
  return sum;
}

}  // namespace

std::optional<Mechanism> find_mechanism(const Model& model, const Coefficients& coefficients,
                                        const Scene& scene, std::span<const BlockId> blocks) {
  if (has_mortar(model.parameters)) return std::nullopt;
  const MovingBlocks moving(model, scene, blocks);
  const Eigen::VectorXd carrying = moving.carrying(coefficients);
  const Eigen::MatrixXd edges = cone_edges(model, moving, scene);
  const Eigen::VectorXd left = carrying - edges * non_negative_least_squares(edges, carrying);
  Mechanism mechanism{scene, moving.blocks(), {}, {}, {}};
  for (Eigen::Index row = 0; row < moving.rows(); row += 3) {
    mechanism.work.push_back(left.segment<3>(row).dot(carrying.segment<3>(row)));
    mechanism.load.push_back(carrying.segment<3>(row).squaredNorm());
    mechanism.unbalanced.push_back(left.segment<2>(row).norm() / coefficients.weight.sum());
  }
  return proves_fall(mechanism, scene) ? std::optional(std::move(mechanism)) : std::nullopt;
}

std::optional<Mechanism> find_mechanism_beside(const Model& model, const Coefficients& coefficients,
                                               const Scene& scene) {
  const std::vector<BlockId> beside = blocks_beside(scene, model);
  auto mechanism = find_mechanism(model, coefficients, scene, beside);
  return mechanism ? std::optional(falling_part(*mechanism)) : std::nullopt;
}

bool proves_fall(const Mechanism& mechanism, const Scene& scene) {
  if (!std::ranges::includes(scene.removed, mechanism.scene.removed)) return false;
  return sum_over_present(mechanism, scene, mechanism.work) >
         kLeastShare * sum_over_present(mechanism, scene, mechanism.load);
}

std::optional<Solution> proved_fall(std::span<const Mechanism* const> mechanisms, const Scene& scene,
                                    const Structure& structure) {
  Solution solution;
  std::set<BlockId> moving;
  for (const Mechanism* mechanism : mechanisms) {
    if (!proves_fall(*mechanism, scene)) continue;
    std::ranges::copy_if(mechanism->blocks, std::inserter(moving, moving.end()),
                         [&](BlockId block) { return !scene.lacks(block); });
    solution.residual =
        std::max(solution.residual, sum_over_present(*mechanism, scene, mechanism->unbalanced));
  }
  if (moving.empty()) return std::nullopt;
  solution.outcome = Outcome::collapsed;
  solution.moving.assign(moving.begin(), moving.end());
  solution.extent = collapse_extent(structure.layout, solution.moving);
  solution.displacement =
      Field::Constant(2, structure.mesh.node_count(), std::numeric_limits<double>::quiet_NaN());
  return solution;
}

}  // namespace voussoir
