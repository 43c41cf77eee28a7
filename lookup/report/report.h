#pragma once
/// @file Answers as text and pages for people, and as JSON and CSV for programs.

#include <string>
#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/answer/lookup_settings.h"
#include "lookup/weighed_databases.h"

namespace voussoir {

/// Where the answer comes from.
struct Source {
  std::string measurements;                ///< file
  std::string database;                    ///< file
  std::string bridge;                      ///< name
  std::string digest;                      ///< of the database's content
  bool stands_by_slip;                     ///< as the database says of it
  std::vector<AskedDatabase> databases{};  ///< if several were asked: all, this one, the likeliest, first
  std::vector<std::string> notes{};        ///< sentences about what has no effect on this answer
};

enum class ReportFormat { text, json, csv };

std::string report(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                   const Source& source, ReportFormat format);

/// What is missing, how sure that is, what else could be, what moved, which sensor disagrees.
std::string text_report(const Answer& answer, const Comparison& comparison, const Source& source);

/// {"candidates": [{"scene": "10,4+6,4", "misfit": .., "posterior": ..}, ..], settings, database, judgement}.
/// Sensors are in metres (tilts in radians); of changes the change.
std::string json_report(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                        const Source& source);

/// rank,scene,misfit,posterior,outcome,place,verdict: a row for each candidate, the verdict being that of the
/// whole answer.
std::string csv_report(const Answer& answer, const Library& library);

/// The page of `locate-damage --report`: the bridge with every block's probability, readings against the best
/// fit, the candidates, residuals, and what was assumed. It is complete in itself.
std::string page_report(const Answer& answer, const LookupSettings& settings, const Comparison& comparison,
                        const Source& source);

/// The page's picture of the bridge alone, as a file of its own (SVG). Throws Failure if there is no
/// candidate to show.
std::string picture_report(const Answer& answer, const Comparison& comparison);

/// Names of settings as the command line has them.
std::string_view to_string(Objective objective);
std::string_view to_string(Search search);
std::string_view to_string(Epochs epochs);
std::string_view to_string(Conditions conditions);

}  // namespace voussoir
