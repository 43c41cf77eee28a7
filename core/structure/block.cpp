#include "core/structure/block.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace voussoir {

std::string to_string(BlockIndex index) {
  return fmt::format("{},{}", index.course, index.position);
}

std::optional<BlockRole> find_role(std::string_view name) {
  const auto found = std::ranges::find(kRoleNames, name);
  if (found == kRoleNames.end()) return std::nullopt;
  return static_cast<BlockRole>(found - kRoleNames.begin());
}

std::string role_names() {
  return fmt::format("{}", fmt::join(kRoleNames, ", "));
}

bool is_called(const Block& block, std::string_view name) {
  return name == block.label || name == name_of(block.role);
}

void number_by_courses(std::vector<Block>& blocks) {
  BlockIndex last;
  for (Block& block : blocks) {
    last = {block.index.course, block.index.course == last.course ? last.position + 1 : 1};
    block.index = last;
    block.label = to_string(last);
  }
}

}  // namespace voussoir
