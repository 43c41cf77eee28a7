#include "core/statics/lane_factorisation.h"

#include <Eigen/SparseLU>
#include <catch2/catch.hpp>
#include <random>

#include "core/statics/equilibrium.h"
#include "tests/support/bridges.h"

using namespace voussoir;

namespace {

/// A structurally symmetric, unsymmetric matrix: a bridge's pattern with random values and a strong diagonal.
Eigen::SparseMatrix<double> random_matrix(const Eigen::SparseMatrix<double>& pattern, int seed) {
  std::mt19937 generator(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::SparseMatrix<double> matrix = pattern;
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, k); it; ++it)
      it.valueRef() = normal(generator) + (it.row() == it.col() ? 40.0 : 0.0);
  return matrix;
}

void put(const Eigen::SparseMatrix<double>& matrix, std::size_t lane, LaneVector& values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i].value[lane] = matrix.valuePtr()[i];
}

}  // namespace

TEST_CASE("Every lane has the solution of an independent sparse LU", "[lanes]") {
  const Model bridge = test::small_bridge();
  const EquilibriumSystem system(bridge);
  LaneFactorisation lanes(system.pattern);
  LaneVector values(static_cast<std::size_t>(system.pattern.nonZeros()));
  LaneVector x(static_cast<std::size_t>(system.unknown_count()));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(system.unknown_count(), -1.0, 2.0);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    put(random_matrix(system.pattern, static_cast<int>(lane)), lane, values);
    for (std::size_t i = 0; i < x.size(); ++i) x[i].value[lane] = b[static_cast<Eigen::Index>(i)];
  }
  for (const bool regular : lanes.factorise(values)) CHECK(regular);
  lanes.solve(x);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Eigen::SparseMatrix<double> matrix = random_matrix(system.pattern, static_cast<int>(lane));
    const Eigen::VectorXd expected = Eigen::SparseLU<Eigen::SparseMatrix<double>>(matrix).solve(b);
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK(x[i].value[lane] == Approx(expected[static_cast<Eigen::Index>(i)]).margin(1e-12));
  }
}

TEST_CASE("A lane's solution does not depend on its neighbours, to the last bit", "[lanes]") {
  const Model bridge = test::small_bridge();
  const EquilibriumSystem system(bridge);
  LaneFactorisation lanes(system.pattern);
  LaneVector values(static_cast<std::size_t>(system.pattern.nonZeros()));
  const auto solution_beside = [&](int seed) {
    put(random_matrix(system.pattern, 7), 2, values);
    for (const std::size_t lane : {0, 1, 3})
      put(random_matrix(system.pattern, seed + static_cast<int>(lane)), lane, values);
    LaneVector x(static_cast<std::size_t>(system.unknown_count()), {DoubleLanes{1.0, 2.0, 3.0, 4.0}});
    lanes.factorise(values);
    lanes.solve(x);
    std::vector<double> own;
    for (const auto& cell : x) own.push_back(cell.value[2]);
    return own;
  };
  CHECK(solution_beside(100) == solution_beside(200));
}

TEST_CASE("One matrix's solutions for four sides are those of independent sparse LU, with the bits of lanes",
          "[lanes]") {
  const Model bridge = test::small_bridge();
  const EquilibriumSystem system(bridge);
  const Eigen::SparseMatrix<double> matrix = random_matrix(system.pattern, 11);
  SharedFactorisation shared(system.pattern);
  LaneFactorisation lanes(system.pattern);
  Cells<double> values;
  LaneVector in_lanes(static_cast<std::size_t>(matrix.nonZeros()));
  for (Eigen::Index i = 0; i < matrix.nonZeros(); ++i) values.push_back({matrix.valuePtr()[i]});
  for (std::size_t lane = 0; lane < kLanes; ++lane) put(matrix, lane, in_lanes);
  // One side is zero but for one place, so that whatever it does not reach is skipped; one is zero
  // altogether.
  Eigen::MatrixXd sides = Eigen::MatrixXd::Zero(matrix.rows(), kLanes);
  sides(matrix.rows() / 2, 0) = 1.0;
  SECTION("Most of all sides is zero") {}
  SECTION("One side is full") {
    sides.col(2).setLinSpaced(-1.0, 2.0);
  }
  LaneVector x(static_cast<std::size_t>(matrix.rows()));
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      x[i].value[lane] = sides(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(lane));
  LaneVector y = x;
  CHECK(shared.factorise(values).front());
  shared.solve(x);
  lanes.factorise(in_lanes);
  lanes.solve(y);
  const Eigen::MatrixXd expected = Eigen::SparseLU<Eigen::SparseMatrix<double>>(matrix).solve(sides);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      CHECK(x[i].value[lane] ==
            Approx(expected(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(lane))).margin(1e-12));
      CHECK(x[i].value[lane] == y[i].value[lane]);
    }
}

TEST_CASE("A singular matrix is reported in its lane and in no other", "[lanes]") {
  const Model bridge = test::small_bridge();
  const EquilibriumSystem system(bridge);
  LaneFactorisation lanes(system.pattern);
  LaneVector values(static_cast<std::size_t>(system.pattern.nonZeros()));
  for (std::size_t lane = 0; lane < kLanes; ++lane) put(random_matrix(system.pattern, 3), lane, values);
  for (auto& cell : values) cell.value[1] = 0.0;
  const auto regular = lanes.factorise(values);
  CHECK(regular[0]);
  CHECK_FALSE(regular[1]);
  CHECK(regular[2]);
  CHECK(regular[3]);
}
