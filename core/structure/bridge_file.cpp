#include "core/structure/bridge_file.h"

#include <toml++/toml.h>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "core/error.h"
#include "reference_bridge_text.h"

namespace voussoir {
namespace {

constexpr std::uintmax_t kLargestFile = 1 << 20;  ///< [bytes] a bridge file is a page or two
constexpr std::size_t kLongestLine = 4096;        ///< [bytes] bounds how deep dotted keys nest
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMost = 1e15;            ///< largest value of any setting
constexpr double kSmallestLength = 1e-3;  ///< [m] of any part: joints are found within 1e-6 m
constexpr double kLargestLength = 1e5;    ///< [m] of anything
constexpr int kMostCourses = 1000;
constexpr int kMostVoussoirs = 1000;
constexpr double kMostBlocks = 20000;
constexpr double kMostPieces = 300000;  ///< blocks, each counted four times a level of refinement

/// Reads the keys of one table; remembers which were read, so that the others can be refused.
class Section {
 public:
  Section(const std::string& file, const toml::table* table, std::string title)
      : file_(file), table_(table), title_(std::move(title)) {}

  void number(const char* key, double& target, double least, double most, bool least_allowed) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    const auto number = node->value<double>();
    if (!number || !node->is_number()) fail(*node, key, "expected a number");
    if (!std::isfinite(*number) || *number > most || *number < least || (*number == least && !least_allowed))
      fail(*node, key,
           fmt::format("is {}: expected a number {} {:g} and at most {:g}", *number,
                       least_allowed ? "of at least" : "greater than", least, most));
    target = *number;
  }
  void positive(const char* key, double& target) { number(key, target, 0.0, kMost, false); }
  void length(const char* key, double& target) { number(key, target, kSmallestLength, kLargestLength, true); }
  void not_negative(const char* key, double& target) { number(key, target, 0.0, kMost, true); }

  void count(const char* key, int& target, int least, int most) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    if (!node->is_integer()) fail(*node, key, "expected a whole number");
    const std::int64_t number = node->as_integer()->get();
    if (number < least || number > most)
      fail(*node, key, fmt::format("is {}: expected a whole number from {} to {}", number, least, most));
    target = static_cast<int>(number);
  }

  void flag(const char* key, bool& target) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    if (!node->is_boolean()) fail(*node, key, "expected true or false");
    target = node->as_boolean()->get();
  }

  void text(const char* key, std::string& target) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    if (!node->is_string()) fail(*node, key, "expected a text in quotes");
    target = node->as_string()->get();
  }

  template <typename Choice>
  void choice(const char* key, Choice& target,
              std::initializer_list<std::pair<const char*, Choice>> choices) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    std::string names;
    for (const auto& [name, value] : choices) {
      if (node->is_string() && node->as_string()->get() == name) {
        target = value;
        return;
      }
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    }
    fail(*node, key, "expected one of " + names);
  }

  /// A sub-table, or nothing; not-a-table is an error.
  const toml::table* table(const char* key) {
    const toml::node* node = take(key);
    if (node != nullptr && !node->is_table())
      fail(*node, key, fmt::format("expected a table: write [{}]", key));
    return node == nullptr ? nullptr : node->as_table();
  }

  /// The tables of an array of tables, or nothing.
  const toml::array* tables(const char* key) {
    const toml::node* node = take(key);
    if (node == nullptr) return nullptr;
    if (!node->is_array() ||
        (!node->as_array()->empty() && !node->as_array()->is_homogeneous(toml::node_type::table)))
      fail(*node, key, fmt::format("expected tables: write [[{}]]", key));
    return node->as_array();
  }

  void refuse_unknown_keys() const {
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

  long line_of(const char* key) const {
    const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
    if (node != nullptr) return node->source().begin.line;
    return table_ == nullptr ? 0 : static_cast<long>(table_->source().begin.line);
  }

 private:
  const toml::node* take(const char* key) {
    known_.insert(key);
    return table_ == nullptr ? nullptr : table_->get(key);
  }
  [[noreturn]] void fail(const toml::node& node, const char* key, const std::string& expected) const {
    throw InputError(
        at_line(file_, node.source().begin.line, fmt::format("{}{}: {}", key, title_, expected)));
  }

  const std::string& file_;
  const toml::table* table_;
  std::string title_;  ///< " in [wall]" for messages
  std::set<std::string> known_;
};

void read_wall(Section section, WallDescription& wall) {
  section.length("length_m", wall.length);
  section.count("courses", wall.courses, 0, kMostCourses);
  section.length("course_height_m", wall.course_height);
  section.length("block_length_m", wall.block_length);
  section.choice("bond", wall.bond, {{"running", Bond::running}, {"stack", Bond::stack}});
  section.positive("smallest_piece_m2", wall.smallest_piece);
  section.refuse_unknown_keys();
}

SpanDescription read_span(Section section) {
  SpanDescription span;
  section.number("centre_x_m", span.centre_x, -kLargestLength, kLargestLength, true);
  section.number("centre_y_m", span.centre_y, 0.0, kLargestLength, true);
  section.length("intrados_radius_m", span.intrados_radius);
  section.length("ring_thickness_m", span.ring_thickness);
  section.count("voussoirs", span.voussoirs, 3, kMostVoussoirs);
  section.refuse_unknown_keys();
  return span;
}

void read_material(Section section, Material& material) {
  section.positive("young_modulus_Pa", material.young_modulus);
  section.number("poisson_ratio", material.poisson_ratio, 0.0, 0.49, true);
  section.positive("density_kg_m3", material.density);
  section.positive("thickness_m", material.thickness);
  section.choice("plane", material.plane, {{"stress", PlaneState::stress}, {"strain", PlaneState::strain}});
  section.refuse_unknown_keys();
}

