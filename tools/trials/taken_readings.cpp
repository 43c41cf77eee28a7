#include "tools/trials/taken_readings.h"

#include <cmath>

#include "core/not_a_number.h"

namespace voussoir {
namespace {

ReadingKind kind_of(ReadingsTaken taken) {
  switch (taken) {
    case ReadingsTaken::absolute:
      return ReadingKind::absolute;
    case ReadingsTaken::load:
      return ReadingKind::load;
    case ReadingsTaken::load_change:
      return ReadingKind::load_change;
    default:
      return ReadingKind::change;
  }
}

}  // namespace

std::string_view to_string(ReadingsTaken taken) {
  switch (taken) {
    case ReadingsTaken::change:
      return "change";
    case ReadingsTaken::two_epochs:
      return "two epochs";
    case ReadingsTaken::load:
      return "load";
    case ReadingsTaken::load_change:
      return "load change";
    default:
      return "absolute";
  }
}

ReadingsFile take_readings(const Shown& shown, ReadingsTaken taken, double sigma, Random& random,
                           const std::string& load) {
  const ReadingKind kind = kind_of(taken);
  const double of_epoch = is_change(kind) ? sigma * std::sqrt(0.5) : sigma;
  ReadingsFile file{"", kind, taken == ReadingsTaken::two_epochs, {}};
  for (std::size_t point = 0; point < shown.after.size(); ++point) {
    const double before = is_change(kind) ? shown.before[point] + of_epoch * random.gaussian() : 0.0;
    const double after = shown.after[point] + of_epoch * random.gaussian();
    file.readings.push_back({.line = static_cast<long>(point) + 2,
                             .sensor = point,
                             .load = load,
                             .value = after - before,
                             .before = file.two_epochs ? before : kNan,
                             .after = file.two_epochs ? after : kNan,
                             .sigma = sigma,
                             .silent = std::isnan(after)});
  }
  return file;
}

}  // namespace voussoir
