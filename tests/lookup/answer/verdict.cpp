#include "lookup/answer/verdict.h"

#include <catch2/catch.hpp>

#include "tests/lookup/explained_answer.h"

using namespace voussoir;

namespace {

/// A posterior of a bridge of three blocks, by readings that say all of it.
Posterior posterior_of(double intact, const std::vector<double>& blocks) {
  return {{1.0, {}, {}}, blocks, {intact, 1.0 - intact}, {0}, 0.0, intact};
}

}  // namespace

TEST_CASE("The verdict changes exactly at nine tenths (its definition, at the limits)") {
  const double below = 0.8999;
  CHECK(verdict_by_probability(posterior_of(0.9, {0.1, 0.0, 0.0}), true) == Verdict::intact);
  CHECK(verdict_by_probability(posterior_of(below, {0.1001, 0.0, 0.0}), true) == Verdict::cannot_tell);
  CHECK(verdict_by_probability(posterior_of(0.1, {0.9, 0.3, 0.0}), true) == Verdict::located);
  CHECK(verdict_by_probability(posterior_of(0.1, {below, 0.5, 0.0}), true) == Verdict::damaged_unlocated);
  CHECK(verdict_by_probability(posterior_of(0.1001, {below, 0.5, 0.0}), true) == Verdict::cannot_tell);
}

TEST_CASE("Readings that no scene explains have no other verdict") {
  CHECK(verdict_by_probability(posterior_of(0.0, {1.0, 0.0, 0.0}), false) == Verdict::unexplained);
  CHECK(verdict_by_probability(posterior_of(1.0, {0.0, 0.0, 0.0}), false) == Verdict::unexplained);
  Posterior impossible = posterior_of(0.0, {0.0, 0.0, 0.0});
  impossible.credible.clear();
  CHECK(verdict_by_probability(impossible, true) == Verdict::unexplained);
}

TEST_CASE("Every verdict has the name that programs are promised") {
  CHECK(to_string(Verdict::located) == "located");
  CHECK(to_string(Verdict::damaged_unlocated) == "damaged-unlocated");
  CHECK(to_string(Verdict::intact) == "intact");
  CHECK(to_string(Verdict::cannot_tell) == "cannot-tell");
  CHECK(to_string(Verdict::unexplained) == "unexplained");
}

TEST_CASE("A bridge is intact only if the readings themselves say so") {
  Posterior posterior = posterior_of(0.99, {0.01, 0.0, 0.0});
  for (const auto& [if_even, expected] :
       {std::pair(0.89, Verdict::cannot_tell), std::pair(0.9, Verdict::intact)}) {
    posterior.intact_if_even = if_even;
    CHECK(verdict_by_probability(posterior, true) == expected);
  }
}

TEST_CASE("An answer that another database contests is none, unless nothing explains the readings") {
  Answer answer = test::explained_answer({0.99, 0.01}, 0.01);
  CHECK(verdict_of(answer) == Verdict::intact);
  answer.contested = true;
  CHECK(verdict_of(answer) == Verdict::cannot_tell);
  answer.fit->explained = false;
  CHECK(verdict_of(answer) == Verdict::unexplained);
}

TEST_CASE("What a prior supposes is no verdict (written out)") {
  Answer answer = test::explained_answer({0.0, 1.0}, 0.4);
  answer.prior = {{0, 1}, {8.0, 1.0}};
  CHECK(verdict_of(answer) == Verdict::damaged_unlocated);
  for (const Prior& prior : {Prior{{1}, {1.0}}, Prior{{0, 1}, {0.0, 1.0}}}) {
    answer.prior = prior;
    CHECK(verdict_of(answer) == Verdict::cannot_tell);
  }
  answer.posterior->missing_probability = {1.0};
  answer.prior = {{0}, {1.0}};
  CHECK(verdict_of(answer) == Verdict::cannot_tell);
  answer.posterior->block_probability = {0.95};
  answer.posterior->missing_probability = {0.0, 1.0};
  answer.prior = {{1}, {1.0}};
  CHECK(verdict_of(answer) == Verdict::located);
}
