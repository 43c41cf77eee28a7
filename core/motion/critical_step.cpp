#include "core/motion/critical_step.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

constexpr int kPowerIterations = 200;
constexpr int kInverseIterations = 30;
constexpr int kStepIterations = 4;
constexpr double kStays = 0.01;  ///< of a step, which stays if it changes by no more

/// A bonded joint as a spring between eight displacement components.
struct JointSpring {
  std::array<int, 4> nodes;
  Matrix8d stiffness;
};

std::vector<JointSpring> joint_springs(const Model& model) {
  std::vector<JointSpring> springs;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const Joint& joint = model.joints[j];
    const JointKinematics k = joint_kinematics(make_joint_frame(joint, model.mesh), Vector8d::Zero());
    const double area = joint.length * joint_thickness(joint, model.parameters);
    springs.push_back({.nodes = {value(joint.first_edge.from), value(joint.first_edge.to),
                                 value(joint.second_edge.from), value(joint.second_edge.to)},
                       .stiffness = k.gradient.transpose() *
                                    bonded_joint_tangent(joint_stiffness(model.parameters.joints[j], area)) *
                                    k.gradient});
  }
  return springs;
}

void add_spring_forces(const std::vector<JointSpring>& springs, const Eigen::VectorXd& u,
                       Eigen::VectorXd& forces) {
  for (const JointSpring& spring : springs) {
    Vector8d q;
    for (int i = 0; i < 4; ++i)
      q.segment<2>(2 * i) = u.segment<2>(2 * spring.nodes[static_cast<std::size_t>(i)]);
    const Vector8d f = spring.stiffness * q;
    for (int i = 0; i < 4; ++i)
      forces.segment<2>(2 * spring.nodes[static_cast<std::size_t>(i)]) += f.segment<2>(2 * i);
  }
}

/// Per block: what a step makes of forces that turn round in every step [1/kg].
std::vector<Eigen::MatrixXd> mobilities(const std::vector<BlockBody>& bodies, Integrator integrator,
                                        double step) {
  std::vector<Eigen::MatrixXd> result;
  for (const BlockBody& body : bodies)
    result.push_back(integrator == Integrator::implicit_blocks ? alternating_response(body, step)
                                                               : step_response(body, 0.0));
  return result;
}

/// A start vector with a part in every mode, the same on every machine.
Eigen::VectorXd start_vector(Eigen::Index size) {
  Eigen::VectorXd x(size);
  for (Eigen::Index i = 0; i < size; ++i) x[i] = std::sin(1.0 + 0.7 * static_cast<double>(i * i % 1009));
  return x;
}

/// `joint_share` multiplies the joints' stiffness: damped joints act on a step as stiffer ones.
double highest_frequency(const Model& model, const std::vector<BlockBody>& bodies, Integrator integrator,
                         double step, double joint_share, const std::vector<bool>& still) {
  const std::vector<JointSpring> springs = joint_springs(model);
  std::vector<Eigen::MatrixXd> mobility = mobilities(bodies, integrator, step);
  for (std::size_t b = 0; b < still.size(); ++b)
    if (still[b]) mobility[b].setZero();
  Eigen::VectorXd x = start_vector(2 * model.mesh.node_count());
  Eigen::VectorXd y(x.size());
  double squared = 0.0;
  for (int iteration = 0; iteration < kPowerIterations; ++iteration) {
    x.normalize();
    y.setZero();
    add_spring_forces(springs, x, y);
    y *= joint_share;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const IndexRange& nodes = bodies[b].nodes;
      if (integrator == Integrator::central_differences)
        y.segment(2 * nodes.begin, 2 * nodes.size()) +=
            bodies[b].stiffness * x.segment(2 * nodes.begin, 2 * nodes.size());
      y.segment(2 * nodes.begin, 2 * nodes.size()) =
          mobility[b] * y.segment(2 * nodes.begin, 2 * nodes.size());
    }
    squared = y.norm();
    x = y;
  }
  return std::sqrt(squared);
}

Eigen::VectorXd masses_of_unknowns(const Model& model, const EquilibriumSystem& system) {
  const Eigen::VectorXd masses = lumped_masses(model);
  Eigen::VectorXd result(system.unknown_count());
  for (int i = 0; i < result.size(); ++i)
    result[i] = masses[system.component[static_cast<std::size_t>(i)] / 2];
  return result;
}

