#include "core/bridge_file/dxf_blocks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/geometry/polygon.h"
#include "core/structure/block_limits.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostOutlines = 20000;
constexpr double kChordAngle = std::numbers::pi / 18.0;  ///< [rad] of the chords of an arc, at most
constexpr int kFirstUnit = 4, kLastUnit = 6;             ///< of $INSUNITS: mm, cm, m
constexpr std::string_view kNoSection = "none";
constexpr double kUnits[] = {1e-3, 1e-2, 1.0};  ///< [m]

/// DXF is a list of pairs of lines: a code and a value.
struct Group {
  int code;
  std::string_view value;
  long line;  ///< of the value
};

class Groups {
 public:
  Groups(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::optional<Group> next() {
    const auto code_line = next_line();
    if (!code_line || (trimmed(*code_line).empty() && begin_ >= text_.size())) return std::nullopt;
    const std::string_view code_text = trimmed(*code_line);
    int code = 0;
    const auto [end, error] = std::from_chars(code_text.data(), code_text.data() + code_text.size(), code);
    if (error != std::errc{} || end != code_text.data() + code_text.size())
      refuse(line_, fmt::format("{}: expected the number of a group code (ASCII DXF)", in_quotes(code_text)));
    const auto value = next_line();
    if (!value) refuse(line_, "the file ends after a group code: expected its value");
    return Group{code, trimmed(*value), line_};
  }

  long line() const { return line_; }  ///< the last that was read

  [[noreturn]] void refuse(long line, const std::string& message) const {
    throw InputError(at_line(name_, line, message));
  }

  double number(const Group& group) const {
    const auto number = parse_number(group.value);
    if (!number) refuse(group.line, fmt::format("{}: expected a number", in_quotes(group.value)));
    return *number;
  }
  int flags(const Group& group) const {
    const auto flags = parse_whole_number(group.value);
    if (!flags) refuse(group.line, fmt::format("{}: expected a whole number", in_quotes(group.value)));
    return *flags;
  }

 private:
  std::optional<std::string_view> next_line() {
    if (begin_ >= text_.size()) return std::nullopt;
    const std::size_t end = std::min(text_.find('\n', begin_), text_.size());
    const std::string_view line = text_.substr(begin_, end - begin_);
    begin_ = end + 1;
    ++line_;
    return line;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t begin_ = 0;
  long line_ = 0;
};

struct Vertex {
  Point place = Point::Zero();
  double bulge = 0.0;  ///< tangent of a quarter of the angle of the arc to the next vertex
};

struct Outline {
  std::string layer;
  std::vector<Vertex> vertices;
  std::optional<int> stated{};  ///< how many vertices the file says that there are
  bool closed = false;
  long line = 0;
};

struct Lettering {
  Point place = Point::Zero();
  std::string text;
};

struct Drawing {
  double unit = 1.0;  ///< [m]
  std::vector<Outline> outlines;
  std::vector<Lettering> letterings;
};

/// Reads entity by entity; an entity ends where the next group 0 begins it anew.
class DrawingReader {
 public:
  DrawingReader(std::string_view text, const std::string& name) : groups_(text, name) {}

  Drawing read() {
    while (const auto group = groups_.next()) {
      if (group->code == 0)
        begin_entity(*group);
      else if (group->code == 9)
        variable_ = group->value;
      else if (group->code == 70 && variable_ == "$INSUNITS")
        set_unit(*group);
      else if (entity_ == "LWPOLYLINE" || entity_ == "POLYLINE" || entity_ == "VERTEX")
        read_outline(*group);
      else if (entity_ == "TEXT" || entity_ == "MTEXT")
        read_lettering(*group);
      else if (entity_ == "SECTION" && group->code == 2)
        section_ = group->value;
    }
    if (!section_.empty() && section_ != kNoSection)
      groups_.refuse(groups_.line(),
                     fmt::format("the file ends within the section {}: expected ENDSEC", section_));
    for (const Outline& outline : drawing_.outlines)
      if (const auto stated = outline.stated; stated && std::cmp_not_equal(*stated, outline.vertices.size()))
        groups_.refuse(outline.line, fmt::format("the outline has {} vertices: expected the {} that it says",
                                                 outline.vertices.size(), *stated));
    return std::move(drawing_);
  }

 private:
  void begin_entity(const Group& group) {
    variable_ = {};
    const bool drawn = section_ == "ENTITIES" || section_.empty();
    entity_ = group.value == "SECTION" || drawn ? group.value : std::string_view{};
    if (entity_ == "LWPOLYLINE" || entity_ == "POLYLINE") {
      if (drawing_.outlines.size() >= kMostOutlines)
        groups_.refuse(group.line, fmt::format("expected at most {} outlines", kMostOutlines));
      drawing_.outlines.push_back(
          {.layer = "0", .vertices = {}, .stated = {}, .closed = false, .line = group.line});
    }
    if (entity_ == "VERTEX") {
      if (drawing_.outlines.empty()) groups_.refuse(group.line, "VERTEX: expected it after a POLYLINE");
      add_vertex(group);
    }
    if (entity_ == "TEXT" || entity_ == "MTEXT") drawing_.letterings.emplace_back();
    if (group.value == "ENDSEC") section_ = kNoSection;
  }

  void add_vertex(const Group& group) {
    std::vector<Vertex>& vertices = drawing_.outlines.back().vertices;
    if (vertices.size() >= kMostCorners)
      groups_.refuse(group.line, fmt::format("expected at most {} vertices of an outline", kMostCorners));
    vertices.emplace_back();
  }

  void read_outline(const Group& group) {
    Outline& outline = drawing_.outlines.back();
    const bool vertices_follow = entity_ == "POLYLINE";  // each as an entity of its own
    if (group.code == 8 && entity_ != "VERTEX") outline.layer = std::string(group.value);
    if (group.code == 70 && entity_ != "VERTEX") outline.closed = (groups_.flags(group) & 1) != 0;
    if (vertices_follow) return;
    if (group.code == 90 && entity_ == "LWPOLYLINE") outline.stated = groups_.flags(group);
    if (group.code == 10 && entity_ == "LWPOLYLINE") add_vertex(group);
    if (group.code != 10 && group.code != 20 && group.code != 42) return;
    if (outline.vertices.empty()) groups_.refuse(group.line, "expected group 10 (x) before it");
    Vertex& vertex = outline.vertices.back();
    (group.code == 10   ? vertex.place.x()
     : group.code == 20 ? vertex.place.y()
                        : vertex.bulge) = groups_.number(group);
  }

  void read_lettering(const Group& group) {
    Lettering& lettering = drawing_.letterings.back();
    if (group.code == 1) lettering.text = std::string(group.value);
    if (group.code == 10) lettering.place.x() = groups_.number(group);
    if (group.code == 20) lettering.place.y() = groups_.number(group);
  }

  void set_unit(const Group& group) {
    const int unit = groups_.flags(group);
    if (unit != 0 && (unit < kFirstUnit || unit > kLastUnit))
      groups_.refuse(group.line,
                     fmt::format("$INSUNITS is {}: expected 4 (mm), 5 (cm), 6 (m) or 0 (none: m)", unit));
    drawing_.unit = unit == 0 ? 1.0 : kUnits[unit - kFirstUnit];
  }

  Groups groups_;
  Drawing drawing_;
  std::string_view section_, entity_, variable_;
};

/// Points on the arc from a vertex to the next one, the first included, the last not.
void append_arc(const Vertex& from, const Point& to, Polygon& polygon) {
  polygon.push_back(from.place);
  if (from.bulge == 0.0) return;
  const double angle = 4.0 * std::atan(from.bulge);  // counter-clockwise
  const int chords = static_cast<int>(std::ceil(std::abs(angle) / kChordAngle));
  const Point along = to - from.place;
  const Point centre = 0.5 * (from.place + to) + 0.5 / std::tan(0.5 * angle) * Point(-along.y(), along.x());
  for (int i = 1; i < chords; ++i) {
    const double turn = angle * i / chords;
    const Point arm = from.place - centre;
    polygon.push_back(centre + Point(std::cos(turn) * arm.x() - std::sin(turn) * arm.y(),
                                     std::sin(turn) * arm.x() + std::cos(turn) * arm.y()));
  }
}

Polygon polygon_of(const Outline& outline, double unit) {
  Polygon polygon;
  for (std::size_t i = 0; i < outline.vertices.size(); ++i)
    append_arc(outline.vertices[i], outline.vertices[(i + 1) % outline.vertices.size()].place, polygon);
  for (Point& point : polygon) point *= unit;
  return polygon;
}

struct RoleAndRing {
  BlockRole role;
  int ring;
};

/// "Ring 2": its role and, from 0, its ring. Nothing for other layers.
std::optional<RoleAndRing> role_of_layer(const std::string& layer) {
  std::string name;
  for (const char c : layer) name += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  const std::size_t end = name.find_last_not_of("0123456789 _-");
  const std::string word = end == std::string::npos ? "" : name.substr(0, end + 1);
  const std::optional<BlockRole> role = find_role(word);
  if (!role) return std::nullopt;
  const std::size_t digits = name.find_first_of("0123456789", end);
  const auto number = digits == std::string::npos ? std::nullopt : parse_whole_number(name.substr(digits));
  const int ring = std::max(0, std::min(number.value_or(1), kMostRings) - 1);
  return RoleAndRing{*role, *role == BlockRole::ring ? ring : kNoRing};
}

/// Each text names the block in which it stands; blocks without one have their number.
void name_blocks(const Drawing& drawing, std::vector<Block>& blocks) {
  for (const Lettering& lettering : drawing.letterings)
    for (Block& block : blocks)
      if (block.label.empty() && contains(block.polygon, drawing.unit * lettering.place)) {
        block.label = lettering.text;
        break;
      }
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks[i].label.empty()) blocks[i].label = fmt::format("{}", i + 1);
}

}  // namespace

