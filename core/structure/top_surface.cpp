#include "core/structure/top_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr double kSamePlace = 1e-9;   ///< [m] round-off of the layout is 1e-15
constexpr double kSameHeight = 1e-6;  ///< [m] as joints are found

[[noreturn]] void refuse_place(double x) {
  throw InputError(fmt::format("there is no block under x = {:g} m to carry a load", x));
}

double height_on(const Point& from, const Point& to, double x) {
  return from.y() + (x - from.x()) / (to.x() - from.x()) * (to.y() - from.y());
}

/// The part of a stretch from `begin` to `end` on which a linear function is above zero; empty if there is
/// none.
template <class Linear>
std::pair<double, double> where_positive(const Linear& function, double begin, double end) {
  if (end <= begin) return {begin, begin};
  const double at_begin = function(begin), at_end = function(end);
  if (at_begin <= 0.0 && at_end <= 0.0) return {begin, begin};
  if (at_begin * at_end >= 0.0) return {begin, end};
  const double zero = begin + at_begin / (at_begin - at_end) * (end - begin);
  return at_begin > 0.0 ? std::pair{begin, zero} : std::pair{zero, end};
}

}  // namespace

TopSurface::TopSurface(const Mesh& mesh) {
  for (const BoundaryEdge& edge : mesh.edges) {
    const Point left = mesh.position(edge.to), right = mesh.position(edge.from);  // the block is below
    if (right.x() - left.x() <= kSamePlace) continue;
    edges_.push_back({edge.to, edge.from, left, right});
    ends_.insert(ends_.end(), {left.x(), right.x()});
  }
  std::ranges::sort(ends_);
  const auto same = std::ranges::unique(ends_, [](double a, double b) { return b - a <= kSamePlace; });
  ends_.erase(same.begin(), same.end());
  highest_.assign(ends_.empty() ? 0 : ends_.size() - 1, kNone);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto first = std::ranges::lower_bound(ends_, edges_[e].left.x() - kSamePlace) - ends_.begin();
    for (auto i = static_cast<std::size_t>(first); i + 1 < ends_.size(); ++i) {
      const double middle = 0.5 * (ends_[i] + ends_[i + 1]);
      if (middle > edges_[e].right.x()) break;
      int& highest = highest_[i];
      if (highest == kNone ||
          edges_[e].height(middle) > edges_[static_cast<std::size_t>(highest)].height(middle))
        highest = static_cast<int>(e);
    }
  }
}

/// The highest edge at x, or two that meet there.
std::vector<int> TopSurface::edges_at(double x) const {
  std::vector<int> found;
  for (std::size_t i = 0; i < highest_.size(); ++i)
    if (highest_[i] != kNone && x >= ends_[i] - kSamePlace && x <= ends_[i + 1] + kSamePlace)
      found.push_back(highest_[i]);
  if (found.size() < 2) return found;
  const auto height = [&](int e) { return edges_[static_cast<std::size_t>(e)].height(x); };
  const double top = std::max(height(found.front()), height(found.back()));
  std::erase_if(found, [&](int e) { return height(e) < top - kSameHeight; });
  return found;
}

void TopSurface::share(const Edge& edge, double x, double force, Field& load) const {
  const double right = std::clamp(edge.share_of_right(x), 0.0, 1.0);
  load(1, value(edge.left_node)) -= (1.0 - right) * force;
  load(1, value(edge.right_node)) -= right * force;
}

void TopSurface::add_force(double x, double force, Field& load) const {
  const std::vector<int> edges = edges_at(x);
  if (edges.empty()) refuse_place(x);
  for (const int e : edges)
    share(edges_[static_cast<std::size_t>(e)], x, force / static_cast<double>(edges.size()), load);
}

void TopSurface::add_line(double left, double right, double force_per_length, Field& load) const {
  if (ends_.empty() || left < ends_.front() - kSamePlace) refuse_place(left);
  if (right > ends_.back() + kSamePlace) refuse_place(right);
  for (std::size_t i = 0; i < highest_.size(); ++i) {
    const double begin = std::max(left, ends_[i]), end = std::min(right, ends_[i + 1]);
    if (end <= begin) continue;
    const double middle =
        0.5 * (begin + end);  // shape functions are linear: their mean is that of the middle
    if (highest_[i] == kNone) refuse_place(middle);
    share(edges_[static_cast<std::size_t>(highest_[i])], middle, force_per_length * (end - begin), load);
  }
}

double TopSurface::Cover::top(double x) const {
  return height_on(from, to, x);
}

std::vector<TopSurface::Cover> TopSurface::covers(const std::vector<Point>& line) const {
  std::vector<Cover> covers;
  for (std::size_t i = 0; i < highest_.size(); ++i) {
    if (highest_[i] == kNone) continue;
    const Edge& edge = edges_[static_cast<std::size_t>(highest_[i])];
    for (std::size_t s = 0; s + 1 < line.size(); ++s) {
      const auto above = [&](double x) { return height_on(line[s], line[s + 1], x) - edge.height(x); };
      const auto [begin, end] =
          where_positive(above, std::max(ends_[i], line[s].x()), std::min(ends_[i + 1], line[s + 1].x()));
      if (end > begin) covers.push_back({&edge, line[s], line[s + 1], begin, end});
    }
  }
  return covers;
}

void TopSurface::add_soil(const std::vector<Point>& line, double mass_per_area,
                          Eigen::VectorXd& masses) const {
  const double kPlace = 0.5 / std::sqrt(3.0);
  for (const Cover& cover : covers(line)) {
    const Edge& edge = *cover.edge;
    for (const double place : {0.5 - kPlace, 0.5 + kPlace}) {
      const double x = cover.begin + place * (cover.end - cover.begin);
      const double height = std::max(0.0, cover.top(x) - edge.height(x));
      const double mass = 0.5 * (cover.end - cover.begin) * mass_per_area * height;
      masses[value(edge.left_node)] += (1.0 - edge.share_of_right(x)) * mass;
      masses[value(edge.right_node)] += edge.share_of_right(x) * mass;
    }
  }
}

std::vector<std::array<Point, 4>> TopSurface::soil(const std::vector<Point>& line) const {
  std::vector<std::array<Point, 4>> pieces;
  for (const Cover& cover : covers(line)) {
    const auto [begin, end] = std::pair{cover.begin, cover.end};
    pieces.push_back({Point(begin, cover.edge->height(begin)), Point(end, cover.edge->height(end)),
                      Point(end, cover.top(end)), Point(begin, cover.top(begin))});
  }
  return pieces;
}

}  // namespace voussoir
