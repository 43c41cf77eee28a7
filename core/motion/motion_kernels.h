#pragma once
/// @file The inner loops of a time step, for any number of lanes. Included by one source file for each
/// instruction set.

#include "core/motion/motion.h"

namespace voussoir {

/// What the kernels see of a Motion.
template <class T>
struct MotionView {
  Pair<T>* places;
  Pair<T>* moved;
  Pair<T>* forces;
  Pair<T>* deformed;
  Pair<T>* rates;
  BlockFrame<T>* frames;
  const Cell<T>* present;
  const Pair<T>* pushes;       ///< null: none
  const Pair<T>* bond_forces;  ///< null: there are no bonds
  const EdgeContact* contacts;
  const Cell<T>* found;
  ContactShear<T>* shear;
  std::size_t contact_count;
  const int* quick_contacts;
  std::size_t quick_contact_count;
  std::size_t node_count;
  Pair<T>* scratch;
};

template <class T>
MotionView<T> view_of(Motion<T>& motion) {
  return {.places = motion.places.data(),
          .moved = motion.moved.data(),
          .forces = motion.forces.data(),
          .deformed = motion.deformed.data(),
          .rates = motion.rates.data(),
          .frames = motion.frames.data(),
          .present = motion.present.data(),
          .pushes = motion.pushes.empty() ? nullptr : motion.pushes.data(),
          .bond_forces = motion.bond_forces.empty() ? nullptr : motion.bond_forces.data(),
          .contacts = motion.contacts.data(),
          .found = motion.found.data(),
          .shear = motion.shear.data(),
          .contact_count = motion.contacts.size(),
          .quick_contacts = motion.quick_contacts.data(),
          .quick_contact_count = motion.quick_contacts.size(),
          .node_count = motion.places.size(),
          .scratch = motion.scratch.data()};
}

/// When a contact is looked at.
struct ContactMoment {
  double ahead;        ///< contact damping in the steps that its nodes' last movements are of
  double part = 1.0;   ///< that a short step is of a step
  int steps_past = 0;  ///< short steps since the nodes of other blocks have been placed
};

/// forces += contact, at the places that the nodes will have `ahead` steps later: contact damping. Blocks
/// that are not quick go on as in the last step and take a part of the force in each short step.
template <class T>
VOUSSOIR_INLINE void add_contact_forces(std::size_t c, const ContactMoment& moment,
                                        const MotionView<T>& view) {
  const EdgeContact& contact = view.contacts[c];
  EdgePlaces<T> edges;
  edges.ahead = moment.ahead;
  for (std::size_t i = 0; i < 4; ++i) {
    const bool waits = !contact.quick[i / 2];
    edges.moved[i] = view.moved[contact.nodes[i]] * (waits ? moment.part : 1.0);
    edges.now[i] =
        view.places[contact.nodes[i]] + edges.moved[i] * (moment.ahead + (waits ? moment.steps_past : 0));
  }
  EdgeForces<T> forces;
  if (contact_forces<T>(contact, view.found[c].value, edges, view.shear[c], forces))
    for (std::size_t i = 0; i < 4; ++i)
      view.forces[contact.nodes[i]] =
          view.forces[contact.nodes[i]] + forces[i] * (contact.quick[i / 2] ? 1.0 : moment.part);
}

template <class T>
VOUSSOIR_INLINE Pair<T> turned(const Pair<T>& v, const Pair<T>& rotation) {
  return {rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y};
}

template <class T>
VOUSSOIR_INLINE Pair<T> turned_back(const Pair<T>& v, const Pair<T>& rotation) {
  return {rotation.x * v.x + rotation.y * v.y, rotation.x * v.y - rotation.y * v.x};
}

/// The rotation by a small angle more: the rational approximation of the rotation matrix, made a unit vector
/// again.
template <class T>
VOUSSOIR_INLINE Pair<T> turned_by(const Pair<T>& rotation, T angle) {
  const T half = 0.5 * angle;
  const T tangent = half * (1.0 + half * half * (1.0 / 3.0));
  const T squared = tangent * tangent;
  const T scale = 1.0 / (1.0 + squared);
  const Pair<T> result = turned<T>({(1.0 - squared) * scale, 2.0 * tangent * scale}, rotation);
  return result * (1.5 - 0.5 * dot(result, result));
}

/// What a step of some length is for a block.
template <class T>
struct BlockStep {
  VOUSSOIR_INLINE BlockStep(double length_, const T& damping)
      : length(length_), gained(length / (1.0 + 0.5 * length * damping)), kept(1.0 - damping * gained) {}
  double length;  ///< [s]
  T gained;       ///< time for which a force acts [s]
  T kept;         ///< share of a velocity that damping leaves
};

/// A resultant force and its moment about the block's centre.
template <class T>
struct Resultant {
  Pair<T> force;
  T moment;
};

template <class T>
VOUSSOIR_INLINE Resultant<T> resultant(const BlockBody& body, const Pair<T>& centre,
                                       const MotionView<T>& view) {
  Resultant<T> sum = {{T{}, T{}}, T{}};
  for (int i = body.nodes.begin; i < body.nodes.end; ++i) {
    const Pair<T>& force = view.forces[i];
    const Pair<T> arm = view.places[i] - centre;
    sum.force = sum.force + force;
    sum.moment += arm.x * force.y - arm.y * force.x;
  }
  return sum;
}

/// u_new = response (M (u + kept dt du/dt) + dt^2 R^T f)
template <class T>
VOUSSOIR_INLINE void deform(const BlockBody& body, const double* response, const BlockStep<T>& step,
                            const Pair<T>& rotation, const MotionView<T>& view) {
  const int n = body.nodes.size();
  const double* masses = body.masses.data();
  const T carried = step.kept * step.length;
  for (int i = 0; i < n; ++i) {
    const int node = body.nodes.begin + i;
    view.scratch[i] = (view.deformed[node] + view.rates[node] * carried) * masses[2 * i] +
                      turned_back(view.forces[node], rotation) * (step.length * step.length);
  }
  const double per_step = 1.0 / step.length;
  for (int i = 0; i < n; ++i) {
    const double* row_x = response + static_cast<std::ptrdiff_t>(4 * i) * n;
    const double* row_y = row_x + 2 * n;
    Pair<T> from_x = {T{}, T{}};
    Pair<T> from_y = {T{}, T{}};
    for (int j = 0; j < n; ++j) {
      const Pair<T>& r = view.scratch[j];
      from_x.x += row_x[2 * j] * r.x;
      from_y.x += row_x[2 * j + 1] * r.y;
      from_x.y += row_y[2 * j] * r.x;
      from_y.y += row_y[2 * j + 1] * r.y;
    }
    const int node = body.nodes.begin + i;
    const Pair<T> u = from_x + from_y;
    view.rates[node] = (u - view.deformed[node]) * per_step;
    view.deformed[node] = u;
  }
}

/// Places of a block's nodes from its frame and deformation; returns the square of the longest way of a node.
template <class T>
VOUSSOIR_INLINE T place_nodes(const BlockBody& body, const BlockFrame<T>& frame, const MotionView<T>& view) {
  T longest{};
  const double* arms = body.arms.data();
  for (int i = 0; i < body.nodes.size(); ++i) {
    const int node = body.nodes.begin + i;
    const Pair<T> local = {view.deformed[node].x + arms[2 * i], view.deformed[node].y + arms[2 * i + 1]};
    const Pair<T> place = frame.centre + turned(local, frame.rotation);
    view.moved[node] = place - view.places[node];
    view.places[node] = place;
    longest = larger(longest, dot(view.moved[node], view.moved[node]));
  }
  return longest;
}

/// Moves a block that supports hold altogether to where they are when this share of gravity acts, so slowly
/// that it has no speed of its own.
template <class T>
VOUSSOIR_INLINE void carry(const BlockBody& body, const Field& carried, const T& share,
                           const MotionView<T>& view) {
  for (int node = body.nodes.begin; node < body.nodes.end; ++node) {
    view.deformed[node] = {share * carried(0, node), share * carried(1, node)};
    view.rates[node] = {T{}, T{}};
  }
}

/// Adds a block's weight to the forces on its nodes.
template <class T>
VOUSSOIR_INLINE void add_weight(const BlockBody& body, T pull, const MotionView<T>& view) {
  const double* masses = body.masses.data();
  for (int i = 0; i < body.nodes.size(); ++i) {
    T& force = view.forces[body.nodes.begin + i].y;
    force = force - pull * masses[2 * i];
  }
}

/// Central differences for a free block's frame. Damping acts on the mean of the velocities before and after,
/// so that `kept` of the old one is left and the force acts for the time `gained`.
template <class T>
VOUSSOIR_INLINE void move_frame(const BlockBody& body, const Resultant<T>& sum, const BlockStep<T>& step,
                                BlockFrame<T>& frame) {
  frame.velocity = frame.velocity * step.kept + sum.force * step.gained * (1.0 / body.mass);
  frame.spin = frame.spin * step.kept + sum.moment * step.gained * (1.0 / body.inertia);
  frame.centre = frame.centre + frame.velocity * step.length;
  frame.rotation = turned_by<T>(frame.rotation, frame.spin * step.length);
}

/// Notes how far a block's forces are from balance, in the directions in which it is free.
template <class T>
VOUSSOIR_INLINE void report_balance(const BlockBody& body, const Resultant<T>& sum, double per_weight,
                                    Motion<T>& motion) {
  const T left = (body.free_x ? magnitude(sum.force.x) : T{}) + (body.free_y ? magnitude(sum.force.y) : T{});
  motion.unbalanced += left;
  motion.largest_unbalanced = larger(motion.largest_unbalanced, left * per_weight);
}

template <class T>
VOUSSOIR_INLINE void clear_forces(const IndexRange& nodes, const MotionView<T>& view) {
  for (int i = nodes.begin; i < nodes.end; ++i)
    view.forces[i] = view.pushes != nullptr ? view.pushes[i] : Pair<T>{T{}, T{}};
  if (view.bond_forces == nullptr) return;
  for (int i = nodes.begin; i < nodes.end; ++i) view.forces[i] = view.forces[i] + view.bond_forces[i];
}

/// forces += contact, but for quick blocks.
template <class T>
VOUSSOIR_INLINE void add_contact_forces(const MotionModel& model, const MotionView<T>& view) {
  const ContactMoment now{.ahead = model.contact_damping / model.pace.step};
  for (std::size_t c = 0; c < view.contact_count; ++c)
    if (!view.contacts[c].meets_quick()) add_contact_forces(c, now, view);
}

/// forces = pushes + bonds + contact, but for quick blocks.
template <class T>
VOUSSOIR_INLINE void start_forces(const MotionModel& model, const MotionView<T>& view) {
  clear_forces({0, static_cast<int>(view.node_count)}, view);
  add_contact_forces(model, view);
}

/// A block's step under the forces that act on it; returns the square of the longest way of a node.
template <class T>
VOUSSOIR_INLINE T move_block(const MotionModel& model, std::size_t b, const BlockStep<T>& step,
                             const MotionView<T>& view, Motion<T>& motion) {
  const BlockBody& body = model.bodies[b];
  BlockFrame<T>& frame = view.frames[b];
  add_weight<T>(body, motion.load * view.present[b].value * model.gravity, view);
  const Resultant<T> sum = resultant(body, frame.centre, view);
  report_balance(body, sum, model.per_weight[b], motion);
  deform(body, model.responses.data() + model.response_of_block[b], step, frame.rotation, view);
  if (!body.held)
    move_frame(body, sum, step, frame);
  else if (model.carries(b))
    carry(body, model.carried, motion.load, view);
  return place_nodes(body, frame, view);
}

template <class T>
VOUSSOIR_INLINE void start_report(Motion<T>& motion) {
  motion.unbalanced = T{};
  motion.largest_unbalanced = T{};
}

/// The quick blocks' short steps; what they do to the others is in the forces then, and how far they are from
/// balance at the end in the motion.
template <class T>
VOUSSOIR_INLINE void take_short_steps(const MotionModel& model, const MotionView<T>& view,
                                      Motion<T>& motion) {
  const BlockStep<T> step(model.pace.quick_step(), motion.damping);
  ContactMoment moment{.ahead = model.contact_damping / step.length, .part = 1.0 / model.pace.parts};
  for (int k = 0; k < model.pace.parts; ++k) {
    moment.steps_past = k;
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (model.pace.quick[b]) clear_forces(model.bodies[b].nodes, view);
    for (std::size_t i = 0; i < view.quick_contact_count; ++i)
      add_contact_forces(static_cast<std::size_t>(view.quick_contacts[i]), moment, view);
    start_report(motion);
    T longest{};
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (model.pace.quick[b]) longest = larger(longest, move_block(model, b, step, view, motion));
    motion.travel += square_root(longest);
  }
}

/// One implicit step in all lanes.
template <class T>
VOUSSOIR_INLINE void implicit_step(const MotionModel& model, Motion<T>& motion) {
  const MotionView<T> view = view_of(motion);
  clear_forces({0, static_cast<int>(view.node_count)}, view);
  start_report(motion);
  if (model.pace.parts > 1) take_short_steps(model, view, motion);
  add_contact_forces(model, view);
  const BlockStep<T> step(model.pace.step, motion.damping);
  T longest{};
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.pace.is_quick(b)) longest = larger(longest, move_block(model, b, step, view, motion));
  motion.travel += square_root(longest);
}

}  // namespace voussoir
