#include "core/motion/motion.h"

#include <algorithm>
#include <limits>

#include "core/law/joint_kinematics.h"
#include "core/statics/elements.h"

namespace voussoir {
namespace {

template <class T>
Eigen::Matrix2Xd places_in_lane(const Motion<T>& motion, int lane_index) {
  Eigen::Matrix2Xd places(2, static_cast<Eigen::Index>(motion.places.size()));
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Pair<T>& place = motion.places[static_cast<std::size_t>(i)];
    places.col(i) << lane(place.x, lane_index), lane(place.y, lane_index);
  }
  return places;
}

template <class T>
std::vector<bool> absent_in_lane(const Motion<T>& motion, int lane_index) {
  std::vector<bool> absent;
  for (const Cell<T>& present : motion.present) absent.push_back(lane(present.value, lane_index) == 0.0);
  return absent;
}

EdgeContact contact_of(const MotionModel& model, const EdgePair& pair) {
  EdgeContact contact = model.search.contact(pair);
  const auto [a, b] = model.search.blocks(pair);
  contact.quick = {model.pace.is_quick(a), model.pace.is_quick(b)};
  return contact;
}

/// Edges that a bond holds together, ascending.
std::vector<EdgePair> bonded_pairs(const MotionModel& model, const std::vector<MortarBond>& bonds) {
  std::vector<EdgePair> pairs;
  for (std::size_t k = 0; k < bonds.size(); ++k)
    if (bonds[k].holds) pairs.push_back(model.bonds[k].pair);
  return pairs;
}

/// Both ascending.
void leave_out(const std::vector<EdgePair>& some, std::vector<EdgePair>& pairs) {
  std::vector<EdgePair> others;
  std::ranges::set_difference(pairs, some, std::back_inserter(others));
  pairs = std::move(others);
}

/// Makes room for these pairs, and forgets those that no lane holds any more.
template <class T>
void add_contacts(const MotionModel& model, const std::vector<EdgePair>& added, Motion<T>& motion) {
  std::vector<EdgePair> pairs;
  for (std::size_t c = 0; c < motion.pairs.size(); ++c)
    if (any(motion.found[c].value > 0.0)) pairs.push_back(motion.pairs[c]);
  const auto kept = static_cast<std::ptrdiff_t>(pairs.size());
  pairs.insert(pairs.end(), added.begin(), added.end());
  std::inplace_merge(pairs.begin(), pairs.begin() + kept, pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  motion.quick_contacts.clear();
  std::vector<EdgeContact> contacts;
  std::vector<Cell<T>> found(pairs.size(), Cell<T>{T{}});
  std::vector<ContactShear<T>> shear(pairs.size(), ContactShear<T>{T{}, T{}});
  auto old = motion.pairs.begin();
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    old = std::lower_bound(old, motion.pairs.end(), pairs[c]);
    const bool known = old != motion.pairs.end() && *old == pairs[c];
    const auto at = static_cast<std::size_t>(old - motion.pairs.begin());
    contacts.push_back(known ? motion.contacts[at] : contact_of(model, pairs[c]));
    if (contacts.back().meets_quick()) motion.quick_contacts.push_back(static_cast<int>(c));
    if (!known) continue;
    found[c] = motion.found[at];
    shear[c] = motion.shear[at];
  }
  motion.pairs = std::move(pairs);
  motion.contacts = std::move(contacts);
  motion.found = std::move(found);
  motion.shear = std::move(shear);
}

/// The shear of a contact in one lane, at the ends of its stretch; none where there is no contact.
template <class T>
std::pair<double, double> elastic_slip(const Motion<T>& motion, const EdgePair& pair, int i) {
  const auto known = std::lower_bound(motion.pairs.begin(), motion.pairs.end(), pair);
  if (known == motion.pairs.end() || *known != pair) return {0.0, 0.0};
  const auto c = static_cast<std::size_t>(known - motion.pairs.begin());
  if (lane(motion.found[c].value, i) == 0.0) return {0.0, 0.0};
  return {lane(motion.shear[c].at_0, i), lane(motion.shear[c].at_1, i)};
}

}  // namespace

