#pragma once
/// @file What a build says when it is done.

#include <string>

#include "generator/build.h"

namespace voussoir {

/// A few lines for people; as to_text(OutcomeCounts) has them.
std::string to_text(const BuildSummary& summary);

/// One line of JSON for programs: {"ok": true, "file", "up_to_date", "blocks",
/// "joined_pieces", "small_pieces", what OutcomeCounts has, "collapses": "field" or "outcome",
/// "computed", "resumed", "reused", "merged", "changes", "seconds", "bytes", "digest"}.
std::string to_json(const BuildSummary& summary);

}  // namespace voussoir
