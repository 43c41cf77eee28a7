#pragma once
/// @file The command line of locate-damage.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lookup/lookup.h"
#include "lookup/report/report.h"

namespace voussoir {

struct LocateDamageOptions {
  std::vector<std::string> measurements;  ///< files, at least one
  std::vector<std::string>
      databases;  ///< files; none: the usual one. Several: one bridge under other assumptions
  std::optional<std::filesystem::path> sensors;  ///< file of sensors beside the control points
  LookupSettings settings;
  ScatterEvidence evidence = ScatterEvidence::first_order;
  ReportFormat format = ReportFormat::text;
  std::optional<std::filesystem::path> page;  ///< file to write the report page or picture to
  // Texts and units of the command line, which finish() turns into settings.
  std::string history;
  std::string sigma;
  std::string noise_level;
  std::string noise_model = "auto";
  std::string model_error;
  std::string silence = "10%";
  std::string without;
  std::string unknown_scale = "0";
};

/// Adds the options to the program.
void add_options(CLI::App& app, LocateDamageOptions& options);

/// The settings that the parsed options stand for. Throws InputError for what does not go together.
LookupSettings finish(const LocateDamageOptions& options);
ComparisonSettings comparison_settings(const LocateDamageOptions& options);

}  // namespace voussoir
