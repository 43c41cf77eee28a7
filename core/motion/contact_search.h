#pragma once
/// @file Which boundary edges may meet soon: the broad phase of contact.

#include <utility>
#include <vector>

#include "core/motion/contact.h"
#include "core/structure/model.h"

namespace voussoir {

/// A candidate: positions in Mesh::edges, the first in the block with the smaller number.
using EdgePair = std::pair<int, int>;

/// How far apart edges may be that a search finds [m]: a share of the mean block size. What it found holds
/// until a node has travelled half of that.
double search_margin(const Structure& structure);

class ContactSearch {
 public:
  /// The model must outlive the search.
  explicit ContactSearch(const Model& model);

  /// Pairs of edges of different blocks that face each other roughly (within 75 degrees) and whose bounding
  /// boxes are at most `margin` [m] apart at these places of the nodes [m], or which form a joint at rest
  /// that has closed by more, as soft ones do; in ascending order. Blocks in `absent` are left out.
  std::vector<EdgePair> candidates(const Eigen::Matrix2Xd& places, const std::vector<bool>& absent,
                                   double margin) const;

  /// The contact of two edges. Edges that form a joint at rest have its material and own their whole stretch,
  /// as in the quasi-static equations; others share out what penetrates at corners (see contact.h).
  EdgeContact contact(const EdgePair& pair) const;

  /// The edges that a joint lies on.
  EdgePair pair_of(const Joint& joint) const;

  /// The blocks of the two edges.
  std::array<std::size_t, 2> blocks(const EdgePair& pair) const;

 private:
  ContactMaterial new_contact(int block_a, int block_b) const;

  const Mesh* mesh_;
  const Parameters* parameters_;
  std::vector<int> edge_from_;                    ///< per node: the edge that begins there
  std::vector<int> edge_block_;                   ///< per edge
  std::vector<double> corner_share_;              ///< per node, see EdgeContact
  std::vector<double> behind_;                    ///< per edge: how far its block reaches behind it [m]
  std::vector<EdgePair> joined_;                  ///< edges that form a joint at rest, ascending
  std::vector<ContactMaterial> joined_material_;  ///< of `joined_`
};

}  // namespace voussoir
