#include "core/motion/motion_step.h"

#include "core/motion/motion_kernels.h"
#include "core/simd/lanes.h"

namespace voussoir {
namespace {

void add_element_forces(const MotionModel& model, Motion<double>& motion) {
  const Mesh& mesh = model.structure->mesh;
  for (std::size_t b = 0; b < mesh.block_triangles.size(); ++b)
    for (int triangle = mesh.block_triangles[b].begin; triangle < mesh.block_triangles[b].end; ++triangle) {
      const auto t = static_cast<std::size_t>(triangle);
      const auto& nodes = mesh.triangles[t].nodes;
      Vector6d q;
      for (std::size_t i = 0; i < 3; ++i) {
        const Pair<double>& place = motion.places[static_cast<std::size_t>(value(nodes[i]))];
        q.segment<2>(2 * static_cast<Eigen::Index>(i)) = Point(place.x, place.y) - mesh.position(nodes[i]);
      }
      const Vector6d force = triangle_force(model.triangles[t], model.moduli[b], model.thickness[b], q);
      for (std::size_t i = 0; i < 3; ++i) {
        Pair<double>& sum = motion.forces[static_cast<std::size_t>(value(nodes[i]))];
        sum = sum - Pair<double>{force[2 * static_cast<Eigen::Index>(i)],
                                 force[2 * static_cast<Eigen::Index>(i) + 1]};
      }
    }
}

}  // namespace

void take_implicit_step(const MotionModel& model, Motion<double>& motion) {
  follow_bonds(model, motion);
  implicit_step(model, motion);
}

VOUSSOIR_FOR_EVERY_PROCESSOR void take_implicit_step(const MotionModel& model, Motion<DoubleLanes>& motion) {
  follow_bonds(model, motion);
  implicit_step(model, motion);
}

void take_explicit_step(const MotionModel& model, Motion<double>& motion) {
  using Node = Pair<double>;
  follow_bonds(model, motion);
  const MotionView<double> view = view_of(motion);
  start_forces(model, view);
  add_element_forces(model, motion);
  start_report(motion);
  const BlockStep<double> step(model.step(), motion.damping);
  double longest = 0.0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BlockBody& body = model.bodies[b];
    add_weight(body, motion.load * view.present[b].value * model.gravity, view);
    report_balance(body, resultant(body, view.places[body.nodes.begin], view), model.per_weight[b], motion);
    for (int i = body.nodes.begin; i < body.nodes.end; ++i) {
      Node& rate = view.rates[i];
      rate = rate * step.kept + view.forces[i] * (step.gained / model.masses[i]);
      if (model.held[static_cast<std::size_t>(2 * i)]) rate.x = 0.0;
      if (model.held[static_cast<std::size_t>(2 * i + 1)]) rate.y = 0.0;
      view.moved[i] = rate * step.length;
      view.places[i] = view.places[i] + view.moved[i];
      longest = larger(longest, dot(view.moved[i], view.moved[i]));
    }
  }
  motion.travel += square_root(longest);
}

}  // namespace voussoir
