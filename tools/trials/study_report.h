#pragma once
/// @file What a study of irregular bridges found, as text, JSON and a page.

#include "tools/trials/study.h"

namespace voussoir {

/// What the study was made with, for whoever reads its results.
struct StudySource {
  std::string database;  ///< path
  std::string digest;
  std::string bridge;
  std::vector<std::string> truths;  ///< what the true bridges are, in words
  StudySettings settings;
};

/// The heading of the table, and a line of it.
std::string heading_text();
std::string to_text(const StudyRow& row);

/// The reliability of all rows of an unknown and of a known bridge, bin by bin.
std::string reliability_text(const std::vector<StudyRow>& rows);

/// {"source", "rows": [..]} with everything that a StudyRow has.
std::string to_json(const StudySource& source, const std::vector<StudyRow>& rows);

/// One HTML file with tables and reliability diagrams, which fetches nothing.
std::string to_page(const StudySource& source, const std::vector<StudyRow>& rows);

/// The bins of several rows as if they were of one series.
std::vector<ReliabilityBin> joined_bins(const std::vector<StudyRow>& rows, bool known_bridge);

}  // namespace voussoir
