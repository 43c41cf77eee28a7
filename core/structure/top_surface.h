#pragma once
/// @file The top of a bridge, and what forces on it are to the nodes.

#include <array>
#include <vector>

#include "core/structure/mesh.h"

namespace voussoir {

/// Which edge carries what stands at x: of the block boundaries that face up, the highest.
class TopSurface {
 public:
  explicit TopSurface(const Mesh& mesh);

  /// Is there a block under x [m]?
  bool is_under(double x) const { return !edges_at(x).empty(); }

  /// Adds a downward force [N] at x [m], shared by the two nodes of the edge by linear shape functions. Where
  /// two edges of the same height meet each takes half. Throws InputError if there is no block under x.
  void add_force(double x, double force, Field& load) const;

  /// Adds a downward force per length along x [N/m] from `left` to `right`, integrated exactly over the
  /// edges. Throws InputError if there is no block under a part of it.
  void add_line(double left, double right, double force_per_length, Field& load) const;

  /// Adds the soil [kg] between the top and a line of straight stretches above it (x ascending), where it is
  /// above, to the nodes' masses: `mass_per_area` [kg/m2] times the height, by Gauss's rule with two points
  /// on each stretch on which the line is above, which is exact.
  void add_soil(const std::vector<Point>& line, double mass_per_area, Eigen::VectorXd& masses) const;

  /// The same soil as quadrilaterals side by side [m], each over one edge.
  std::vector<std::array<Point, 4>> soil(const std::vector<Point>& line) const;

 private:
  /// An edge from its left to its right node.
  struct Edge {
    NodeId left_node, right_node;
    Point left, right;
    double share_of_right(double x) const { return (x - left.x()) / (right.x() - left.x()); }
    double height(double x) const { return left.y() + share_of_right(x) * (right.y() - left.y()); }
  };
  static constexpr int kNone = -1;

  /// Where a straight stretch of a line above the top is over one edge.
  struct Cover {
    const Edge* edge;
    Point from, to;     ///< the line's stretch
    double begin, end;  ///< of x [m]
    double top(double x) const;
  };

  std::vector<int> edges_at(double x) const;
  std::vector<Cover> covers(const std::vector<Point>& line) const;
  void share(const Edge& edge, double x, double force, Field& load) const;

  std::vector<Edge> edges_;  ///< that face up
  std::vector<double>
      ends_;  ///< x of their ends, ascending [m]: between two of them the highest edge is the same
  std::vector<int> highest_;  ///< edge between each end and the next, or kNone
};

}  // namespace voussoir
