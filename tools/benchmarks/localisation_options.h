#pragma once
/// @file What benchmark-localisation --irregular can be told.

#include "core/program/command_line.h"
#include "tools/benchmarks/irregular.h"

namespace voussoir {

void add_irregular_options(CLI::App& app, IrregularOptions& options);

}  // namespace voussoir
