#pragma once
/// @file Drawings as DXF.

#include <fmt/format.h>

#include <string>

#include "core/geometry/polygon.h"

namespace voussoir::test {

inline std::string lwpolyline(const std::string& layer, const Polygon& polygon, int flags = 1) {
  std::string text = fmt::format("0\nLWPOLYLINE\n8\n{}\n90\n{}\n70\n{}\n", layer, polygon.size(), flags);
  for (const Point& p : polygon) text += fmt::format("10\n{}\n20\n{}\n", p.x(), p.y());
  return text;
}

inline std::string dxf_drawing(const std::string& entities, const std::string& header = "") {
  return "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

inline const Polygon kSquare = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}};

}  // namespace voussoir::test