void read_joints(Section section, BridgeDescription& description) {
  JointMaterial& joints = description.joints;
  section.positive("normal_stiffness_Pa_per_m", joints.normal_stiffness);
  section.positive("tangential_stiffness_Pa_per_m", joints.tangential_stiffness);
  double degrees = joints.friction_angle / kDegree;
  section.number("friction_angle_deg", degrees, 0.0, 89.0, true);
  joints.friction_angle = degrees * kDegree;
  section.number("tolerance_m", description.joint_tolerance, 0.0, 0.1, false);
  section.refuse_unknown_keys();
}

void read_supports(Section section, SupportDescription& supports) {
  for (const auto& [key, target] : {std::pair{"base", &supports.base}, std::pair{"sides", &supports.sides}})
    section.choice(
        key, *target,
        {{"clamped", SupportKind::clamped}, {"roller", SupportKind::roller}, {"free", SupportKind::free}});
  section.refuse_unknown_keys();
}

void read_control_points(Section section, ControlPointDescription& points) {
  section.flag("top", points.top);
  section.flag("arch", points.arch);
  section.refuse_unknown_keys();
}

void read_mesh(Section section, MeshDescription& mesh) {
  section.count("refinement", mesh.refinement, 0, 5);
  section.flag("split_at_corners", mesh.split_at_corners);
  section.refuse_unknown_keys();
}

/// The bridge must not have absurdly many blocks or triangles.
void check_size(const BridgeDescription& description, const std::string& file, long wall_line) {
  const WallDescription& wall = description.wall;
  double blocks = wall.courses * (wall.length / wall.block_length + 1.0);
  for (const SpanDescription& span : description.spans) blocks += span.voussoirs + 2;
  if (blocks > kMostBlocks)
    throw InputError(at_line(
        file, wall_line,
        fmt::format("the bridge would have {:.0f} blocks: expected at most {:.0f}", blocks, kMostBlocks)));
  if (blocks * std::pow(4.0, description.mesh.refinement) > kMostPieces)
    throw InputError(at_line(
        file, wall_line,
        fmt::format("{:.0f} blocks are too many for a refinement of {}: expected at most {:.0f}", blocks,
                    description.mesh.refinement, kMostPieces / std::pow(4.0, description.mesh.refinement))));
}

/// Spans must lie in the wall and beside each other.
void check_geometry(const BridgeDescription& description, const std::vector<long>& span_lines,
                    const std::string& file) {
  const WallDescription& wall = description.wall;
  for (std::size_t i = 0; i < description.spans.size(); ++i) {
    const SpanDescription& span = description.spans[i];
    const double left = span.centre_x - span.extrados_radius();
    const double right = span.centre_x + span.extrados_radius();
    if (left < -1e-9 || right > wall.length + 1e-9)
      throw InputError(
          at_line(file, span_lines[i],
                  fmt::format("the ring reaches from x = {:g} to {:g} m: expected it between 0 and the "
                              "wall's length {:g} m",
                              left, right, wall.length)));
    if (i > 0 && left < description.spans[i - 1].centre_x + description.spans[i - 1].extrados_radius() - 1e-9)
      throw InputError(
          at_line(file, span_lines[i],
                  "the ring overlaps the one before: expected spans from left to right, side by side"));
  }
}

/// The parser keeps the depth of values within bounds, but not that of keys a.b.c.
void check_lines(std::string_view text, const std::string& file) {
  long line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (end - start > kLongestLine)
      throw InputError(at_line(
          file, line, fmt::format("a line of {} bytes: expected at most {}", end - start, kLongestLine)));
    start = end + 1;
  }
}

BridgeDescription interpret(const toml::table& root, const std::string& file) {
  BridgeDescription description;
  Section top(file, &root, "");
  const auto section = [&](const char* key) {
    return Section(file, top.table(key), fmt::format(" in [{}]", key));
  };
  top.text("name", description.name);
  top.not_negative("gravity_m_s2", description.gravity);
  read_wall(section("wall"), description.wall);
  read_material(section("material"), description.material);
  read_joints(section("joints"), description);
  read_supports(section("supports"), description.supports);
  read_control_points(section("control_points"), description.control_points);
  read_mesh(section("mesh"), description.mesh);

  std::vector<long> span_lines(description.spans.size(), 0);
  if (const toml::array* spans = top.tables("spans")) {
    description.spans.clear();
    span_lines.clear();
    for (const toml::node& node : *spans) {
      description.spans.push_back(read_span(Section(file, node.as_table(), " in [[spans]]")));
      span_lines.push_back(static_cast<long>(node.source().begin.line));
    }
  }
  top.refuse_unknown_keys();
  check_size(description, file, top.line_of("wall"));
  check_geometry(description, span_lines, file);
  return description;
}

}  // namespace

BridgeFile parse_bridge_file(std::string_view text, const std::string& name) {
  check_lines(text, name);
  try {
    const toml::table root = toml::parse(text, name);
    return {name, std::string(text), interpret(root, name)};
  } catch (const toml::parse_error& error) {
    throw InputError(at_line(name, error.source().begin.line, std::string(error.description())));
  }
}

BridgeFile read_bridge_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InputError(fmt::format("{}: cannot be opened: expected a bridge file (TOML)", path.string()));
  std::string text(kLargestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestFile)
    throw InputError(
        fmt::format("{}: larger than {} bytes: expected a bridge file (TOML)", path.string(), kLargestFile));
  return parse_bridge_file(text, path.string());
}

BridgeFile reference_bridge_file() {
  return parse_bridge_file(kReferenceBridgeText, "reference.toml");
}

}  // namespace voussoir
