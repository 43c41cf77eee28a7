#pragma once
/// @file What would explain readings of a bridge that is not exactly known, and has no part in its posterior:
/// then the answer means nothing.

#include "lookup/lookup.h"
#include "lookup/unknown/unknown_question.h"

namespace voussoir {

/// A question about a bridge that is not exactly known, and what it is asked of.
struct QuestionContext {
  UnknownBridgeQuestion& question;
  const UnknownSettings& settings;
  const Comparison& comparison;
  const Observation& observation;
  const Preparation& preparation;
};

/// A fit that explains nothing, with the reason, if there is one: where blocks are said to be missing a
/// single reading that is grossly wrong, which would be likely, too; sizes that cannot be (check_sizes);
/// falls that show just what the database has of them, which would be likely, too; losses of blocks that are
/// read all the same, which would be likely, too; and, where blocks are said to be missing, errors that are
/// larger than stated, which would be far likelier. Preconditions: some scene is likely, and the answer has
/// what the readings say of the bridge.
std::optional<Fit> find_other(const QuestionContext& asked, const Answer& answer);

}  // namespace voussoir