BlockFile parse_dxf_blocks(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const Drawing drawing = DrawingReader(text, name).read();
  BlockFile file;
  std::map<std::string, int> left_out;
  int open = 0;
  for (const Outline& outline : drawing.outlines) {
    const auto role = role_of_layer(outline.layer);
    if (!role) ++left_out[outline.layer];
    if (role && !outline.closed) ++open;
    if (!role || !outline.closed) continue;
    Block& block = file.blocks.emplace_back();
    block.role = role->role;
    block.ring = role->ring;
    block.polygon = polygon_of(outline, drawing.unit);
    for (const Point& p : block.polygon)
      if (!(p.cwiseAbs().maxCoeff() <= kLargestLength))
        throw InputError(
            at_line(name, outline.line, fmt::format("a vertex is farther than {:g} m", kLargestLength)));
  }
  for (const auto& [layer, count] : left_out)
    file.notes.push_back(
        fmt::format("left out {} outlines on layer {}, which names no role", count, in_quotes(layer)));
  if (open > 0) file.notes.push_back(fmt::format("left out {} outlines that are not closed", open));
  if (file.blocks.empty())
    throw InputError(fmt::format("{}: no closed polylines on layers that name roles: expected layers {}",
                                 name, role_names()));
  name_blocks(drawing, file.blocks);
  return file;
}

}  // namespace voussoir
