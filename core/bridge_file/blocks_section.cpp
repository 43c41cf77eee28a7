#include "core/bridge_file/blocks_section.h"

#include <iterator>

#include "core/bridge_file/block_file.h"
#include "core/bridge_file/parts_section.h"
#include "core/structure/assembly_check.h"
#include "core/structure/block_limits.h"

namespace voussoir {
namespace {

constexpr std::size_t kCornersOfLine = 20;

/// A text as TOML writes it; what cannot stand in a label is refused when it is read.
std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7F || c == '"' || c == '\\')
      result += '?';
    else
      result += c;
  }
  return result + "\"";
}

/// Numbers as short as they can be without losing a bit.
std::string to_toml(const std::vector<Block>& blocks) {
  std::string text = "[\n";
  for (const Block& block : blocks) {
    const std::string ring = block.role == BlockRole::ring ? fmt::format("ring = {}, ", block.ring) : "";
    text += fmt::format("  {{label = {}, role = \"{}\", {}vertices = [", toml_string(block.label),
                        name_of(block.role), ring);
    for (std::size_t i = 0; i < block.polygon.size(); ++i)
      fmt::format_to(std::back_inserter(text), "{}[{}, {}]",
                     i == 0                    ? ""
                     : i % kCornersOfLine == 0 ? ",\n    "
                                               : ", ",
                     block.polygon[i].x(), block.polygon[i].y());
    text += "]},\n";
  }
  return text + "]";
}

/// Where the line starts [bytes]; lines count from 1.
std::size_t start_of_line(const std::string& text, std::size_t line) {
  std::size_t start = 0;
  for (std::size_t i = 1; i < line; ++i) start = text.find('\n', start) + 1;
  return start;
}

Block read_block(TomlSection section) {
  Block block;
  section.require("label");
  section.text("label", block.label);
  read_role(section, "role", block.role);
  int ring = 0;
  section.count("ring", ring, 0, kMostRings - 1);
  block.ring = block.role == BlockRole::ring ? ring : kNoRing;
  section.require("vertices");
  block.polygon = section.points("vertices", 3, kMostCorners);
  section.refuse_unknown_keys();
  return block;
}

}  // namespace

WithBlocks with_blocks_of_file(const std::string& text, const std::filesystem::path& path) {
  toml::table root;
  try {
    root = toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw InputError(at_line(path.string(), error.source().begin.line, std::string(error.description())));
  }
  const toml::node* node = root.get("blocks");
  if (node == nullptr || !node->is_string()) return {text, std::move(root), {}};
  const toml::source_region& place = node->source();
  if (place.begin.line != place.end.line)
    throw InputError(
        at_line(path.string(), place.begin.line,
                "blocks: stands on several lines: expected the name of a file in quotes on one"));
  const std::filesystem::path file = path.parent_path() / node->as_string()->get();
  BlockFile read = read_block_file(file);
  // What follows the value on its line, a comment, goes with it.
  const std::size_t start = start_of_line(text, node->source().begin.line);
  const std::size_t end = std::min(text.find('\n', start), text.size());
  const std::string blocks = fmt::format("blocks = {}", to_toml(read.blocks));
  // Messages name lines of the file that was given, where the blocks take up one.
  root.insert_or_assign("blocks", *toml::parse(blocks)["blocks"].node());
  return {fmt::format("{}# the blocks of {}\n{}{}", text.substr(0, start),
                      toml_string(file.filename().string()), blocks, text.substr(end)),
          std::move(root), std::move(read.notes)};
}

std::vector<std::string> read_blocks(TomlSection& top, BridgeDescription& description) {
  for (const char* key : {"wall", "walls", "spans"})
    if (top.has(key)) top.refuse(key, "expected it, or blocks, not both");
  const toml::array* entries =
      top.tables("blocks", "blocks = [{label = \"1\", role = \"wall\", vertices = [[x, y], ..]}, ..]");
  if (entries->empty() || entries->size() > kMostBlocks)
    top.refuse("blocks", fmt::format("has {}: expected 1 to {} blocks", entries->size(), kMostBlocks));
  for (const toml::node& node : *entries)
    description.blocks.push_back(read_block(TomlSection(top.file(), node.as_table(), " in blocks")));
  AssemblyTolerance tolerance{.joint = description.joint_tolerance};
  top.positive("blocks_tolerance_m", tolerance.heal, 0.1);
  description.wall.courses = 0;
  description.spans.clear();
  try {
    return heal_and_check(description.blocks, tolerance);
  } catch (const InputError& error) {
    top.refuse("blocks", error.what());
  }
}

}  // namespace voussoir
