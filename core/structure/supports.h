#pragma once
/// @file Which nodes are held, as data: solvers look at no coordinates.

#include <string>
#include <vector>

#include "core/structure/bridge_description.h"
#include "core/structure/mesh.h"

namespace voussoir {

/// A set of nodes with one condition.
struct Support {
  std::string name;  ///< "base", "left side", "right side"
  std::vector<NodeId> nodes;
  bool holds_x = false;
  bool holds_y = false;
};

/// The supports of a bridge in a box: nodes at y = 0 (base), x = 0 and x = length (sides). Sets that hold
/// nothing or have no node are left out.
std::vector<Support> box_supports(const Mesh& mesh, const SupportDescription& description, double length);

/// Per displacement component (2 node + axis): does a support hold it?
std::vector<bool> held_components(const std::vector<Support>& supports, const Mesh& mesh);

}  // namespace voussoir
