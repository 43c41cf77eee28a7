#include "database/records/stored_signals.h"

#include <algorithm>

#include "database/records/order_of_sums.h"
#include "database/records/scene_change.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

SceneFactors factors_at(const Sensitivities& sensitivities, std::size_t place) {
  return {sensitivities.bridge[place], sensitivities.epoch[place]};
}

/// Calls with the number of every loss of which something is known, what it changes in A, and A of the intact
/// bridge; with the number alone for all others.
template <class Known, class Unknown>
void for_each_loss(const Sensitivities& sensitivities, const Known& known, const Unknown& unknown) {
  const std::size_t scenes = sensitivities.scenes.size();
  for (std::size_t first = 0; first < sensitivities.known.size(); first += scenes) {
    const bool is_known = sensitivities.known[first] != 0;
    const SceneFactors intact = is_known ? factors_at(sensitivities, first) : SceneFactors{};
    for (std::size_t place = first; place < first + scenes; ++place)
      if (is_known && place != first && sensitivities.known[place] != 0)
        known(place, change_of(factors_at(sensitivities, place), intact).bridge, intact.bridge);
      else
        unknown(place);
  }
}

void append(const Eigen::MatrixXd& matrix, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
}

}  // namespace

StoredSignals::StoredSignals(const Hdf5File& file, std::size_t losses, std::size_t points) : points_(points) {
  first_ = file.numbers<std::int32_t>(dataset::kSignalFirst, ElementType::int32, kFlat);
  const bool in_order = first_.size() == losses + 1 && first_.front() == 0 && std::ranges::is_sorted(first_);
  file.require(in_order, fmt::format("dataset '{}': expected {} ascending numbers from 0 on",
                                     dataset::kSignalFirst, losses + 1));
  const auto columns = static_cast<std::uint64_t>(first_.back());
  if (columns == 0) return;
  own_ = StoredNumbers(file, dataset::kSignalOwn, {columns, points});
  intact_ = StoredNumbers(file, dataset::kSignalIntact, {columns, points});
}

StoredSignals::Views StoredSignals::operator[](std::size_t loss) const {
  const auto begin = static_cast<std::size_t>(first_[loss]), end = static_cast<std::size_t>(first_[loss + 1]);
  const auto view = [&](const StoredNumbers& numbers) {
    const auto some = numbers.all().subspan(begin * points_, (end - begin) * points_);
    numbers.require_finite(some);
    return View(some.data(), static_cast<Eigen::Index>(points_), static_cast<Eigen::Index>(end - begin));
  };
  return {view(own_), view(intact_)};
}

std::optional<StoredSignals> read_signals(const Hdf5File& file, std::size_t losses, std::size_t points) {
  if (!file.has(dataset::kSignalFirst)) return std::nullopt;
  return StoredSignals(file, losses, points);
}

std::vector<DatasetValue> signal_datasets(const Sensitivities& sensitivities) {
  fix_order_of_sums();
  std::vector<std::int32_t> first = {0};
  std::vector<double> own, intact;
  for_each_loss(
      sensitivities,
      [&](std::size_t, const Eigen::MatrixXd& change, const Eigen::MatrixXd& of_intact) {
        const SignalFactors factors = signal_factors(of_intact, change);
        append(factors.own, own);
        append(factors.intact, intact);
        first.push_back(first.back() + static_cast<std::int32_t>(factors.own.cols()));
      },
      [&](std::size_t) { first.push_back(first.back()); });
  std::vector<DatasetValue> datasets = {
      dataset_of(dataset::kSignalFirst, ElementType::int32, first, kFlat, "1",
                 "of each scene with sensitivities in each state, state after state: the first of its "
                 "columns, and one past the last column")};
  if (own.empty()) return datasets;
  const auto points = static_cast<std::uint64_t>(sensitivities.bridge.rows());
  datasets.push_back(dataset_of(dataset::kSignalOwn, ElementType::float64, own, points, "m",
                                "what a loss changes in bridge_factors, D = B W^T, W having orthonormal "
                                "columns: the columns of B, the largest variance that is left first"));
  datasets.push_back(dataset_of(dataset::kSignalIntact, ElementType::float64, intact, points, "m",
                                "and those of the intact bridge's bridge_factors times W"));
  return datasets;
}

bool are_signals_right(const Sensitivities& sensitivities) {
  const StoredSignals& stored = *sensitivities.signals;
  bool right = true;
  for_each_loss(
      sensitivities,
      [&](std::size_t loss, const Eigen::MatrixXd& change, const Eigen::MatrixXd& of_intact) {
        const auto [own, intact] = stored[loss];
        right = right && are_signal_factors({own, intact}, of_intact, change);
      },
      [&](std::size_t loss) { right = right && stored[loss].own.cols() == 0; });
  return right;
}

}  // namespace voussoir
