/// @file Motions that begin where their singles' add up to, against the same motions from rest.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/motion/dynamic_solver.h"
#include "core/motion/early_motion.h"
#include "core/structure/neighbours.h"
#include "tests/support/bridges.h"

namespace voussoir {
namespace {

const Model& moving_bridge() {
  static const Model bridge = make_model(test::small_description());
  return bridge;
}

std::vector<DynamicSolution> motions(std::span<const Scene> scenes, MotionStart start,
                                     DynamicSettings settings = {}) {
  const std::vector<MotionStart> starts(scenes.size(), start);
  return DynamicSolver(moving_bridge(), settings).solve(scenes, settings.decision, starts);
}

/// Sum of differences over the sum of what there should be.
double l1_difference(const Field& field, const Field& expected) {
  REQUIRE((field.array().isNaN() == expected.array().isNaN()).all());
  const auto sum = [](const Field& values) {
    return values.array().isNaN().select(0.0, values).cwiseAbs().sum();
  };
  return sum(field - expected) / sum(expected);
}

void check_alike(std::span<const Scene> scenes, std::span<const DynamicSolution> found,
                 std::span<const DynamicSolution> expected, double most) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    INFO(to_string(scenes[i], moving_bridge().layout));
    CHECK(found[i].solution.outcome == expected[i].solution.outcome);
    CHECK(found[i].solution.extent == expected[i].solution.extent);
    CHECK(l1_difference(found[i].solution.displacement, expected[i].solution.displacement) < most);
  }
}

std::vector<Scene> pairs_apart_of_which_one_falls() {
  const std::vector<Scene> singles = [] {
    std::vector<Scene> scenes = all_scenes(moving_bridge().layout.blocks.size(), 1);
    scenes.erase(scenes.begin());
    return scenes;
  }();
  const std::vector<DynamicSolution> alone = motions(singles, MotionStart::at_rest);
  std::vector<Scene> pairs;
  for (std::size_t i = 0; i < singles.size(); ++i)
    for (std::size_t j = i + 1; j < singles.size(); ++j)
      if ((alone[i].solution.outcome == Outcome::collapsed) !=
          (alone[j].solution.outcome == Outcome::collapsed))
        pairs.push_back({{singles[i].removed.front(), singles[j].removed.front()}});
  std::erase_if(pairs, [](const Scene& pair) { return is_one_group(pair, moving_bridge()); });
  return pairs;
}

}  // namespace

TEST_CASE("A motion goes on from a snapshot as if it had not been taken (the motion without)") {
  const std::vector<Scene> scenes = {Scene{}, parse_scene("0,3", moving_bridge().layout),
                                     parse_scene("0,5", moving_bridge().layout)};
  const auto expected = motions(scenes, MotionStart::at_rest);
  const auto found = motions(scenes, MotionStart::from_singles);
  check_alike(scenes, found, expected, 1e-8);
  for (std::size_t i = 0; i < scenes.size(); ++i)
    CHECK(found[i].solution.iterations == expected[i].solution.iterations);
}

TEST_CASE(
    "Pairs apart of which one block's absence lets something fall move as from rest (the motion from rest)",
    "[many-solutions]") {
  const std::vector<Scene> pairs = pairs_apart_of_which_one_falls();
  REQUIRE(pairs.size() > 50);
  const auto expected = motions(pairs, MotionStart::at_rest);
  const auto found = motions(pairs, MotionStart::from_singles);
  check_alike(pairs, found, expected, 0.005);
}

TEST_CASE(
    "Early motions that are not skipped are followed from rest, to the last bit (the motion from rest)") {
  const std::vector<Scene> scenes = {parse_scene("0,3+1,1", moving_bridge().layout)};
  DynamicSettings all;
  all.skips.early_motions = false;
  const Field expected = motions(scenes, MotionStart::at_rest).front().solution.displacement;
  const Field found = motions(scenes, MotionStart::from_singles, all).front().solution.displacement;
  CHECK(((found.array() == expected.array()) || (found.array().isNaN() && expected.array().isNaN())).all());
}

TEST_CASE("A motion that would begin at the moment of its field begins at rest (the motion from rest)") {
  DynamicSettings slow;
  slow.ramp = 3.0 * slow.moment;  // a third of it is the moment
  slow.step = 1.25e-4;
  const std::vector<Scene> scenes = {parse_scene("0,3+1,1", moving_bridge().layout)};
  check_alike(scenes, motions(scenes, MotionStart::from_singles, slow),
              motions(scenes, MotionStart::at_rest, slow), 1e-12);
}

TEST_CASE("Number by number, what two blocks change adds up (written out)") {
  const MotionSnapshot intact{{1.0, 2.0}, {3.0}, {{{1, 2}, {0.5, 0.25}}}};
  const MotionSnapshot first{{1.5, 2.0}, {4.0}, {{{1, 2}, {1.0, 0.25}}, {{3, 4}, {2.0, 0.0}}}};
  const MotionSnapshot second{{1.0, 1.0}, {5.0}, {}};
  const MotionSnapshot sum = superposed(intact, std::array{&first, &second});
  CHECK(sum.nodes == std::vector{1.5, 1.0});
  CHECK(sum.frames == std::vector{6.0});
  CHECK(sum.shear.at({1, 2}) == std::pair(0.5, 0.0));
  CHECK(sum.shear.at({3, 4}) == std::pair(2.0, 0.0));
}

}  // namespace voussoir
