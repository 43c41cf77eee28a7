#pragma once
/// @file Results as text, JSON, Markdown and a page.

#include "tools/validation/suite.h"

namespace voussoir::validation {

/// Tables of known answers and hard cases, limits, and a last line that counts.
std::string to_text(const std::vector<StudyResult>& results);

/// {"ok", "cases": [..], "hard_cases": [..], "notes": [..], "studies": [{"name", "seconds", "failure"}]}
std::string to_json(const std::vector<StudyResult>& results);

/// The known answers as a table without reasons, and the hard cases counted by sweep.
std::string to_markdown(const std::vector<StudyResult>& results);

/// One HTML file with tables and plots, which fetches nothing.
std::string to_page(const std::vector<StudyResult>& results);

/// "12 of 12 known answers within tolerance, ..."
std::string to_sentence(const Tally& tally);

/// "within", "OUTSIDE" or "comparison"; "correct" or "WRONG".
std::string mark(const Case& known);
std::string mark(const HardCase& hard);

}  // namespace voussoir::validation
