#include "core/motion/early_motion.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace voussoir {
namespace {

constexpr std::size_t kOfNode = 6, kOfBlock = 7;
constexpr std::size_t kBytesOfContact = 80;  // of the map; there are some two for each joint

template <class T>
void append(const Pair<T>& pair, int i, std::vector<double>& values) {
  values.push_back(lane(pair.x, i));
  values.push_back(lane(pair.y, i));
}

/// sum += factor * part
void add(const std::vector<double>& part, double factor, std::vector<double>& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * part[i];
}

void add(const MotionSnapshot& part, double factor, MotionSnapshot& sum) {
  add(part.nodes, factor, sum.nodes);
  add(part.frames, factor, sum.frames);
  for (const auto& [pair, shear] : part.shear) {
    auto& [at_0, at_1] = sum.shear[pair];
    at_0 += factor * shear.first;
    at_1 += factor * shear.second;
  }
}

/// What a scene's motion is put together from.
std::vector<Scene> parts_of(const Scene& scene) {
  std::vector<Scene> parts = {Scene{}};
  for (const BlockId block : scene.removed) parts.push_back(Scene{{block}});
  return parts;
}

template <class T>
void place_block(const BlockBody& body, const MotionSnapshot& snapshot, std::size_t block, int i,
                 Motion<T>& motion) {
  const double* frame = snapshot.frames.data() + kOfBlock * block;
  const double per_length = 1.0 / std::sqrt(frame[4] * frame[4] + frame[5] * frame[5]);
  const double cosine = per_length * frame[4], sine = per_length * frame[5];
  BlockFrame<T>& placed = motion.frames[block];
  set_pair(placed.centre, i, frame[0], frame[1]);
  set_pair(placed.velocity, i, frame[2], frame[3]);
  set_pair(placed.rotation, i, cosine, sine);
  set_lane(placed.spin, i, frame[6]);
  for (int k = 0; k < body.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(body.nodes.begin + k);
    const double* values = snapshot.nodes.data() + kOfNode * node;
    set_pair(motion.deformed[node], i, values[0], values[1]);
    set_pair(motion.rates[node], i, values[2], values[3]);
    set_pair(motion.moved[node], i, values[4], values[5]);
    const double x = values[0] + body.arms[2 * k], y = values[1] + body.arms[2 * k + 1];
    set_pair(motion.places[node], i, frame[0] + cosine * x - sine * y, frame[1] + sine * x + cosine * y);
  }
}

}  // namespace

template <class T>
MotionSnapshot take_snapshot(const Motion<T>& motion, int i) {
  MotionSnapshot result;
  for (std::size_t node = 0; node < motion.places.size(); ++node)
    for (const auto* pairs : {&motion.deformed, &motion.rates, &motion.moved})
      append((*pairs)[node], i, result.nodes);
  for (const BlockFrame<T>& frame : motion.frames) {
    append(frame.centre, i, result.frames);
    append(frame.velocity, i, result.frames);
    append(frame.rotation, i, result.frames);
    result.frames.push_back(lane(frame.spin, i));
  }
  for (std::size_t c = 0; c < motion.pairs.size(); ++c) {
    const std::pair shear = {lane(motion.shear[c].at_0, i), lane(motion.shear[c].at_1, i)};
    const bool is_found = lane(motion.found[c].value, i) != 0.0;
    if (is_found && shear != std::pair(0.0, 0.0))
      result.shear.emplace_hint(result.shear.end(), motion.pairs[c], shear);
  }
  return result;
}

MotionSnapshot superposed(const MotionSnapshot& intact, std::span<const MotionSnapshot* const> singles) {
  MotionSnapshot sum = intact;
  for (const MotionSnapshot* single : singles) {
    add(*single, 1.0, sum);
    add(intact, -1.0, sum);
  }
  return sum;
}

template <class T>
void place_snapshot(const MotionModel& model, const std::vector<bool>& removed,
                    const MotionSnapshot& snapshot, double margin, int i, Motion<T>& motion) {
  place_scene(model, removed, i, motion);
  for (std::size_t block = 0; block < model.bodies.size(); ++block)
    if (!removed[block]) place_block(model.bodies[block], snapshot, block, i, motion);
  search_contacts(model, margin, i, motion);
  for (std::size_t c = 0; c < motion.pairs.size(); ++c) {
    const auto known = snapshot.shear.find(motion.pairs[c]);
    if (known == snapshot.shear.end() || lane(motion.found[c].value, i) == 0.0) continue;
    set_lane(motion.shear[c].at_0, i, known->second.first);
    set_lane(motion.shear[c].at_1, i, known->second.second);
  }
}

std::vector<Scene> EarlyMotions::lacking(std::span<const Scene> scenes) const {
  std::set<Scene> result;
  for (const Scene& scene : scenes)
    for (const Scene& part : parts_of(scene))
      if (!snapshots_.contains(part)) result.insert(part);
  return {result.begin(), result.end()};
}

void EarlyMotions::add(std::span<const Scene> scenes, std::vector<MotionSnapshot> snapshots) {
  for (std::size_t i = 0; i < scenes.size(); ++i) snapshots_[scenes[i]] = std::move(snapshots[i]);
}

MotionSnapshot EarlyMotions::of(const Scene& scene) const {
  std::vector<const MotionSnapshot*> singles;
  for (const BlockId block : scene.removed) singles.push_back(&snapshots_.at(Scene{{block}}));
  return superposed(snapshots_.at(Scene{}), singles);
}

std::size_t memory_of_early_motions(const MotionModel& model) {
  const Structure& structure = *model.structure;
  const std::size_t numbers =
      kOfNode * static_cast<std::size_t>(structure.mesh.node_count()) + kOfBlock * model.bodies.size();
  const std::size_t one = sizeof(double) * numbers + 2 * kBytesOfContact * structure.joints.size();
  return (1 + model.bodies.size()) * one;
}

#define VOUSSOIR_INSTANTIATE(T)                                                                        \
  template MotionSnapshot take_snapshot<T>(const Motion<T>&, int);                                     \
  template void place_snapshot<T>(const MotionModel&, const std::vector<bool>&, const MotionSnapshot&, \
                                  double, int, Motion<T>&);
VOUSSOIR_INSTANTIATE(double)
VOUSSOIR_INSTANTIATE(DoubleLanes)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
