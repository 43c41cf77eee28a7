#pragma once
/// @file Blocks from drawings: DXF.

#include <string>
#include <string_view>

#include "core/bridge_file/block_file.h"

namespace voussoir {

/// Closed LWPOLYLINEs and POLYLINEs (ASCII DXF). The layer names the role, a number behind it the ring
/// ("ring", "ring 2", "WALL"); other layers are left out. A TEXT or MTEXT inside an outline is its label.
/// Arcs between corners become chords of at most 10 degrees. Lengths by $INSUNITS (mm, cm, m; none: m).
/// `name` is for messages. Throws as read_block_file does.
BlockFile parse_dxf_blocks(std::string_view text, const std::string& name);

}  // namespace voussoir
