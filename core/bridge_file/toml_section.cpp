#include "core/bridge_file/toml_section.h"

#include <cmath>
#include <numbers>

#include "core/text.h"

namespace voussoir {
namespace {

/// "is 'oak': ", or nothing of tables and arrays.
std::string what_is_given(const toml::node* node) {
  if (node == nullptr) return {};
  if (const auto* text = node->as_string()) return fmt::format("is {}: ", in_quotes(text->get()));
  if (const auto* whole = node->as_integer()) return fmt::format("is {}: ", whole->get());
  if (const auto* number = node->as_floating_point()) return fmt::format("is {:#}: ", number->get());
  if (const auto* flag = node->as_boolean()) return fmt::format("is {}: ", flag->get());
  return {};
}

}  // namespace

const toml::node* TomlSection::take(const char* key) {
  known_.insert(key);
  return table_ == nullptr ? nullptr : table_->get(key);
}

void TomlSection::refuse(const char* key, const std::string& expected) const {
  const toml::node* given = table_ == nullptr ? nullptr : table_->get(key);
  const std::string value = expected.starts_with("expected") ? what_is_given(given) : std::string();
  throw InputError(at_line(file_, line_of(key), fmt::format("{}{}: {}{}", key, title_, value, expected)));
}

void TomlSection::number(const char* key, double& target, double least, double most, bool may_be_least) {
  const toml::node* node = take(key);
  if (node == nullptr) return;
  const auto number = node->value<double>();
  if (!number || !node->is_number()) refuse(key, "expected a number");
  if (!(*number >= least && *number <= most) || (*number == least && !may_be_least))
    refuse(key, fmt::format("expected a number {} {:g} and at most {:g}",
                            may_be_least ? "of at least" : "greater than", least, most));
  target = *number;
}

void TomlSection::friction_angle(double& radians, double least) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kMostDegrees = 89.0;
  know("friction_angle_deg");
  if (!has("friction_angle_deg")) return;
  double degrees = 0.0;
  // Of an angle in degrees again: what was the same there may have been rounded up on the way.
  number("friction_angle_deg", degrees, least / kDegree * (1.0 - 1e-12), kMostDegrees);
  radians = std::max(degrees * kDegree, least);
}

void TomlSection::count(const char* key, int& target, int least, int most) {
  const toml::node* node = take(key);
  if (node == nullptr) return;
  if (!node->is_integer()) refuse(key, "expected a whole number");
  const std::int64_t number = node->as_integer()->get();
  if (number < least || number > most)
    refuse(key, fmt::format("expected a whole number from {} to {}", least, most));
  target = static_cast<int>(number);
}

void TomlSection::flag(const char* key, bool& target) {
  const toml::node* node = take(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) refuse(key, "expected true or false");
  target = node->as_boolean()->get();
}

void TomlSection::text(const char* key, std::string& target) {
  const toml::node* node = take(key);
  if (node == nullptr) return;
  if (!node->is_string()) refuse(key, "expected a text in quotes");
  target = node->as_string()->get();
}

std::vector<std::string> TomlSection::texts(const char* key) {
  const toml::node* node = take(key);
  if (node == nullptr) return {};
  const toml::array* entries = node->as_array();
  if (entries == nullptr || entries->empty()) refuse(key, "expected texts in quotes: [\"a\", \"b\"]");
  std::vector<std::string> texts;
  for (const toml::node& entry : *entries) {
    if (!entry.is_string()) refuse(key, "expected texts in quotes: [\"a\", \"b\"]");
    texts.push_back(entry.as_string()->get());
  }
  return texts;
}

std::vector<Point> TomlSection::points(const char* key, std::size_t fewest, std::size_t most) {
  const toml::node* node = take(key);
  if (node == nullptr) return {};
  const toml::array* rows = node->as_array();
  if (rows == nullptr || rows->size() < fewest || rows->size() > most)
    refuse(key, fmt::format("expected {} to {} points: [[x, y], ..]", fewest, most));
  std::vector<Point> points;
  for (const toml::node& row : *rows) {
    Point& point = points.emplace_back(Point::Zero());
    const toml::array* pair = row.as_array();
    if (pair == nullptr || pair->size() != 2)
      refuse(key, fmt::format("point {}: expected [x, y]", points.size()));
    for (const Eigen::Index axis : {0, 1}) {
      const toml::node& entry = *pair->get(static_cast<std::size_t>(axis));
      const auto number = entry.value<double>();
      if (!number || !entry.is_number() || !(std::abs(*number) <= kLargestLength))
        refuse(key, fmt::format("point {}: expected numbers of at most {:g}", points.size(), kLargestLength));
      point[axis] = *number;
    }
  }
  return points;
}

const toml::table* TomlSection::table(const char* key) {
  const toml::node* node = take(key);
  if (node != nullptr && !node->is_table()) refuse(key, fmt::format("expected a table: write [{}]", key));
  return node == nullptr ? nullptr : node->as_table();
}

const toml::array* TomlSection::tables(const char* key, const char* how) {
  const toml::node* node = take(key);
  if (node == nullptr) return nullptr;
  if (!node->is_array() ||
      (!node->as_array()->empty() && !node->as_array()->is_homogeneous(toml::node_type::table)))
    refuse(key, fmt::format("expected tables: write {}", how));
  return node->as_array();
}

void TomlSection::require(const char* key) const {
  if (!has(key)) refuse(key, "is missing");
}

void TomlSection::refuse_unknown_keys() const {
  if (table_ == nullptr) return;
  for (const auto& [key, node] : *table_)
    if (!known_.contains(std::string(key.str()))) {
      std::string names;
      for (const std::string& known : known_) names += (names.empty() ? "" : ", ") + known;
      throw InputError(
          at_line(file_, key.source().begin.line,
                  fmt::format("unknown key '{}'{}: expected one of {}", key.str(), title_, names)));
    }
}

long TomlSection::line_of(const char* key) const {
  if (table_ == nullptr) return 0;
  const auto found = table_->find(key);
  return static_cast<long>((found != table_->end() ? found->first.source() : table_->source()).begin.line);
}

}  // namespace voussoir
