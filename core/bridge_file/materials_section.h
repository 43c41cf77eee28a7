#pragma once
/// @file What blocks, joints and soil are made of: [material], [joints], [[regions]] and [fill] of a bridge
/// file.

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// All throw InputError "file:line: message".
void read_material(TomlSection section, Material& material);
void read_joints(TomlSection section, JointMaterial& joints, double& tolerance);

/// One of [[regions]]: what it leaves out is the bridge's.
Region read_region(TomlSection section, const Material& material, const JointMaterial& joints);

void read_fill(TomlSection section, FillWeight& fill);

}  // namespace voussoir
