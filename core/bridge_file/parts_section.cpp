#include "core/bridge_file/parts_section.h"

#include <optional>

namespace voussoir {
namespace {

void read_courses(TomlSection& section, WallDescription& wall) {
  section.length("length_m", wall.length);
  section.count("courses", wall.courses, 0, kMostCourses);
  section.length("course_height_m", wall.course_height);
  section.length("block_length_m", wall.block_length);
  section.choice("bond", wall.bond, {{"running", Bond::running}, {"stack", Bond::stack}});
  section.positive("smallest_piece_m2", wall.smallest_piece);
  section.number("smallest_block", wall.smallest_block, 0.0, 0.5);
}

void read_role_but(std::optional<BlockRole> excluded, TomlSection& section, const char* key,
                   BlockRole& role) {
  std::vector<std::pair<const char*, BlockRole>> roles;
  for (std::size_t i = 0; i < kRoleNames.size(); ++i)
    if (static_cast<BlockRole>(i) != excluded)
      roles.emplace_back(kRoleNames.at(i), static_cast<BlockRole>(i));
  section.choice(key, role, roles);
}

}  // namespace

void read_wall(TomlSection section, WallDescription& wall) {
  wall.smallest_block = kSmallestBlock;
  read_courses(section, wall);
  section.flag("halved", wall.halved);
  section.refuse_unknown_keys();
}

void read_role(TomlSection& section, const char* key, BlockRole& role) {
  read_role_but(std::nullopt, section, key, role);
}

WallPart read_part(TomlSection section, const WallDescription& wall) {
  WallPart part{.courses = wall};
  part.courses.halved = false;
  std::string role;
  section.text("role", role);
  if (role == name_of(BlockRole::ring))
    section.refuse("role", "rings are laid by [[spans]]: expected another role");
  read_role_but(BlockRole::ring, section, "role", part.role);
  section.number("from_x_m", part.from_x, 0.0, kLargestLength);
  section.number("base_y_m", part.base_y, 0.0, kLargestLength);
  section.require("length_m");
  section.require("courses");
  read_courses(section, part.courses);
  section.refuse_unknown_keys();
  return part;
}

}  // namespace voussoir