MotionModel::MotionModel(const Model& model, std::vector<BlockBody> bodies_, Pace pace_, double damping_,
                         double contact_damping_)
    : structure(&model),
      pace(std::move(pace_)),
      damping(damping_),
      contact_damping(contact_damping_),
      gravity(model.parameters.gravity),
      search(model),
      bonds(bonded_joints(model, search)),
      bodies(std::move(bodies_)),
      masses(lumped_masses(model)),
      held(held_components(model.supports, model.mesh)) {
  const Mesh& mesh = model.mesh;
  for (const Material& material : model.parameters.blocks) {
    moduli.push_back(plane_moduli(material));
    thickness.push_back(material.thickness);
  }
  for (const Triangle& triangle : mesh.triangles)
    triangles.push_back(triangle_shape(mesh.position(triangle.nodes[0]), mesh.position(triangle.nodes[1]),
                                       mesh.position(triangle.nodes[2])));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    response_of_block.push_back(responses.size());
    const Eigen::MatrixXd response =  // symmetric: rows are columns
        deformation_response(bodies[b], pace.is_quick(b) ? pace.quick_step() : pace.step);
    responses.insert(responses.end(), response.data(), response.data() + response.size());
  }
  weight = masses.sum() * gravity;
  for (const BlockBody& body : bodies)
    per_weight.push_back(gravity > 0.0 ? 1.0 / (body.mass * gravity) : 0.0);
}

double grown_share(double time, double ramp) {
  if (time >= ramp) return 1.0;
  const double x = time / ramp;
  return x * x * (3.0 - 2.0 * x);
}

template <class T>
Motion<T> at_rest(const MotionModel& model) {
  const Mesh& mesh = model.structure->mesh;
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  const Pair<T> nothing = {T{}, T{}};
  Motion<T> motion;
  motion.places.resize(nodes);
  motion.moved.resize(nodes);
  motion.forces.assign(nodes, nothing);
  motion.deformed.resize(nodes);
  motion.rates.resize(nodes);
  motion.frames.resize(model.bodies.size());
  motion.present.resize(model.bodies.size());
  int largest = 0;
  for (const BlockBody& body : model.bodies) largest = std::max(largest, body.nodes.size());
  motion.scratch.resize(static_cast<std::size_t>(largest));
  for (int i = 0; i < kLaneCount<T>; ++i)
    place_scene(model, std::vector<bool>(model.bodies.size(), false), i, motion);
  return motion;
}

template <class T>
void place_scene(const MotionModel& model, const std::vector<bool>& removed, int i, Motion<T>& motion) {
  const Mesh& mesh = model.structure->mesh;
  for (std::size_t node = 0; node < motion.places.size(); ++node) {
    const Point x = mesh.nodes.col(static_cast<Eigen::Index>(node));
    set_pair(motion.places[node], i, x.x(), x.y());
    set_pair(motion.moved[node], i, 0.0, 0.0);
    set_pair(motion.deformed[node], i, 0.0, 0.0);
    set_pair(motion.rates[node], i, 0.0, 0.0);
  }
  for (std::size_t b = 0; b < motion.frames.size(); ++b) {
    BlockFrame<T>& frame = motion.frames[b];
    set_pair(frame.centre, i, model.bodies[b].centre.x(), model.bodies[b].centre.y());
    set_pair(frame.velocity, i, 0.0, 0.0);
    set_pair(frame.rotation, i, 1.0, 0.0);
    set_lane(frame.spin, i, 0.0);
    set_lane(motion.present[b].value, i, removed[b] ? 0.0 : 1.0);
  }
  for (std::size_t c = 0; c < motion.pairs.size(); ++c) {
    set_lane(motion.found[c].value, i, 0.0);
    set_lane(motion.shear[c].at_0, i, 0.0);
    set_lane(motion.shear[c].at_1, i, 0.0);
  }
  motion.bonds[static_cast<std::size_t>(i)].assign(model.bonds.size(), {});
  set_lane(motion.load, i, 0.0);
  set_lane(motion.damping, i, model.damping);
  set_lane(motion.travel, i, std::numeric_limits<double>::infinity());  // no contacts are known
}

template <class T>
void search_contacts(const MotionModel& model, double margin, int i, Motion<T>& motion) {
  std::vector<EdgePair> found =
      model.search.candidates(places_in_lane(motion, i), absent_in_lane(motion, i), margin);
  if (!model.bonds.empty()) leave_out(bonded_pairs(model, motion.bonds[static_cast<std::size_t>(i)]), found);
  for (Cell<T>& cell : motion.found) set_lane(cell.value, i, 0.0);
  if (!std::includes(motion.pairs.begin(), motion.pairs.end(), found.begin(), found.end()))
    add_contacts(model, found, motion);
  auto pair = motion.pairs.begin();
  for (const EdgePair& each : found) {
    pair = std::lower_bound(pair, motion.pairs.end(), each);
    set_lane(motion.found[static_cast<std::size_t>(pair - motion.pairs.begin())].value, i, 1.0);
  }
  set_lane(motion.travel, i, 0.0);
}

