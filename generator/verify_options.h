#pragma once
/// @file The command line of verify-database.

#include <CLI/CLI.hpp>

#include "generator/verify/verify.h"

namespace voussoir {

struct VerifyOptions {
  VerifyRequest request;
  bool json = false;
};

/// Adds the options to the program.
void add_options(CLI::App& app, VerifyOptions& options);

}  // namespace voussoir
