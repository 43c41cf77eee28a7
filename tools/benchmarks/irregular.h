#pragma once
/// @file Trials on irregular bridges, from the command line's choice of true bridges.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/trials/study.h"

namespace voussoir {

struct IrregularOptions {
  std::vector<std::string> truths;                      ///< databases of sampled bridges; empty: solved here
  std::vector<double> scatters = {0.1, 0.2, 0.3, 0.4};  ///< of the joints of bridges that are solved here
  std::string folder = "build/irregular";               ///< where their databases are
  int bridges = 20;                                     ///< of each kind, with blocks missing
  int intact_bridges = 200;                             ///< of each kind, intact
  bool intact_only = false;
  std::string kind;                                         ///< only those whose names contain this
  ScatterEvidence evidence = ScatterEvidence::first_order;  ///< of the database, where the bridge is unknown
  StudySettings settings;
  std::string json;  ///< file; empty: none
  std::string page;  ///< file; empty: none
};

/// Runs all trials, printing each row when it is done, and writes the files. Gives the reliability tables.
std::string benchmark_irregular(const std::filesystem::path& database, IrregularOptions options);

}  // namespace voussoir
