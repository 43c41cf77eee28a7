#pragma once
/// @file The command line of merge-databases.

#include <CLI/CLI.hpp>

#include "generator/merge.h"

namespace voussoir {

struct MergeOptions {
  MergeRequest request;
  bool quiet = false;
  bool json = false;
};

/// Adds the options to the program.
void add_options(CLI::App& app, MergeOptions& options);

}  // namespace voussoir
