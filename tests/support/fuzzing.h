#pragma once
/// @file Damaged inputs for readers, made from good ones (tests/corpus) by random changes, and limits within
/// which a reader has to stay: an input that takes more than a minute or a gigabyte ends the test program.

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/support/file_text.h"

namespace voussoir::test {

using Chance = std::mt19937_64;  ///< gives the same numbers on every machine

inline std::size_t below(Chance& chance, std::size_t bound) {
  return static_cast<std::size_t>(chance() % bound);
}

inline std::filesystem::path corpus_folder(const std::string& folder) {
  return std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "tests/corpus" / folder;
}

/// All files of a folder of tests/corpus, in the order of their names.
inline std::vector<std::string> corpus(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(corpus_folder(folder)))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const auto& path : paths) texts.push_back(text_of(path));
  return texts;
}

/// Puts another number in the place of the first one at or after `at`.
inline void change_number(std::string& text, std::size_t at, Chance& chance) {
  constexpr const char* kDigits = "0123456789.";
  const std::size_t begin = text.find_first_of(kDigits, at);
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(text.find_first_not_of(kDigits, begin), text.size());
  const double numbers[] = {0.0, 0.001, 0.3, 1.0, 2.0, 5.0, 17.0, 1000.0, 1e5};
  const double number =
      numbers[below(chance, std::size(numbers))] * (1.0 + 1e-3 * static_cast<double>(below(chance, 3)));
  std::string digits = std::to_string(number);
  if (below(chance, 2) == 0) digits.resize(digits.find('.'));
  text.replace(begin, end - begin, digits);
}

/// A text of `good` after a change or some; `nasty` are pieces that parsers stumble over.
inline std::string damaged_text(const std::vector<std::string>& good, const std::vector<std::string>& nasty,
                                Chance& chance) {
  std::string text = good[below(chance, good.size())];
  for (std::size_t changes = 1 + below(chance, 1 + below(chance, 6)); changes > 0; --changes) {
    const std::size_t at = below(chance, text.size() + 1);
    const std::string& piece = nasty[below(chance, nasty.size())];
    switch (below(chance, 8)) {
      case 0:
        text.insert(at, piece);
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(chance()));
        break;
      case 2:
        text.replace(at, 1, 1, static_cast<char>(chance()));
        break;
      case 3:
        text.erase(at, below(chance, 8));
        break;
      case 4:
        text.insert(at, text.substr(below(chance, at + 1), 20));
        break;
      case 5:
        text.replace(at, 1 + below(chance, 6), piece);
        break;
      default:
        change_number(text, at, chance);
    }
  }
  return text;
}

/// While it lives, more than a minute between two calls of `next`, or a gigabyte more memory than before, is
/// a failure. Sanitizers map terabytes of address space for themselves; memory is limited in the other
/// builds.
class ReaderLimits {
 public:
  ReaderLimits() {
    ::getrlimit(RLIMIT_AS, &before_);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    constexpr rlim_t kGigabyte = rlim_t{1} << 30;
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlimit limit{pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kGigabyte, before_.rlim_max};
    ::setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~ReaderLimits() {
    ::alarm(0);
    ::setrlimit(RLIMIT_AS, &before_);
  }
  ReaderLimits(const ReaderLimits&) = delete;
  ReaderLimits& operator=(const ReaderLimits&) = delete;

  /// To be called before each input. False when ten minutes have passed since the first.
  bool next() const {
    constexpr unsigned kSeconds = 60;
    ::alarm(kSeconds);  // nobody handles SIGALRM: it ends the program
    return std::chrono::steady_clock::now() - start_ < std::chrono::minutes(10);
  }

 private:
  rlimit before_{};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What became of an input. Set aside: sound, but not worth the time that using it would take.
enum class Verdict { accepted, refused, set_aside };

struct Tally {
  int accepted = 0;
  int refused = 0;
};

/// Tries `inputs` inputs, or as many as ten minutes allow, within the limits; `try_one` makes an input and
/// reads it.
template <class TryOne>
Tally feed(int inputs, TryOne try_one) {
  const ReaderLimits limits;
  Tally tally;
  for (int i = 0; i < inputs && limits.next(); ++i) {
    const Verdict verdict = try_one();
    tally.accepted += verdict == Verdict::accepted ? 1 : 0;
    tally.refused += verdict == Verdict::refused ? 1 : 0;
  }
  return tally;
}

}  // namespace voussoir::test
