#pragma once
/// @file All studies, by subject.

#include "tools/validation/findings.h"

namespace voussoir::validation {

/// Triangles: patch test, bars, cantilever, rigid rotation.
std::vector<Study> elasticity_studies();

/// One or two blocks in motion: incline, rocking, impact.
std::vector<Study> motion_studies();

/// Blocks at rest: stack, tilting table.
std::vector<Study> rest_studies();

/// The semicircular arch: least thickness, friction.
std::vector<Study> arch_studies();

/// Segmental and pointed arches: least thickness, collapse under a point load.
std::vector<Study> shape_studies();

/// Arches whose feet give way.
std::vector<Study> spreading_studies();

/// The reference bridge: what its discretisation costs.
std::vector<Study> bridge_studies();

/// Load cases: influence lines, reciprocity, unloading.
std::vector<Study> load_studies();

/// Blocks lost under load: implicit steps against motion.
std::vector<Study> loss_studies();

/// Walls that were tested: comparisons.
std::vector<Study> wall_studies();

/// Hard cases.
std::vector<Study> material_sweeps();
std::vector<Study> geometry_sweeps();
std::vector<Study> solver_sweeps();

}  // namespace voussoir::validation
