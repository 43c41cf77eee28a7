#pragma once
/// @file The databases that locate-damage asks, and asking them.

#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database/records/database.h"
#include "lookup/answer/lookup_settings.h"
#include "lookup/prepared_questions.h"
#include "lookup/readings/comparison.h"
#include "lookup/readings/readings_file.h"
#include "lookup/weighed_databases.h"

namespace voussoir {

/// What is asked, beside the readings.
struct QuestionSettings {
  std::vector<std::filesystem::path> databases{};  ///< several: one bridge under other assumptions
  LookupSettings lookup{};
  ComparisonSettings comparison{};
  ScatterEvidence evidence = ScatterEvidence::first_order;
  std::optional<std::filesystem::path> sensors{};  ///< file of sensors beside the databases' own
  std::string without{};                           ///< names of readings that are left out, with commas
};

/// A database, and what all questions to it share beside their readings.
struct OpenedDatabase {
  QuestionSettings question;
  Database database;
  SensorList sensors;
  std::shared_ptr<const SampledBridges> sampled{};  ///< null: the first order speaks
  PreparedQuestions preparations{};
};

using OpenedDatabases = std::list<OpenedDatabase>;  // each stays where it is

/// Throws Failure for what is no whole database, InputError for options and files that do not go together and
/// for a database that comes twice.
OpenedDatabases open_databases(const QuestionSettings& question);

/// A question with the answer of the database whose assumptions are likeliest.
struct Answered {
  const OpenedDatabase* opened;
  Comparison comparison;
  LookupSettings settings;
  Answer answer;
  std::vector<AskedDatabase> databases{};  ///< as in Source: of several all, this one's first
  std::vector<std::string> notes{};        ///< as in Source
};

/// Puts a question to all databases. Throws InputError for readings that one of them cannot be asked about,
/// and for databases that cannot be weighed against each other (weighed_databases.h).
Answered ask(OpenedDatabases& opened, const ReadingsText& readings);

}  // namespace voussoir