template <class T>
void follow_bonds(const MotionModel& model, Motion<T>& motion) {
  if (model.bonds.empty()) return;
  motion.bond_forces.assign(motion.places.size(), {T{}, T{}});
  const double ahead = model.contact_damping / model.pace.step;
  for (int i = 0; i < kLaneCount<T>; ++i)
    for (std::size_t k = 0; k < model.bonds.size(); ++k) {
      const BondedJoint& joint = model.bonds[k];
      MortarBond& bond = motion.bonds[static_cast<std::size_t>(i)][k];
      const auto is_there = [&](std::size_t block) { return lane(motion.present[block].value, i) != 0.0; };
      if (!bond.holds || !is_there(joint.blocks[0]) || !is_there(joint.blocks[1])) continue;
      Vector8d displacement;
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto node = static_cast<std::size_t>(joint.nodes[corner]);
        const Pair<T> place = motion.places[node] + motion.moved[node] * ahead;
        displacement.segment<2>(2 * static_cast<Eigen::Index>(corner)) =
            Point(lane(place.x, i), lane(place.y, i)) -
            model.structure->mesh.position(NodeId{joint.nodes[corner]});
      }
      const Vector8d force = follow_bond(joint, displacement, bond);
      for (std::size_t corner = 0; corner < 4; ++corner) {
        Pair<T>& sum = motion.bond_forces[static_cast<std::size_t>(joint.nodes[corner])];
        const auto c = 2 * static_cast<Eigen::Index>(corner);
        set_pair(sum, i, lane(sum.x, i) + force[c], lane(sum.y, i) + force[c + 1]);
      }
      if (!bond.holds) set_lane(motion.travel, i, std::numeric_limits<double>::infinity());
    }
}

template <class T>
Field displacement(const MotionModel& model, const Motion<T>& motion, int lane_index) {
  Field field = places_in_lane(motion, lane_index) - model.structure->mesh.nodes;
  const std::vector<bool> absent = absent_in_lane(motion, lane_index);
  for (std::size_t b = 0; b < absent.size(); ++b)
    if (absent[b])
      field.middleCols(model.bodies[b].nodes.begin, model.bodies[b].nodes.size())
          .setConstant(std::numeric_limits<double>::quiet_NaN());
  return field;
}

template <class T>
Eigen::Matrix2Xd plastic_slip(const MotionModel& model, const Motion<T>& motion, int i) {
  if (!model.bonds.empty()) return {};
  const Structure& structure = *model.structure;
  const Eigen::Matrix2Xd moved = places_in_lane(motion, i) - structure.mesh.nodes;
  Eigen::Matrix2Xd slip(2, static_cast<Eigen::Index>(structure.joints.size()));
  Eigen::Index place = 0;
  for (const Joint& joint : structure.joints) {
    const JointFrame frame = make_joint_frame(joint, structure.mesh);
    const JointState state = joint_pose(frame, gathered(moved, corners(joint))).state;
    const auto [xi_0, xi_1] = elastic_slip(motion, model.search.pair_of(joint), i);  // s runs as in the joint
    slip.col(place++) << state[1] - xi_0, state[3] - xi_1;
  }
  return slip;
}

template <class T>
double kinetic_energy(const MotionModel& model, const Motion<T>& motion, int i) {
  double energy = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BlockBody& body = model.bodies[b];
    const BlockFrame<T>& frame = motion.frames[b];
    const double speed = std::hypot(lane(frame.velocity.x, i), lane(frame.velocity.y, i));
    const double spin = lane(frame.spin, i);
    energy += 0.5 * (body.mass * speed * speed + body.inertia * spin * spin);
    for (int node = body.nodes.begin; node < body.nodes.end; ++node) {
      const Pair<T>& rate = motion.rates[static_cast<std::size_t>(node)];
      const double u = std::hypot(lane(rate.x, i), lane(rate.y, i));
      energy += 0.5 * model.masses[node] * u * u;
    }
  }
  return energy;
}

#define VOUSSOIR_INSTANTIATE(T)                                                                \
  template Motion<T> at_rest<T>(const MotionModel&);                                           \
  template void place_scene<T>(const MotionModel&, const std::vector<bool>&, int, Motion<T>&); \
  template void search_contacts<T>(const MotionModel&, double, int, Motion<T>&);               \
  template void follow_bonds<T>(const MotionModel&, Motion<T>&);                               \
  template Field displacement<T>(const MotionModel&, const Motion<T>&, int);                   \
  template Eigen::Matrix2Xd plastic_slip<T>(const MotionModel&, const Motion<T>&, int);        \
  template double kinetic_energy<T>(const MotionModel&, const Motion<T>&, int);
VOUSSOIR_INSTANTIATE(double)
VOUSSOIR_INSTANTIATE(DoubleLanes)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
