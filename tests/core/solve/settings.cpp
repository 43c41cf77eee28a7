#include "core/solve/settings.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/bridges.h"

using namespace voussoir;

TEST_CASE("Settings survive their text form, every value changed (round trip)", "[settings]") {
  DynamicSettings motion;
  motion.integrator = Integrator::central_differences;
  motion.inertia = RotationalInertia::exact;
  motion.step = 1.0 / 3.0;
  motion.ramp = 0.1;
  motion.damping = 1e-300;
  motion.contact_damping = 2e-4;
  motion.moment = 0.7;
  motion.decision = {.earliest_decision = 0.1,
                     .latest_decision = 0.2,
                     .standing_unbalance = 0.3,
                     .collapsing_unbalance = 0.4,
                     .plain_unbalance = 0.5,
                     .largest_standing_unbalance = 0.6,
                     .moving_sags = 0.7};
  motion.skips.early_outcome = false;
  SolverSettings settings = SolverSettings::of(SolverKind::quasi_static, motion);
  settings.newton.tolerance = 1e-7;
  settings.newton.most_iterations = 77;
  settings.newton.most_bold_iterations = 7;
  settings.newton.most_patient_iterations = 99;
  settings.newton.patient_first = true;
  settings.newton.descends_near = false;
  settings.newton.joint_rule = JointRule::gauss_16;
  settings.patient.moving_sags = 9.0;
  const std::string text = to_text(settings);
  CHECK(to_text(parse_settings(text)) == text);
  CHECK(text != to_text(SolverSettings::of(SolverKind::quasi_static)));
  CHECK(parse_settings(text).motion.step == settings.motion.step);
  CHECK(parse_settings(text).newton.joint_rule == JointRule::gauss_16);
  CHECK(parse_settings("other = 1\n" + text + "storage = 2\n").patient.moving_sags == 9.0);
}

TEST_CASE("What changes no answer is in no text, and stays as it is when one is read", "[settings]") {
  DynamicSettings motion;
  motion.skips.shared_analysis = motion.skips.lane_refill = motion.skips.settled_contacts = false;
  motion.side_by_side = 1;
  const SolverSettings settings = SolverSettings::of(SolverKind::quasi_static, motion);
  const std::string text = to_text(settings);
  CHECK(text == to_text(SolverSettings::of(SolverKind::quasi_static)));
  const SolverSettings read = parse_settings(text, settings);
  for (const Skips& skips : {read.newton.skips, read.motion.skips})
    CHECK_FALSE((skips.shared_analysis || skips.lane_refill || skips.settled_contacts));
  CHECK(read.motion.side_by_side == 1);
  CHECK(parse_settings(text).motion.skips.settled_contacts);
}

TEST_CASE("What is automatic in a text is so whatever stood there before", "[settings]") {
  SolverSettings before = SolverSettings::of(SolverKind::dynamic);
  const std::string text = to_text(before);
  REQUIRE_THAT(text, Catch::Contains("motion.step_s = automatic\n"));
  before.motion.step = 1e-4;
  before.motion.damping = 3.0;
  const SolverSettings read = parse_settings(text, before);
  CHECK_FALSE(read.motion.step.has_value());
  CHECK_FALSE(read.motion.damping.has_value());
}

TEST_CASE("Settings state what acts, for each phase", "[settings]") {
  const SolverSettings settings = SolverSettings::of(SolverKind::quasi_static);
  const std::string soft = to_text(acting_settings(settings, test::reference_bridge()));
  CHECK_THAT(soft, Catch::Contains("newton.follow_falls = no\n"));  // motion says what falls
  CHECK_THAT(soft, !Catch::Contains("most_falling_iterations"));
  CHECK_THAT(soft, Catch::Contains("newton.early_outcome = yes\n"));
  CHECK_THAT(soft, Catch::Contains("motion.latest_decision_s = 1\n"));
  CHECK_THAT(soft, Catch::Contains("patient.latest_decision_s = 4\n"));
  CHECK_THAT(soft, Catch::Contains("patient.standing_unbalance = 1e-07\n"));

  BridgeDescription stiff;
  stiff.joints.normal_stiffness = 1e12;
  CHECK_THAT(to_text(acting_settings(settings, make_model(stiff))),
             Catch::Contains("newton.patient_first = yes\n"));
  const std::string motion_alone = to_text(SolverSettings::of(SolverKind::dynamic));
  CHECK_THAT(motion_alone, !Catch::Contains("newton.") && !Catch::Contains("patient."));
}

TEST_CASE("Settings of another version are refused by the line that is missing or wrong", "[settings]") {
  CHECK_THROWS_WITH(parse_settings("solver = dynamic\n"), Catch::Contains("'motion.integrator'"));
  std::string text = to_text(SolverSettings::of(SolverKind::dynamic));
  text.replace(text.find("implicit"), 8, "sideways");
  CHECK_THROWS_WITH(parse_settings(text), Catch::Contains("'motion.integrator = sideways'"));
}
