#pragma once
/// @file What the command lines of all programs have in common, and how programs end.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace voussoir {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    ///< could not be done
inline constexpr int kBadInput = 2;  ///< bad usage or bad input

/// What a program says, and how it ends.
struct ProgramOutput {
  ProgramOutput(std::string answer, int code = kDone, std::string what_lacks = {})
      : text(std::move(answer)), exit_code(code), complaint(std::move(what_lacks)) {}
  std::string text;  ///< for the standard output
  int exit_code;
  std::string complaint;  ///< for the standard error: why a part of the answer is not there
};

/// Parses the command line, runs the program and turns exceptions into messages on the standard error and
/// exit codes: InputError into kBadInput, all others into kFailed. Whoever asks for --format json gets the
/// message as JSON on the standard output, too, whatever is wrong: {"ok": false, "error": ...}. An answer
/// goes there only when it is whole.
int run_program(CLI::App& app, int argc, char** argv, const std::function<ProgramOutput()>& program);

/// An option with one of a few named values. --help names them as "{a,b}", which completions are made from.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices,
                        const std::string& description) {
  std::vector<std::string> texts;
  for (const auto& [text, meaning] : choices) texts.push_back(text);
  const auto choose = [&value, choices](const std::string& chosen) {
    for (const auto& [text, meaning] : choices)
      if (text == chosen) value = meaning;
  };
  return app.add_option_function<std::string>(names, choose, description)
      ->check(CLI::IsMember(texts))
      ->option_text("{" + CLI::detail::join(texts, ",") + "}");
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

/// An option whose value `parse` makes of a text, or refuses with an InputError. --help names it `shown`.
template <typename Value, typename Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& names, Value& value, Parse parse,
                        const std::string& shown, const std::string& description) {
  return app
      .add_option_function<std::string>(
          names, [&value, parse](const std::string& text) { value = parse(text); }, description)
      ->check(checked_by(parse, shown))
      ->option_text(shown);
}

/// An option's check: a number of at least `least` and at most `most`. Other than CLI11's own it refuses NaN.
CLI::Validator number_in_range(double least, double most, const std::string& name);

/// --threads, 0: one for each core.
void add_threads_option(CLI::App& app, int& threads);

/// --format text or json, "of the ...".
void add_format_option(CLI::App& app, bool& json, const std::string& of_what);

/// --seed of random numbers.
void add_seed_option(CLI::App& app, std::uint64_t& seed, const std::string& of_what);

}  // namespace voussoir
