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

}  // namespace voussoir::validation
