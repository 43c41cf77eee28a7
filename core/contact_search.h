#pragma once
/// @file Which boundary edges may meet soon: the broad phase of contact.

#include <utility>
#include <vector>

#include "core/contact.h"
#include "core/mesh.h"

namespace voussoir {

/// A candidate: positions in Mesh::edges, the first in the block with the smaller number.
using EdgePair = std::pair<int, int>;

class ContactSearch {
 public:
  explicit ContactSearch(const Mesh& mesh);

  /// Pairs of edges of different blocks that face each other roughly (within 75 degrees) and whose bounding boxes
  /// are at most `margin` [m] apart at these places of the nodes [m], in ascending order. Blocks in `absent` are left
  /// out.
  std::vector<EdgePair> candidates(const Eigen::Matrix2Xd& places, const std::vector<bool>& absent,
                                   double margin) const;

  /// The contact of two edges.
  EdgeContact contact(const EdgePair& pair) const;

 private:
  const Mesh* mesh_;
  std::vector<int> edge_block_;        ///< per edge
  std::vector<double> corner_share_;   ///< per node, see EdgeContact
};

}  // namespace voussoir
