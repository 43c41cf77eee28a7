#pragma once
/// @file Trials on irregular bridges from the command line's choice of true bridges.

#include <filesystem>
#include <string>
#include <vector>

namespace voussoir {

struct IrregularOptions {
  std::vector<std::string> truths;  ///< databases of sampled bridges
  std::vector<double> sigmas_mm = {0.01, 0.03, 0.1};
  std::size_t every = 10;
  std::string json;  ///< file; empty: none
  std::string page;  ///< file; empty: none
};

/// Runs all trials, printing each row when it is done, and writes the files. Gives the reliability tables.
std::string benchmark_irregular(const std::filesystem::path& database, const IrregularOptions& options);

}  // namespace voussoir
