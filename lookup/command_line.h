#pragma once
/// @file What the lookup programs' command lines have in common.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "database/records/database.h"

namespace voussoir {

/// The database to open: the given one, else $VOUSSOIR_DATABASE, else ./bridge.h5.
/// Throws Failure naming the command that builds one if there is none.
std::filesystem::path find_database(const std::optional<std::string>& given);

/// What a program says.
struct ProgramOutput {
  ProgramOutput(std::string answer) : text(std::move(answer)) {}
  ProgramOutput(std::string answer, std::string what_lacks)
      : text(std::move(answer)), complaint(std::move(what_lacks)) {}
  std::string text;
  std::string complaint{};  ///< why a part of the answer is not there; then the exit code is 1
};

/// Parses the command line, runs the program and turns exceptions into messages on the standard error and
/// exit codes: 0 done, 1 could not be done, 2 bad usage or bad input. With --format json the message is on
/// the standard output, too (failure_to_json). An answer goes there only when it is whole.
int run_program(CLI::App& app, int argc, char** argv, const std::function<ProgramOutput()>& program);

/// All threads take memory from the program's heap, instead of each from one of its own that grows page by
/// page. Quicker for one question, slower for many side by side. Before there are threads.
void share_heap();

/// An option with one of a few named values. --help names them as "{a,b}", which completions are made from.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Value& value,
                        const std::map<std::string, Value>& choices, const std::string& description) {
  std::string texts;
  for (const auto& [text, meaning] : choices) texts += (texts.empty() ? "" : ",") + text;
  return app
      .add_option_function<std::string>(
          names, [&value, choices](const std::string& text) { value = choices.at(text); }, description)
      ->check(CLI::IsMember(choices))
      ->option_text("{" + texts + "}");
}

/// An option's check: the text must be acceptable to `parse`, whose InputError becomes the message.
template <typename Parse>
CLI::Validator checked_by(Parse parse, const std::string& name) {
  return {[parse](std::string& text) {
            try {
              parse(text);
            } catch (const std::exception& error) {
              return std::string(error.what());
            }
            return std::string();
          },
          name};
}

/// An option whose value is a length in millimetres, or a tilt in millimetres per metre (parse_millimetres),
/// from 0 on; `metres` gets it in metres.
CLI::Option* add_millimetres(CLI::App& app, const std::string& names, double& metres,
                             const std::string& description, std::string_view unit = "mm");

/// An option's check: a number of at least `least` and at most `most`. Other than CLI11's own it refuses NaN.
CLI::Validator number_in_range(double least, double most, const std::string& name);

}  // namespace voussoir
