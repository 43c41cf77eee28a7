#include "core/solve/settings.h"

#include <array>
#include <charconv>
#include <map>
#include <type_traits>

#include "core/error.h"

namespace voussoir {
namespace {

/// How a setting with a few named values is written.
template <class Value>
struct Names;
template <>
struct Names<SolverKind> {
  static constexpr std::array<std::string_view, 2> all = {"quasi-static", "dynamic"};
};
template <>
struct Names<Integrator> {
  static constexpr std::array<std::string_view, 2> all = {"implicit", "explicit"};
};
template <>
struct Names<RotationalInertia> {
  static constexpr std::array<std::string_view, 2> all = {"exact", "lumped"};
};
template <>
struct Names<JointRule> {
  static constexpr auto all = kJointRuleNames;
};
template <>
struct Names<bool> {
  static constexpr std::array<std::string_view, 2> all = {"no", "yes"};
};

std::string value_text(double value) {
  return fmt::format("{}", value);
}
std::string value_text(int value) {
  return fmt::format("{}", value);
}
std::string value_text(const std::optional<double>& value) {
  return value ? value_text(*value) : "automatic";
}
template <class Value>
std::string value_text(Value value) {
  return std::string(Names<Value>::all.at(static_cast<std::size_t>(value)));
}

template <class Number>
bool read_value(std::string_view text, Number& value) requires std::is_arithmetic_v<Number> &&
    (!std::is_same_v<Number, bool>) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}
bool read_value(std::string_view text, std::optional<double>& value) {
  if (text == "automatic") {
    value.reset();
    return true;
  }
  return read_value(text, value.emplace());
}
template <class Value>
bool read_value(std::string_view text,
                Value& value) requires std::is_enum_v<Value> || std::is_same_v<Value, bool> {
  for (std::size_t i = 0; i < Names<Value>::all.size(); ++i)
    if (text == Names<Value>::all.at(i)) {
      value = static_cast<Value>(i);
      return true;
    }
  return false;
}

// The structured bindings fail to compile when settings gain a member, which then has to be added here. What
// changes no answer (lanes, refills, shared analyses) is left out.

template <class Settings, class Visit>
void visit_newton(Settings& settings, const Visit& visit) {
  auto& [tolerance, step_tolerance, round_off, loose_tolerance, most_warm_iterations, most_iterations,
         most_bold_iterations, most_falling_iterations, most_patient_iterations, most_slipped_iterations,
         patient_first, descends_near, follow_falls, collapse_displacement, joint_rule, skips] = settings;
  visit("newton.tolerance", tolerance);
  visit("newton.step_tolerance", step_tolerance);
  visit("newton.round_off", round_off);
  visit("newton.loose_tolerance", loose_tolerance);
  visit("newton.most_warm_iterations", most_warm_iterations);
  visit("newton.most_iterations", most_iterations);
  visit("newton.most_bold_iterations", most_bold_iterations);
  visit("newton.most_patient_iterations", most_patient_iterations);
  visit("newton.most_slipped_iterations", most_slipped_iterations);
  visit("newton.patient_first", patient_first);
  visit("newton.descends_near", descends_near);
  visit("newton.follow_falls", follow_falls);
  if (follow_falls) visit("newton.most_falling_iterations", most_falling_iterations);
  visit("newton.collapse_displacement_m", collapse_displacement);
  visit("newton.joint_integration", joint_rule);
  visit("newton.early_outcome", skips.early_outcome);
  visit("newton.likely_falls", skips.likely_falls);
  visit("newton.kept_factors", skips.kept_factors);
}

template <class Rules, class Visit>
void visit_rules(const std::string& phase, Rules& rules, const Visit& visit) {
  auto& [earliest_decision, latest_decision, standing_unbalance, collapsing_unbalance, plain_unbalance,
         largest_standing_unbalance, moving_sags, freer_from, freer_unbalance, freer_until, freer_damping] =
      rules;
  visit(phase + ".earliest_decision_s", earliest_decision);
  visit(phase + ".latest_decision_s", latest_decision);
  visit(phase + ".standing_unbalance", standing_unbalance);
  visit(phase + ".collapsing_unbalance", collapsing_unbalance);
  visit(phase + ".plain_unbalance", plain_unbalance);
  visit(phase + ".largest_standing_unbalance", largest_standing_unbalance);
  visit(phase + ".moving_sags", moving_sags);
  visit(phase + ".freer_from_s", freer_from);
  visit(phase + ".freer_unbalance", freer_unbalance);
  visit(phase + ".freer_until_s", freer_until);
  visit(phase + ".freer_damping", freer_damping);
}

template <class Settings, class Visit>
void visit_motion(Settings& settings, const Visit& visit) {
  auto& [integrator, inertia, step, most_parts, least_step, ramp, damping, contact_damping, moment, decision,
         skips, side_by_side] = settings;
  static_cast<void>(side_by_side);
  visit("motion.integrator", integrator);
  visit("motion.inertia", inertia);
  visit("motion.step_s", step);
  if (integrator == Integrator::implicit_blocks) {
    visit("motion.most_parts", most_parts);
    visit("motion.least_step_s", least_step);
  }
  visit("motion.ramp_s", ramp);
  visit("motion.damping_per_s", damping);
  visit("motion.contact_damping_s", contact_damping);
  visit("motion.moment_s", moment);
  visit("motion.early_outcome", skips.early_outcome);
  if (integrator == Integrator::implicit_blocks) visit("motion.early_motions", skips.early_motions);
  visit_rules("motion", decision, visit);
}

template <class Settings, class Visit>
void visit_settings(Settings& settings, const Visit& visit) {
  auto& [kind, newton, motion, patient, falls_nearby] = settings;
  visit("solver", kind);
  if (kind == SolverKind::quasi_static) visit_newton(newton, visit);
  visit_motion(motion, visit);
  if (kind != SolverKind::quasi_static) return;
  visit_rules("patient", patient, visit);
  visit("falls_nearby", falls_nearby);
}

/// Lines "key = value" by their keys.
std::map<std::string, std::string_view, std::less<>> lines_by_key(std::string_view text) {
  constexpr std::string_view kEquals = " = ";
  std::map<std::string, std::string_view, std::less<>> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = line.find(kEquals);
    if (equals != std::string_view::npos)
      lines.emplace(line.substr(0, equals), line.substr(equals + kEquals.size()));
  }
  return lines;
}

