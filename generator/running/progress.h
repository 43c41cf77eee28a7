#pragma once
/// @file Telling a person how far a build has come.

#include <chrono>
#include <mutex>
#include <string>

namespace voussoir {

/// Writes to stderr: a bar that is drawn over and over on a terminal, a plain line every few seconds
/// elsewhere. Thread-safe.
class Progress {
 public:
  enum class Mode { automatic, quiet };

  explicit Progress(Mode mode);

  /// A message on a line of its own; nothing in quiet mode.
  void say(const std::string& message);

  /// `done` of `total` are there already, which is shown at once; the rate counts what comes from now on.
  /// `what` they are: "scenes".
  void start(std::size_t total, std::size_t done, std::string what);
  void advance(std::size_t more);
  /// Ends the bar's line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void show_if_due();
  void show(Clock::time_point now);

  Mode mode_;
  bool terminal_;
  std::mutex mutex_;
  std::string what_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  std::size_t done_before_ = 0;
  Clock::time_point started_{};
  Clock::time_point shown_{};
};

/// "1234 of 22579 scenes, 210/s, 1 min 42 s left"
std::string progress_text(std::size_t done, std::size_t total, const std::string& what,
                          std::size_t done_since_start, double seconds);

/// "[#####-----]", `width` characters between the brackets.
std::string progress_bar(std::size_t done, std::size_t total, int width);

}  // namespace voussoir
