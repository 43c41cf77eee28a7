#pragma once
/// @file The command line of verify-database.

#include <optional>

#include "generator/verify/verify.h"

namespace voussoir {

struct VerifyOptions {
  VerifyRequest request;
  bool json = false;
  std::optional<int> exit_code;  ///< set if the program is to end at once (--help, --version, bad usage)
};

/// Prints help, version or what is wrong with the command line itself.
VerifyOptions parse_verify_options(int argc, char** argv);

}  // namespace voussoir
