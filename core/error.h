#pragma once
/// @file Errors that a person can act on. Every program's main() turns them into exit codes.

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace voussoir {

/// Bad input from outside (a file, an argument). The message names the file, the line when there is one,
/// the offending value and what was expected. Programs exit with code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Something that could not be done although the input was good (disk full, file locked, no database).
/// Programs exit with code 1.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "file:line: message", or "file: message" for line 0.
inline std::string at_line(const std::string& file, long line, const std::string& message) {
  return line > 0 ? fmt::format("{}:{}: {}", file, line, message) : fmt::format("{}: {}", file, message);
}

}  // namespace voussoir
