#pragma once
/// @file What the generator programs' command lines have in common.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace voussoir {

/// Parses the command line. The exit code if the program is to end at once: after --help or --version, or
/// when it has told what is wrong with the command line itself (to programs, too, if they ask for JSON).
std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv);

/// --threads.
void add_threads_option(CLI::App& app, int& threads);

/// --format text or json, "of the ...".
void add_format_option(CLI::App& app, bool& json, const std::string& of_what);

/// Writes an answer to the standard output. Throws Failure if it cannot be written.
void say(const std::string& answer);

}  // namespace voussoir
