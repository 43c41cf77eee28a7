#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "generator/scenes/start_field.h"

namespace voussoir {
namespace {

constexpr double kGone = std::numeric_limits<double>::quiet_NaN();

Field row(double a, double b) {
  Field field(2, 2);
  field << a, b, 2.0 * a, 2.0 * b;
  return field;
}

Solution standing(const Field& displacement) {
  Solution solution;
  solution.displacement = displacement;
  solution.outcome = Outcome::standing;
  return solution;
}

Solution collapsed(const Field& displacement) {
  Solution solution = standing(displacement);
  solution.outcome = Outcome::collapsed;
  return solution;
}

Scene without(std::initializer_list<int> blocks) {
  Scene scene;
  for (const int block : blocks) scene.removed.push_back(BlockId{block});
  return scene;
}

}  // namespace

TEST_CASE("The intact bridge starts from zero and a single from the intact field") {
  StartingFields starts;
  CHECK_FALSE(starts.start_for(Scene{}).has_value());
  CHECK_FALSE(starts.start_for(without({1})).has_value());
  starts.add(Scene{}, 0, standing(row(1.0, 2.0)));
  CHECK_FALSE(starts.start_for(Scene{}).has_value());
  CHECK(*starts.start_for(without({1})) == row(1.0, 2.0));
}

TEST_CASE("What has slipped before adds up like the fields, and is nothing where nothing has (by hand)") {
  StartingFields starts;
  Solution intact = standing(row(1.0, 2.0)), first = standing(row(1.0, 2.0)), second = first;
  starts.add(Scene{}, 0, intact);
  starts.add(without({2}), 0, second);
  CHECK(starts.slipped_for(without({1, 2})).size() == 0);
  first.slipped = row(3.0, 5.0);
  starts.add(without({1}), 0, first);
  CHECK(starts.slipped_for(without({3})).size() == 0);
  CHECK(starts.slipped_for(without({1, 2})) == row(3.0, 5.0));
  CHECK(starts.slipped(without({1})) == row(3.0, 5.0));
  CHECK(starts.slipped(without({2})).size() == 0);
  intact.slipped = row(1.0, 1.0);
  starts.add(Scene{}, 0, intact);
  CHECK(starts.slipped_for(without({3})) == row(1.0, 1.0));
  CHECK(starts.slipped_for(without({1, 2})) == row(2.0, 4.0));  // 1 + (3 - 1) + (0 - 1)
  CHECK(starts.slipped_for(Scene{}).size() == 0);
}

TEST_CASE("A pair starts from the superposition of its singles, written out by hand") {
  StartingFields starts;
  starts.add(Scene{}, 0, standing(row(1.0, 2.0)));
  starts.add(without({0}), 0, standing(row(1.5, 2.5)));
  starts.add(without({1}), 0, standing(row(1.25, 3.0)));
  CHECK(*starts.start_for(without({0, 1})) == row(1.5 + 1.25 - 1.0, 2.5 + 3.0 - 2.0));
}

TEST_CASE("Where a removed block has no displacement the start is zero") {
  StartingFields starts;
  starts.add(Scene{}, 0, standing(row(1.0, 2.0)));
  starts.add(without({0}), 0, standing(row(kGone, 2.5)));
  CHECK(*starts.start_for(without({0, 1})) == row(0.0, 2.5));
}

TEST_CASE("Singles that do not stand take no part in the start") {
  StartingFields starts;
  starts.add(Scene{}, 0, standing(row(1.0, 2.0)));
  starts.add(without({0}), 0, collapsed(row(1000.0, 1000.0)));
  starts.add(without({1}), 0, standing(row(1.25, 3.0)));
  CHECK(*starts.start_for(without({0, 1})) == row(1.25, 3.0));
  CHECK(*starts.start_for(without({0, 2})) == row(1.0, 2.0));
}

TEST_CASE("Nothing starts from an intact bridge that does not stand") {
  StartingFields starts;
  starts.add(Scene{}, 0, collapsed(row(1000.0, 1000.0)));
  CHECK_FALSE(starts.start_for(without({1})).has_value());
}

TEST_CASE(
    "A later state starts from the scene's own plus what the intact bridge and the singles change (by "
    "hand)") {
  StartingFields starts;
  const Field own = row(10.0, kGone);
  CHECK(starts.start_after(without({0, 1}), own, 0, 1) == row(10.0, 0.0));
  starts.add(Scene{}, 0, standing(row(1.0, 2.0)));
  starts.add(Scene{}, 1, standing(row(1.5, 2.25)));  // changes by 0.5 and 0.25
  CHECK(starts.start_after(Scene{}, own, 0, 1) == row(10.0, 0.0));
  CHECK(starts.start_after(without({0}), row(10.0, 20.0), 0, 1) == row(10.5, 20.25));
  starts.add(without({0}), 0, standing(row(3.0, 4.0)));
  starts.add(without({0}), 1, standing(row(4.0, 5.0)));  // by 1 and 1
  CHECK(starts.start_after(without({0}), row(10.0, 20.0), 0, 1) == row(10.5, 20.25));
  CHECK(starts.start_after(without({0, 1}), row(10.0, 20.0), 0, 1) == row(10.0 + 1.0, 20.0 + 1.0));
  starts.add(without({1}), 0, standing(row(3.0, 4.0)));
  starts.add(without({1}), 1, collapsed(row(99.0, 99.0)));
  CHECK(starts.start_after(without({0, 1}), row(10.0, 20.0), 0, 1) == row(10.0 + 1.0, 20.0 + 1.0));
}

TEST_CASE("A pair is likely to have no answer if the intact bridge or one of its singles has none") {
  StartingFields starts;
  starts.add(without({0}), 0, Solution{});
  starts.add(without({1}), 0, standing(row(1.0, 2.0)));
  CHECK(starts.open_likely(without({0, 1}), 0));
  CHECK_FALSE(starts.open_likely(without({1, 3}), 0));
  CHECK_FALSE(starts.open_likely(without({0, 1}), 1));  // another state
  CHECK_FALSE(starts.open_likely(without({0}), 0));     // a single says nothing of itself
  starts.add(Scene{}, 0, Solution{});
  CHECK(starts.open_likely(without({3}), 0));
  CHECK_FALSE(starts.open_likely(Scene{}, 0));
}

TEST_CASE("A pair is likely to fall if what falls without one of its blocks is there (written out by hand)") {
  StartingFields starts;
  Solution fall = collapsed(row(1.0, 2.0));
  fall.moving = {BlockId{3}};
  starts.add(without({0}), 0, fall);
  starts.add(without({1}), 0, standing(row(1.0, 2.0)));
  CHECK(starts.falls_likely(without({0, 1}), 0));
  CHECK_FALSE(starts.falls_likely(without({0, 3}), 0));  // nothing is left to fall
  CHECK_FALSE(starts.falls_likely(without({1, 3}), 0));
  CHECK_FALSE(starts.falls_likely(without({0, 1}), 1));  // another state
  CHECK_FALSE(starts.falls_likely(without({0}), 0));     // a single says nothing of itself

  CHECK_FALSE(starts.falls_by_one(without({0, 1}), 0));  // the intact bridge is not known to stand
  starts.add(Scene{}, 0, standing(row(1.0, 2.0)));
  CHECK(starts.falls_by_one(without({0, 1}), 0));
  CHECK_FALSE(starts.falls_by_one(without({0, 3}), 0));  // nothing is left to fall
  CHECK_FALSE(starts.falls_by_one(without({0, 2}), 0));  // what the other does alone is not known
  starts.add(without({2}), 0, fall);
  CHECK_FALSE(starts.falls_by_one(without({0, 2}), 0));  // both do
  CHECK_FALSE(starts.falls_by_one(without({0, 1, 4}), 0));

  starts.add(Scene{}, 0, fall);
  CHECK(starts.falls_likely(without({0}), 0));  // the bridge itself falls
  CHECK_FALSE(starts.falls_likely(without({3}), 0));
}

}  // namespace voussoir
