#pragma once
/// @file What the command lines of programs that ask databases have in common.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/program/command_line.h"

namespace voussoir {

/// --database, of which find_database makes a file.
void add_database_option(CLI::App& app, std::optional<std::string>& database);

/// --history, one of the two that a database may have.
void add_history_option(CLI::App& app, std::optional<std::string>& history, const std::string& description);

/// The database to open: the given one, else $VOUSSOIR_DATABASE, else ./bridge.h5.
/// Throws Failure naming the command that builds one if there is none.
std::filesystem::path find_database(const std::optional<std::string>& given);

/// The same of a program that takes several: those that are given, or the usual one.
std::vector<std::filesystem::path> find_databases(const std::vector<std::string>& given);

/// An option whose value is a length in millimetres, or a tilt in millimetres per metre (parse_millimetres),
/// from 0 on; `metres` gets it in metres.
CLI::Option* add_millimetres(CLI::App& app, const std::string& names, double& metres,
                             const std::string& description, std::string_view unit = "mm");

}  // namespace voussoir
