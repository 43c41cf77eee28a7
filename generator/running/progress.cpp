#include "generator/running/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace voussoir {
namespace {

constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};
constexpr int kBarWidth = 30;
constexpr const char* kClearLine = "\r\033[K";

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  return whole >= 60 ? fmt::format("{} min {} s", whole / 60, whole % 60) : fmt::format("{} s", whole);
}

}  // namespace

std::string progress_text(std::size_t done, std::size_t total, const std::string& what,
                          std::size_t done_since_start, double seconds) {
  const std::string count = fmt::format("{} of {} {}", done, total, what);
  if (done_since_start == 0 || seconds <= 0.0) return count;
  const double rate = static_cast<double>(done_since_start) / seconds;
  const std::string rate_text = rate < 10.0 ? fmt::format("{:.2g}", rate) : fmt::format("{:.0f}", rate);
  return fmt::format("{}, {}/s, {} left", count, rate_text,
                     duration_text(static_cast<double>(total - done) / rate));
}

std::string progress_bar(std::size_t done, std::size_t total, int width) {
  const auto filled = total == 0 ? 0 : done * static_cast<std::size_t>(width) / total;
  return "[" + std::string(filled, '#') + std::string(static_cast<std::size_t>(width) - filled, '-') + "]";
}

Progress::Progress(Mode mode) : mode_(mode), terminal_(::isatty(STDERR_FILENO) == 1) {}

void Progress::say(const std::string& message) {
  const std::scoped_lock lock(mutex_);
  if (mode_ != Mode::quiet) fmt::print(stderr, "{}{}\n", terminal_ ? kClearLine : "", message);
}

void Progress::start(std::size_t total, std::size_t done, std::string what) {
  const std::scoped_lock lock(mutex_);
  what_ = std::move(what);
  total_ = total;
  done_ = done_before_ = done;
  started_ = Clock::now();
  if (mode_ != Mode::quiet && done_ < total_) show(started_);  // the first one may take long
}

void Progress::advance(std::size_t more) {
  const std::scoped_lock lock(mutex_);
  done_ += more;
  show_if_due();
}

void Progress::show_if_due() {
  const Clock::time_point now = Clock::now();
  const bool due = terminal_ ? now - shown_ >= kBarInterval : now - shown_ >= kLineInterval;
  if (mode_ != Mode::quiet && due) show(now);
}

void Progress::show(Clock::time_point now) {
  shown_ = now;
  const double seconds = std::chrono::duration<double>(now - started_).count();
  const std::string text = progress_text(done_, total_, what_, done_ - done_before_, seconds);
  if (terminal_)
    fmt::print(stderr, "{}{} {}", kClearLine, progress_bar(done_, total_, kBarWidth), text);
  else
    fmt::print(stderr, "{}\n", text);
  std::fflush(stderr);
}

void Progress::finish() {
  const std::scoped_lock lock(mutex_);
  if (mode_ == Mode::quiet || done_before_ == total_) return;
  show(Clock::now());
  if (terminal_) fmt::print(stderr, "\n");
}

}  // namespace voussoir
