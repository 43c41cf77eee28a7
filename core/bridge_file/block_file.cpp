#include "core/bridge_file/block_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/bridge_file/dxf_blocks.h"
#include "core/error.h"
#include "core/structure/assembly_check.h"
#include "core/structure/block_limits.h"
#include "core/text.h"
#include "core/text_file.h"

namespace voussoir {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLargestFile = 1 << 26;  ///< [bytes]

/// What is read, for messages: "survey.json: block 3".
struct Source {
  const std::string& file;
  std::size_t block;

  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(fmt::format("{}: block {}: {}", file, block, message));
  }
};

BlockRole role_of(const Json& entry, const Source& source) {
  const auto role = entry.find("role");
  if (role == entry.end()) return BlockRole::wall;
  const auto found = role->is_string() ? find_role(role->get<std::string>()) : std::nullopt;
  if (!found) source.refuse(fmt::format("role: expected one of {}", role_names()));
  return *found;
}

Polygon vertices_of(const Json& entry, const Source& source) {
  const auto vertices = entry.find("vertices");
  if (vertices == entry.end() || !vertices->is_array()) source.refuse("expected \"vertices\": [[x, y], ..]");
  Polygon polygon;
  for (const Json& vertex : *vertices) {
    const bool pair =
        vertex.is_array() && vertex.size() >= 2 && vertex[0].is_number() && vertex[1].is_number();
    const Point point = pair ? Point(vertex[0].get<double>(), vertex[1].get<double>()) : Point::Zero();
    if (!pair || !(point.cwiseAbs().maxCoeff() <= kLargestLength))
      source.refuse(fmt::format("vertex {}: expected [x, y], numbers of at most {:g} m", polygon.size() + 1,
                                kLargestLength));
    polygon.push_back(point);
  }
  if (polygon.size() < 3 || polygon.size() > kMostCorners)
    source.refuse(fmt::format("{} vertices: expected 3 to {}", polygon.size(), kMostCorners));
  return polygon;
}

std::string label_of(const Json& entry, const Source& source) {
  const auto label = entry.find("label");
  if (label == entry.end()) return fmt::format("{}", source.block);
  if (label->is_number_integer()) return fmt::format("{}", label->get<std::int64_t>());
  if (!label->is_string()) source.refuse("label: expected a text or a whole number");
  return label->get<std::string>();
}

int ring_of(const Json& entry, BlockRole role, const Source& source) {
  if (role != BlockRole::ring) return kNoRing;
  const auto ring = entry.find("ring");
  if (ring == entry.end()) return 0;
  if (!ring->is_number_unsigned() || ring->get<std::uint64_t>() >= kMostRings)
    source.refuse(fmt::format("ring: expected a whole number from 0 to {}", kMostRings - 1));
  return ring->get<int>();
}

Block block_of(const Json& entry, const Source& source) {
  if (!entry.is_object()) source.refuse("expected {\"label\": .., \"role\": .., \"vertices\": [[x, y], ..]}");
  for (const auto& [key, unused] : entry.items())
    if (key != "label" && key != "role" && key != "ring" && key != "vertices")
      source.refuse(fmt::format("unknown key {}: expected label, role, ring and vertices", in_quotes(key)));
  Block block;
  block.role = role_of(entry, source);
  block.ring = ring_of(entry, block.role, source);
  block.label = label_of(entry, source);
  block.polygon = vertices_of(entry, source);
  return block;
}

}  // namespace

BlockFile parse_json_blocks(std::string_view text, const std::string& name) {
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded())
    throw InputError(fmt::format("{}: is no JSON: expected {{\"blocks\": [..]}}", name));
  if (root.is_object())
    for (const auto& [key, unused] : root.items())
      if (key != "blocks")
        throw InputError(
            fmt::format("{}: unknown key {}: expected \"blocks\" alone, in metres", name, in_quotes(key)));
  const auto entries = root.is_object() ? root.find("blocks") : root.end();
  if (entries == root.end() || !entries->is_array() || entries->empty())
    throw InputError(fmt::format("{}: expected {{\"blocks\": [{{\"vertices\": [[x, y], ..]}}, ..]}}", name));
  if (entries->size() > kMostBlocks)
    throw InputError(fmt::format("{}: {} blocks: expected at most {}", name, entries->size(), kMostBlocks));
  BlockFile file;
  for (const Json& entry : *entries) file.blocks.push_back(block_of(entry, {name, file.blocks.size() + 1}));
  return file;
}

BlockFile read_block_file(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return c < 0x80 ? std::tolower(c) : c; });
  if (ending != ".json" && ending != ".dxf")
    throw InputError(fmt::format("{}: expected a file of blocks that ends in .json or .dxf", path.string()));
  const std::string text = read_text(path, kLargestFile, "a file of blocks (JSON or DXF)");
  BlockFile file =
      ending == ".json" ? parse_json_blocks(text, path.string()) : parse_dxf_blocks(text, path.string());
  try {
    expect_metres(file.blocks);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  return file;
}

}  // namespace voussoir
