#pragma once
/// @file How time and memory of a scene grow with a bridge's blocks, its joints' stiffness and its smallest
/// piece.

#include <functional>
#include <string>
#include <vector>

#include "core/structure/bridge_description.h"

namespace voussoir {

/// One bridge.
struct GrowthPoint {
  double x = 0.0;  ///< what grows
  int blocks = 0;
  int standing = 0, collapsed = 0, unresolved = 0;
  double seconds = 0.0;    ///< of processor time a scene
  double megabytes = 0.0;  ///< of memory that a solver takes
};

struct Growth {
  std::string name;  ///< of its picture: "blocks", "stiffness", "piece"
  std::string unit;  ///< what grows, with its unit
  std::vector<GrowthPoint> points;
};

/// The least-squares exponent b of y = a x^b.
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

/// The reference bridge with so many spans, one beside the other.
BridgeDescription viaduct(int spans);

/// The reference bridge with its ring so much lower that the smallest wall piece is nearest to this area
/// [m2].
BridgeDescription with_smallest_piece(double area);

/// Viaducts of 1 to `most_spans` (doubled) of which some singles of wall blocks are solved, by Newton alone;
/// p_n from 1e7 to 1e12 Pa/m and smallest pieces from 1e-6 to 0.1 m2 of the reference bridge, of which
/// `scenes` singles (0: all), evenly spread, and intact are solved as build-database solves them. `progress`
/// is told each point.
std::vector<Growth> measure_growth(int most_spans, int scenes,
                                   const std::function<void(const Growth&)>& progress);

/// A table (Markdown) with the fitted exponents.
std::string to_markdown(const Growth& growth);

/// Time and, where the bridges differ in size, memory over what grows.
std::string to_svg(const Growth& growth);

}  // namespace voussoir
