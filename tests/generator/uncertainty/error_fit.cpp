#include "generator/uncertainty/error_fit.h"

#include <catch2/catch.hpp>

using namespace voussoir;
using Eigen::Vector2d;

TEST_CASE("Errors are shares of each value and of all, as they were made (least squares that fit exactly)") {
  ErrorFit fit;
  const Vector2d signal(3.0, 4.0);  // mean square 12.5
  fit.add(signal, Vector2d(std::sqrt(0.04 * 9.0 + 0.01 * 12.5), std::sqrt(0.04 * 16.0 + 0.01 * 12.5)));
  CHECK(fit.squares().isApprox(Vector2d(0.04, 0.01), 1e-9));
}

TEST_CASE("Of one point the error is common, as nothing tells its shares apart; without signals it is none") {
  ErrorFit fit;
  CHECK(fit.squares().isZero(0.0));
  fit.add(Eigen::VectorXd::Constant(1, 2.0), Eigen::VectorXd::Constant(1, 0.4));
  fit.add(Eigen::VectorXd::Constant(1, 5.0), Eigen::VectorXd::Constant(1, 1.0));
  CHECK(fit.squares()[0] == 0.0);
  CHECK(fit.squares()[1] == Approx(0.04));
}

TEST_CASE("Signals that are next to nothing leave the shares as they are (the same without them)") {
  ErrorFit plain, with;
  for (int i = 0; i < 9; ++i) {
    const Vector2d signal(1e-5 * (1 + i), -2e-5), error(3e-6, 1e-6 * i);
    plain.add(signal, error);
    with.add(signal, error);
    if (i % 3 == 0) with.add(Vector2d(1e-20, 0.0), Vector2d(1e-9, 1e-9));
  }
  CHECK(plain.squares().maxCoeff() > 0.0);
  CHECK(with.squares() == plain.squares());
}
