#pragma once
/// @file Which nodes are held, as data: solvers look at no coordinates.

#include <string>
#include <vector>

#include "core/structure/block_layout.h"
#include "core/structure/bridge_description.h"
#include "core/structure/mesh.h"

namespace voussoir {

/// A set of nodes with one condition.
struct Support {
  std::string name;  ///< "foot 1".. from the left, "left side", "right side"
  std::vector<NodeId> nodes;
  bool holds_x = false;
  bool holds_y = false;
  bool is_foot = false;  ///< part of the base; may move apart from the others
};

/// The supports of a bridge in a box: nodes at the height of its lower left `corner` (base), and at the x of
/// that and `length` beside it (sides). The base is a foot
/// for each stretch of ground on which blocks stand side by side. Sets that hold nothing or have no node are
/// left out.
std::vector<Support> box_supports(const Mesh& mesh, const SupportDescription& description, double length,
                                  const Point& corner = Point::Zero());

/// The supports of a described bridge: those of its box, and of its wall the support "top" if it is held
/// above and what is embedded in them, the blocks of the lowest courses in the foot below or next to them and
/// those of the highest courses in the top.
std::vector<Support> supports_of(const BridgeDescription& description, const BlockLayout& layout,
                                 const Mesh& mesh);

/// Does a node's component go where this support goes? Of a node in a corner, which two supports hold, it
/// goes with the first of them, so with the ground. Precondition: the node is one of the support's.
bool goes_with(const std::vector<Support>& supports, std::size_t support, NodeId node, int axis);

/// Per displacement component (2 node + axis): does a support hold it?
std::vector<bool> held_components(const std::vector<Support>& supports, const Mesh& mesh);

}  // namespace voussoir
