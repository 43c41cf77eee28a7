#include "core/motion/block_dynamics.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/law/triangle.h"

namespace voussoir {
namespace {

void add_stiffness(const Mesh& mesh, const Triangle& triangle, const Material& material, BlockBody& body) {
  const auto& nodes = triangle.nodes;
  const TriangleShape shape =
      triangle_shape(mesh.position(nodes[0]), mesh.position(nodes[1]), mesh.position(nodes[2]));
  const Matrix6d tangent =
      triangle_response(shape, plane_moduli(material), material.thickness, Vector6d::Zero()).tangent;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      body.stiffness.block<2, 2>(2 * (value(nodes[static_cast<std::size_t>(i)]) - body.nodes.begin),
                                 2 * (value(nodes[static_cast<std::size_t>(j)]) - body.nodes.begin)) +=
          tangent.block<2, 2>(2 * i, 2 * j);
}

/// Moment of inertia of a triangle about the origin, over its density and thickness [m4]; corners relative to
/// the origin.
double second_moment(const Point& a, const Point& b, const Point& c) {
  const double squares = a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + a.dot(b) + b.dot(c) + c.dot(a);
  return 0.5 * cross(b - a, c - a) * squares / 6.0;
}

double moment_of_inertia(const Mesh& mesh, const IndexRange& triangles, const Material& material,
                         const Point& centre) {
  double sum = 0.0;
  for (int t = triangles.begin; t < triangles.end; ++t) {
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)].nodes;
    sum += second_moment(mesh.position(a) - centre, mesh.position(b) - centre, mesh.position(c) - centre);
  }
  return material.density * material.thickness * sum;
}

/// About the centre, of what is laid on the block's nodes [kg m2].
double moment_of_laid_masses(const Eigen::VectorXd& laid, const BlockBody& body) {
  double sum = 0.0;
  for (int i = 0; i < body.nodes.size() && laid.size() > 0; ++i)
    sum += laid[body.nodes.begin + i] * body.arms.segment<2>(2 * i).squaredNorm();
  return sum;
}

double lumped_moment_of_inertia(const BlockBody& body) {
  return body.arms.dot(body.masses.cwiseProduct(body.arms));
}

void set_masses(const Mesh& mesh, const Eigen::VectorXd& masses, BlockBody& body) {
  const int n = body.nodes.size();
  body.masses.resize(2 * n);
  body.arms.resize(2 * n);
  body.centre.setZero();
  for (int i = 0; i < n; ++i) {
    const double m = masses[body.nodes.begin + i];
    body.masses.segment<2>(2 * i).setConstant(m);
    body.mass += m;
    body.centre += m * mesh.nodes.col(body.nodes.begin + i);
  }
  body.centre /= body.mass;
  for (int i = 0; i < n; ++i)
    body.arms.segment<2>(2 * i) = mesh.nodes.col(body.nodes.begin + i) - body.centre;
}

void set_supports(const std::vector<bool>& held, BlockBody& body) {
  for (int c = 0; c < 2 * body.nodes.size(); ++c) {
    const bool here = held[static_cast<std::size_t>(2 * body.nodes.begin + c)];
    body.held_components.push_back(here);
    if (here) (c % 2 == 0 ? body.free_x : body.free_y) = false;
  }
  body.held = !body.free_x || !body.free_y;
}

/// The acceleration that a force gives the nodes of a rigid block [1/kg].
Eigen::MatrixXd rigid_response(const BlockBody& body, double inertia) {
  Eigen::MatrixXd modes(body.arms.size(), 3);  // of unit mass each
  for (Eigen::Index i = 0; i < modes.rows(); i += 2) {
    modes.row(i) << 1.0 / std::sqrt(body.mass), 0.0, -body.arms[i + 1] / std::sqrt(inertia);
    modes.row(i + 1) << 0.0, 1.0 / std::sqrt(body.mass), body.arms[i] / std::sqrt(inertia);
  }
  return modes * modes.transpose();
}

}  // namespace

Eigen::VectorXd lumped_masses(const Model& model) {
  const Mesh& mesh = model.mesh;
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(mesh.node_count());
  for (std::size_t block = 0; block < mesh.block_triangles.size(); ++block) {
    const Material& material = model.parameters.blocks[block];
    for (int t = mesh.block_triangles[block].begin; t < mesh.block_triangles[block].end; ++t) {
      const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)].nodes;
      const double area = triangle_shape(mesh.position(a), mesh.position(b), mesh.position(c)).area;
      for (const NodeId node : {a, b, c})
        masses[value(node)] += material.density * material.thickness * area / 3.0;
    }
  }
  if (model.parameters.laid_mass.size() > 0) masses += model.parameters.laid_mass;
  return masses;
}

std::vector<BlockBody> make_block_bodies(const Model& model, RotationalInertia inertia) {
  const Mesh& mesh = model.mesh;
  const Eigen::VectorXd masses = lumped_masses(model);
  const std::vector<bool> held = held_components(model.supports, mesh);
  std::vector<BlockBody> bodies;
  for (std::size_t block = 0; block < model.layout.size(); ++block) {
    const Material& material = model.parameters.blocks[block];
    BlockBody body;
    body.nodes = mesh.block_nodes[block];
    body.stiffness.setZero(2 * body.nodes.size(), 2 * body.nodes.size());
    const IndexRange& range = mesh.block_triangles[block];
    for (int t = range.begin; t < range.end; ++t)
      add_stiffness(mesh, mesh.triangles[static_cast<std::size_t>(t)], material, body);
    set_masses(mesh, masses, body);
    body.inertia = inertia == RotationalInertia::exact
                       ? moment_of_inertia(mesh, range, material, body.centre) +
                             moment_of_laid_masses(model.parameters.laid_mass, body)
                       : lumped_moment_of_inertia(body);
    set_supports(held, body);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

Eigen::MatrixXd step_response(const BlockBody& body, double step) {
  Eigen::MatrixXd matrix = step * step * body.stiffness;
  matrix.diagonal() += body.masses;
  for (std::size_t c = 0; c < body.held_components.size(); ++c) {
    if (!body.held_components[c]) continue;
    const auto i = static_cast<Eigen::Index>(c);
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.0;
  }
  Eigen::MatrixXd response = matrix.llt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
  for (std::size_t c = 0; c < body.held_components.size(); ++c)
    if (body.held_components[c]) response(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(c)) = 0.0;
  return response;
}

Eigen::MatrixXd deformation_response(const BlockBody& body, double step) {
  const Eigen::MatrixXd response = step_response(body, step);
  if (body.held) return response;
  return response - rigid_response(body, lumped_moment_of_inertia(body));
}

Eigen::MatrixXd alternating_response(const BlockBody& body, double step) {
  const Eigen::MatrixXd response = deformation_response(body, 0.5 * step);
  if (body.held) return response;
  return response + rigid_response(body, body.inertia);
}

}  // namespace voussoir
