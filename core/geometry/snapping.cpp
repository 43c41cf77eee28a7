#include "core/geometry/snapping.h"

#include <algorithm>
#include <utility>

#include "core/geometry/box.h"
#include "core/geometry/columns.h"

namespace voussoir {
namespace {

constexpr double kNoMove = 1e-9;  ///< [m] a corner this close is where it should be
constexpr std::size_t kColumns = 1000;

/// Every corner by the place that it shares with the corners near it.
struct Network {
  std::vector<Point> places;
  std::vector<std::vector<int>> outlines;  ///< of each polygon, as numbers of places
};

Network network_of(const std::vector<Polygon>& polygons, double tolerance) {
  const Box box = box_of(polygons);
  Columns columns(box.min().x(), box.max().x(), kColumns);
  Network network;
  for (const Polygon& polygon : polygons) {
    std::vector<int>& outline = network.outlines.emplace_back();
    for (const Point& corner : polygon) {
      int nearest = -1;
      double least = tolerance;
      for (const int i : columns.between(corner.x() - tolerance, corner.x() + tolerance)) {
        const double distance = (network.places[static_cast<std::size_t>(i)] - corner).norm();
        if (distance > least) continue;
        least = distance;
        nearest = i;
      }
      if (nearest < 0) {
        nearest = static_cast<int>(network.places.size());
        network.places.push_back(corner);
        columns.add(nearest, corner.x(), corner.x());
      }
      if (outline.empty() || (outline.back() != nearest)) outline.push_back(nearest);
    }
    if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  }
  return network;
}

/// Bends edges so that they pass through the places near them: those become corners of the outline. Returns
/// how many, and how far the farthest was off.
Snapping bend_edges(Network& network, const Box& box, double tolerance) {
  Columns columns(box.min().x(), box.max().x(), kColumns);
  for (std::size_t i = 0; i < network.places.size(); ++i)
    columns.add(static_cast<int>(i), network.places[i].x(), network.places[i].x());
  const auto at = [&](int i) -> const Point& { return network.places[static_cast<std::size_t>(i)]; };
  Snapping result;
  for (std::vector<int>& outline : network.outlines) {
    std::vector<int> bent;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const int from = outline[i], to = outline[(i + 1) % outline.size()];
      const Point along = at(to) - at(from);
      std::vector<std::pair<double, int>> between;  // share of the edge, place
      for (const int p : columns.between(std::min(at(from).x(), at(to).x()) - tolerance,
                                         std::max(at(from).x(), at(to).x()) + tolerance)) {
        if (std::find(outline.begin(), outline.end(), p) != outline.end()) continue;
        const double off = distance_to_segment(at(from), at(to), at(p));
        const double share = (at(p) - at(from)).dot(along) / along.squaredNorm();
        if (off <= kNoMove || off > tolerance || share <= 0.0 || share >= 1.0) continue;
        between.emplace_back(share, p);
        result.farthest = std::max(result.farthest, off);
      }
      std::sort(between.begin(), between.end());
      bent.push_back(from);
      for (const auto& [share, p] : between) bent.push_back(p);
      result.moved += static_cast<int>(between.size());
    }
    outline = std::move(bent);
  }
  return result;
}

}  // namespace

Snapping snap(std::vector<Polygon>& polygons, double tolerance) {
  if (polygons.empty()) return {};
  const Box box = box_of(polygons);
  Network network = network_of(polygons, tolerance);
  Snapping result = bend_edges(network, box, tolerance);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const Polygon before = std::exchange(polygons[p], {});
    for (const int i : network.outlines[p])
      polygons[p].push_back(network.places[static_cast<std::size_t>(i)]);
    for (const Point& corner : before) {
      const double move = polygons[p].empty() ? 0.0 : distance_to_corner(polygons[p], corner);
      result.moved += move > kNoMove ? 1 : 0;
      result.farthest = std::max(result.farthest, move);
    }
  }
  return result;
}

}  // namespace voussoir
