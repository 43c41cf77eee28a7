#pragma once
/// @file The command line of locate-damage.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lookup/opened_databases.h"
#include "lookup/report/report.h"

namespace voussoir {

struct LocateDamageOptions {
  std::vector<std::string> measurements;  ///< files, at least one
  std::vector<std::string> databases;     ///< files; none: the usual one
  QuestionSettings question;              ///< all but its databases
  ReportFormat format = ReportFormat::text;
  std::optional<std::filesystem::path> page;  ///< file to write the report page or picture to
};

/// Adds the options to the program.
void add_options(CLI::App& app, LocateDamageOptions& options);

/// What is to be asked. Throws InputError for options that do not go together, Failure if no database is
/// named and the usual one is not there.
QuestionSettings question_of(const LocateDamageOptions& options);

}  // namespace voussoir
