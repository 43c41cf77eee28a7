/// @file Where sensors are. Oracle: the corners and the middle of a unit block.

#include "lookup/report/pictured_answer.h"

#include <catch2/catch.hpp>

#include "tests/lookup/synthetic_library.h"

using namespace voussoir;

TEST_CASE("Only heights on the upper face of the highest course are on top") {
  const test::SyntheticLibrary synthetic(3, 6);
  std::vector<StoredPoint> points = synthetic.points;
  points[2].position = Point(1.5, 2.5);   // the middle of a block's face, as in [control_points] face
  points[4].position = Point(2.5, 3.0);   // a sensor that stands between two corners
  points[6].position = Point(3.0, 2.9);   // a tenth of a metre below the corner
  points[8].position = Point(4.0, 2.98);  // within what places of sensors are off by
  Comparison comparison = absolute_readings({synthetic.table, points, synthetic.layout, {}},
                                            as_measurements(synthetic.table.row(8)));
  comparison.quantity.assign(points.size(), Quantity::uy);
  comparison.quantity[10] = Quantity::tilt;
  const Answer answer = locate_damage(absolute_readings(synthetic.library(), comparison.measured), {});
  const PicturedAnswer report(answer, comparison);
  CHECK(site_of(report, 0) == Site::top);
  CHECK(site_of(report, 2) == Site::elsewhere);
  CHECK(site_of(report, 4) == Site::top);
  CHECK(site_of(report, 6) == Site::elsewhere);
  CHECK(site_of(report, 8) == Site::top);
  CHECK(site_of(report, 10) == Site::elsewhere);
}
