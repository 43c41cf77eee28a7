#pragma once
/// @file The cases of a paper's figures and tables, or of another bridge in their place.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voussoir {

/// A scene that is measured with noise, and what the paper found.
struct PaperCase {
  std::string scene;
  double noise = 0.0;  ///< [-]
  std::string paper;   ///< generations to convergence as printed there, "-" for not found, "" for not tried
};

/// A scene whose displacements are drawn.
struct FieldCase {
  std::string scene;
  std::string figure;  ///< its number in the paper, "8"
};

struct PaperCases {
  std::string source;                       ///< the paper
  PaperCase example;                        ///< Figs. 4, 6 and 7
  std::vector<FieldCase> fields;            ///< Figs. 8 to 16
  std::vector<PaperCase> one_block;         ///< Table 2
  std::vector<PaperCase> two_blocks;        ///< Table 3
  std::optional<PaperCase> hard_pair;       ///< what the paper calls hard to find
  std::string noise_limit_in_paper;         ///< what it says of noise that the search bears in Fig. 7
  std::vector<double> noise_limit_levels;   ///< noise levels [-] to compare with that
  std::string collapse_in_paper;            ///< what it says of local collapses
  std::vector<std::string> local_collapse;  ///< scenes to compare with that
  // What the paper says of its model, if it does.
  std::optional<int> triangles;
  std::optional<std::array<double, 2>> top_mm, arch_mm;  ///< smallest and largest settlement of the example
  std::optional<double> radius_m;
};

/// Reads a file such as examples/cases/paper.json. Throws InputError naming the file and what was expected.
PaperCases read_paper_cases(const std::filesystem::path& path);

/// examples/cases/paper.json in this source tree.
std::filesystem::path paper_cases_file();

}  // namespace voussoir
