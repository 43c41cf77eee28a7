#pragma once
/// @file What a reproduction looks at, and what it shows.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lookup/lookup.h"
#include "lookup/report/drawing/page.h"
#include "tools/trials/paper_cases.h"

namespace voussoir {

struct ReproductionSettings {
  int trials = 50;          ///< noisy trials (seeds) of each case and noise level
  int random_scenes = 150;  ///< of the operating curves at each noise level, and of the comparisons
  std::uint64_t seed = 1;
  std::string wall{};  ///< bridge file of the wall of Fig. 3; empty: left out
};

/// A database with the cases to show.
struct Subject {
  const Database& database;
  PaperCases cases;
  ReproductionSettings settings;
  SceneTable few;  ///< the first rows of the table: intact and one missing block
  SearchIndexData few_index;

  /// Throws Failure if of a scene only the outcome is known: the paper reads scenes that fall, too.
  Subject(const Database& of, PaperCases shown, const ReproductionSettings& with);

  /// All scenes, or only those with at most one missing block, which is quicker.
  Library all() const { return library_of(database); }
  Library one_block() const { return {few, database.control_points(), database.layout(), few_index.view()}; }

  /// Rows and displacements [mm] of a scene.
  std::size_t row(const std::string& scene) const;
  std::vector<double> settlements_mm(std::size_t row) const;
};

/// "(10,4)", "(4,10) + (2,6)": a scene as the paper writes it.
std::string as_printed(const std::string& scene);

/// A noise level in per cent, free of rounding dust: 0.07 is 7 and not 7.000000000000001.
double noise_per_cent(double level);

/// A figure, and tables that are too long for the page.
struct Exhibit {
  Figure figure;                                      ///< its table goes to the file <id>.csv
  std::vector<std::pair<std::string, Table>> more{};  ///< files <name>.csv
};

/// A part of the page.
struct Chapter {
  std::string id, heading;
  std::string text;  ///< HTML
  std::vector<Exhibit> exhibits;
};

}  // namespace voussoir
