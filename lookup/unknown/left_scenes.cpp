#include "lookup/unknown/left_scenes.h"

namespace voussoir {
namespace {

constexpr double kRounded = 1e-6;  // of a sum is what differences of it are trusted to

}  // namespace

LeftScenes::LeftScenes(std::vector<std::size_t> places, std::span<const double> estimates, KindOf kind_of)
    : estimates_(estimates), kind_of_(std::move(kind_of)), places_(std::move(places), estimates) {
  add_up();
}

void LeftScenes::add_up() {
  sums_ = {};
  if (!places_.empty()) unit_ = estimates_[places_.first()];
  for (const std::size_t place : places_.rest())
    sums_[kind_of_(place)] += std::exp(estimates_[place] - unit_);
  summed_ = sums_;
}

std::vector<std::size_t> LeftScenes::next(std::size_t count) {
  std::vector<std::size_t> taken;
  while (taken.size() < count && !places_.empty()) taken.push_back(places_.next());
  for (const std::size_t place : taken) sums_[kind_of_(place)] -= std::exp(estimates_[place] - unit_);
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    if (sums_[kind] < kRounded * summed_[kind]) return add_up(), taken;
  return taken;
}

void LeftScenes::order_again() {
  places_ = DescendingPlaces(std::vector(places_.rest().begin(), places_.rest().end()), estimates_);
  add_up();
}

void LeftScenes::learn(std::size_t place, double exact) {
  errors_[kind_of_(place)].add(estimates_[place], exact);
}

double LeftScenes::log_sum() const {
  double sum = 0.0;
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    sum += sums_[kind] * std::exp(kind == kOther ? 0.0 : errors_[kind].most());
  return unit_ + std::log(sum);
}

std::vector<PlaceLog> LeftScenes::corrected() const {
  std::array<double, kKinds> corrections{};
  for (std::size_t kind = 0; kind < kKinds; ++kind) corrections[kind] = errors_[kind].mean();
  std::vector<PlaceLog> result;
  for (const std::size_t place : places_.rest())
    result.push_back({place, estimates_[place] + corrections[kind_of_(place)]});
  return result;
}

}  // namespace voussoir