/// How far the largest block sinks between two neighbours that hold it by shear alone, over faces as high as
/// itself [m].
double slump(const Model& model) {
  double largest = 0.0;
  for (const Block& block : model.layout.blocks) largest = std::max(largest, area(block.polygon));
  double heaviest = 0.0;
  for (const Material& material : model.parameters.blocks) heaviest = std::max(heaviest, material.density);
  double softest = model.parameters.contact.tangential_stiffness;
  for (const JointMaterial& joint : model.parameters.joints)
    softest = std::min(softest, joint.tangential_stiffness);
  return heaviest * model.parameters.gravity * std::sqrt(largest) / (2.0 * softest);
}

}  // namespace

double critical_step(const Model& model, const std::vector<BlockBody>& bodies, Integrator integrator,
                     double contact_damping, const std::vector<bool>& still) {
  if (integrator == Integrator::implicit_blocks) {
    const auto stable = [&](double step) {
      const double half_period = 2.0 / highest_frequency(model, bodies, integrator, step, 1.0, still);
      return std::hypot(contact_damping, half_period) - contact_damping;
    };
    // Elasticity as soft as a long step makes it, then as the step found makes it, until that one stays. The
    // steps only fall, as blocks seem softer in shorter ones.
    double before = 0.0;
    double step = stable(1.0);
    do {
      before = step;
      step = stable(before);
    } while (before - step > kStays * step);
    return step;
  }
  double step = 2.0 / highest_frequency(model, bodies, integrator, 0.0, 1.0, still);
  for (int i = 0; i < kStepIterations; ++i)  // the joints add little to the blocks' own frequencies
    step = 2.0 / highest_frequency(model, bodies, integrator, 0.0, 1.0 + 2.0 * contact_damping / step, still);
  return step;
}

std::vector<double> block_frequencies(const Model& model, const std::vector<BlockBody>& bodies, double step) {
  std::vector<Eigen::MatrixXd> stiffness;
  for (const BlockBody& body : bodies)
    stiffness.emplace_back(Eigen::MatrixXd::Zero(2 * body.nodes.size(), 2 * body.nodes.size()));
  const std::vector<JointSpring> springs = joint_springs(model);
  for (std::size_t j = 0; j < springs.size(); ++j)
    for (const int side : {0, 1}) {
      const BlockId block = side == 0 ? model.joints[j].first : model.joints[j].second;
      const int begin = bodies[static_cast<std::size_t>(block)].nodes.begin;
      for (int row = 2 * side; row < 2 * side + 2; ++row)
        for (int column = 2 * side; column < 2 * side + 2; ++column)
          stiffness[static_cast<std::size_t>(block)].block<2, 2>(
              2 * (springs[j].nodes[static_cast<std::size_t>(row)] - begin),
              2 * (springs[j].nodes[static_cast<std::size_t>(column)] - begin)) +=
              springs[j].stiffness.block<2, 2>(2 * row, 2 * column);
    }
  std::vector<double> frequencies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Eigen::MatrixXd rates = alternating_response(bodies[b], step) * stiffness[b];
    frequencies.push_back(std::sqrt(rates.eigenvalues().cwiseAbs().maxCoeff()));
  }
  return frequencies;
}

NaturalMotion natural_motion(const Model& model, const EquilibriumSystem& system) {
  const Coefficients coefficients(system, model.parameters);
  Eigen::SparseMatrix<double> stiffness = system.pattern;
  const Field forces =
      assemble(StageEquations(system, coefficients, Stage{}), Field::Zero(2, model.mesh.node_count()), 1.0,
               {.first = stiffness.valuePtr(), .stride = 1});
  Eigen::VectorXd load(system.unknown_count());
  for (int i = 0; i < load.size(); ++i)
    load[i] = forces.data()[system.component[static_cast<std::size_t>(i)]];
  const Eigen::VectorXd masses = masses_of_unknowns(model, system);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> linear(stiffness);
  const Eigen::VectorXd sag = linear.solve(load);
  Eigen::VectorXd mode = start_vector(load.size());
  double squared = 0.0;
  for (int iteration = 0; iteration < kInverseIterations; ++iteration) {
    const Eigen::VectorXd inertia = masses.cwiseProduct(mode);
    mode = linear.solve(inertia);
    squared = mode.dot(inertia) / mode.dot(masses.cwiseProduct(mode));
    mode.normalize();
  }
  return {.frequency = std::sqrt(squared),
          .sag = std::max(sag.cwiseAbs().maxCoeff(), slump(model)),
          .work = 0.5 * load.dot(sag)};
}

}  // namespace voussoir
