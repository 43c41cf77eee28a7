#include "tools/trials/taken_readings.h"

#include <cmath>

#include "core/not_a_number.h"

namespace voussoir {

std::string_view to_string(ReadingsTaken taken) {
  switch (taken) {
    case ReadingsTaken::change:
      return "change";
    case ReadingsTaken::two_epochs:
      return "two epochs";
    default:
      return "absolute";
  }
}

ReadingsFile take_readings(const Shown& shown, ReadingsTaken taken, double sigma, Random& random) {
  const bool absolute = taken == ReadingsTaken::absolute;
  const double of_epoch = absolute ? sigma : sigma * std::sqrt(0.5);
  ReadingsFile file{
      "", absolute ? ReadingKind::absolute : ReadingKind::change, taken == ReadingsTaken::two_epochs, {}};
  for (std::size_t point = 0; point < shown.after.size(); ++point) {
    const double before = absolute ? 0.0 : shown.before[point] + of_epoch * random.gaussian();
    const double after = shown.after[point] + of_epoch * random.gaussian();
    file.readings.push_back({.line = static_cast<long>(point) + 2,
                             .sensor = point,
                             .value = after - before,
                             .before = file.two_epochs ? before : kNan,
                             .after = file.two_epochs ? after : kNan,
                             .sigma = sigma,
                             .silent = std::isnan(after)});
  }
  return file;
}

}  // namespace voussoir