/// p_n b / E of the stiffest joint and the softest block, with a mean block's size b.
double joints_against_blocks(const Model& model) {
  double stiffest = model.parameters.contact.normal_stiffness;
  for (const JointMaterial& joint : model.parameters.joints)
    stiffest = std::max(stiffest, joint.normal_stiffness);
  double softest = model.parameters.blocks.front().young_modulus;
  for (const Material& material : model.parameters.blocks)
    softest = std::min(softest, material.young_modulus);
  return stiffest * mean_block_size(model) / softest;
}

/// The largest p_t / p_n of the joints.
double along_against_across(const Model& model) {
  double largest = 0.0;
  for (const JointMaterial& joint : model.parameters.joints)
    largest = std::max(largest, joint.tangential_stiffness / joint.normal_stiffness);
  return largest;
}

}  // namespace

SolverSettings SolverSettings::of(SolverKind kind, const DynamicSettings& motion) {
  SolverSettings settings{
      .kind = kind, .newton = {}, .motion = motion, .patient = patient_rules(motion.decision)};
  settings.newton.follow_falls = false;  // motion says what falls
  settings.newton.skips = motion.skips;
  return settings;
}

SolverSettings acting_settings(SolverSettings settings, const Model& model) {
  // That three steps show whether there is a way was measured on joints much softer than blocks, and ten
  // times as soft along as across. Where they are stiffer, bridges that stand take up to fifty, and motion
  // might pass an equilibrium (docs/speed.md).
  constexpr double kStiffJoints = 0.1;
  constexpr double kStiffAlong = 0.2;
  settings.motion = acting_settings(settings.motion, model);
  settings.newton.patient_first =
      joints_against_blocks(model) > kStiffJoints || along_against_across(model) > kStiffAlong;
  return settings;
}

std::string to_text(const SolverSettings& settings) {
  std::string text;
  visit_settings(settings, [&](const std::string& key, const auto& value) {
    text += fmt::format("{} = {}\n", key, value_text(value));
  });
  return text;
}

SolverSettings parse_settings(std::string_view text, const SolverSettings& unstated) {
  const auto lines = lines_by_key(text);
  SolverSettings settings = unstated;
  visit_settings(settings, [&](const std::string& key, auto& value) {
    const auto line = lines.find(key);
    if (line == lines.end())
      throw Failure(
          fmt::format("solver settings without '{}': another version of the program wrote them", key));
    if (!read_value(line->second, value))
      throw Failure(
          fmt::format("solver settings '{} = {}' mean nothing to this program: another version wrote them",
                      key, line->second));
  });
  return settings;
}

}  // namespace voussoir
