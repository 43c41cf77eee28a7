#pragma once
/// @file The answers to many files of readings, a row each.

#include <string>
#include <vector>

#include "lookup/report/report.h"

namespace voussoir {

/// What one file says, in a row.
struct SurveyRow {
  std::string file;
  std::string error;       ///< why there is no answer; empty if there is one, and then the rest counts
  std::string verdict{};   ///< with a posterior
  std::string named{};     ///< blocks that are missing for certain, as a scene; empty unless `located`
  double certainty = 0.0;  ///< of the least likely of them; NaN if none is named
  std::string scene{};     ///< the first candidate
  double posterior = 0.0;  ///< of it; NaN without a posterior
  double intact_probability = 0.0;  ///< NaN without a posterior
  double misfit = 0.0;              ///< Eq. 1
  std::size_t readings = 0;
  std::string reason{};           ///< why nothing explains the readings; empty if something does
  std::string database{};         ///< that answers, if several were asked
  std::string suspects{};         ///< sensors that may be wrong (AnswerWithout), "F64, F65"; empty: none
  std::string verdict_without{};  ///< of the readings without them
  std::string named_without{};    ///< and blocks that are missing for certain then
  std::size_t open_losses = 0;    ///< how many losses `intact` does not exclude
  std::size_t open_losses_without = 0;  ///< and without the suspects
};

/// `database`: as in SurveyRow.
SurveyRow survey_row(const std::string& file, const Answer& answer, const Comparison& comparison,
                     const std::string& database = {});

/// file,verdict,named,certainty,scene,posterior,intact_probability,misfit,readings,reason,error,suspects,
/// verdict_without,named_without,open_losses,open_losses_without and, if several databases were asked,
/// database as CSV, the same as a list of objects in JSON, or a line a file for people.
std::string survey_report(const std::vector<SurveyRow>& rows, ReportFormat format);

}  // namespace voussoir
