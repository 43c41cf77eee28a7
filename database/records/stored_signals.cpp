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

/// Calls with the number of every loss of which something is known, what it changes, and A of the intact
/// bridge; with the number alone for all others.
template <class Known, class Unknown>
void for_each_loss(const Sensitivities& sensitivities, const Known& known, const Unknown& unknown) {
  const std::size_t scenes = sensitivities.scenes.size();
  for (std::size_t first = 0; first < sensitivities.known.size(); first += scenes) {
    const bool is_known = sensitivities.is_known(first);
    const SceneFactors intact = is_known ? factors_at(sensitivities, first) : SceneFactors{};
    for (std::size_t place = first; place < first + scenes; ++place)
      if (is_known && place != first && sensitivities.is_known(place))
        known(place, change_of(factors_at(sensitivities, place), intact), intact.bridge);
      else
        unknown(place);
  }
}

void append(const Eigen::MatrixXd& matrix, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
}

/// Columns x points of every loss; none if they have no columns.
void add_by_loss(const char* path, const std::vector<double>& numbers, std::uint64_t losses,
                 std::uint64_t points, const char* meaning, std::vector<DatasetValue>& datasets) {
  if (numbers.empty()) return;
  datasets.push_back(dataset_of(path, ElementType::float64, numbers, points, "m", meaning));
  datasets.back().shape = {losses, numbers.size() / (losses * points), points};
}

}  // namespace

StoredColumns::StoredColumns(const StoredNumbers& dataset, std::size_t first, std::size_t columns,
                             std::size_t points)
    : dataset_(&dataset),
      begin_(first * points),
      columns_(static_cast<Eigen::Index>(columns)),
      points_(static_cast<Eigen::Index>(points)) {}

StoredColumns::View StoredColumns::some(Eigen::Index first, Eigen::Index count) const {
  if (count == 0) return View(nullptr, points_, 0);
  const auto numbers = dataset_->all().subspan(begin_ + static_cast<std::size_t>(first * points_),
                                               static_cast<std::size_t>(count * points_));
  dataset_->require_finite(numbers);
  return View(numbers.data(), points_, count);
}

StoredSignals::StoredSignals(const Hdf5File& file, std::size_t losses, std::size_t points,
                             std::size_t leading, std::size_t of_epoch)
    : points_(points), leading_(leading), of_epoch_(of_epoch) {
  first_ = file.numbers<std::int32_t>(dataset::kSignalFirst, ElementType::int32, kFlat);
  const bool in_order = first_.size() == losses + 1 && first_.front() == 0 && std::ranges::is_sorted(first_);
  file.require(in_order, fmt::format("dataset '{}': expected {} ascending numbers from 0 on",
                                     dataset::kSignalFirst, losses + 1));
  const auto columns = static_cast<std::uint64_t>(first_.back());
  if (columns > 0) {
    own_ = StoredNumbers(file, dataset::kSignalOwn, {columns, points});
    intact_ = StoredNumbers(file, dataset::kSignalIntact, {columns, points});
  }
  if (leading > 0) lead_ = StoredNumbers(file, dataset::kSignalLead, {losses, leading, points});
  if (of_epoch > 0) epoch_ = StoredNumbers(file, dataset::kSignalEpoch, {losses, of_epoch, points});
}

StoredSignals::Columns StoredSignals::operator[](std::size_t loss) const {
  const auto begin = static_cast<std::size_t>(first_[loss]), end = static_cast<std::size_t>(first_[loss + 1]);
  return {{own_, begin, end - begin, points_},
          {intact_, begin, end - begin, points_},
          {lead_, loss * leading_, leading_, points_},
          {epoch_, loss * of_epoch_, of_epoch_, points_}};
}

std::optional<StoredSignals> read_signals(const Hdf5File& file, std::size_t losses, std::size_t points,
                                          std::size_t leading, std::size_t of_epoch) {
  const auto is_there = [&](const char* path, std::size_t columns) { return columns == 0 || file.has(path); };
  const bool all = file.has(dataset::kSignalFirst) && is_there(dataset::kSignalLead, leading) &&
                   is_there(dataset::kSignalEpoch, of_epoch);
  if (!all) return std::nullopt;
  return StoredSignals(file, losses, points, leading, of_epoch);
}

std::vector<DatasetValue> signal_datasets(const Sensitivities& sensitivities) {
  fix_order_of_sums();
  const Eigen::Index points = sensitivities.bridge.rows(), leading = sensitivities.leading_columns();
  std::vector<std::int32_t> first = {0};
  std::vector<double> own, intact, lead, epoch;
  for_each_loss(
      sensitivities,
      [&](std::size_t, const SceneFactors& change, const Eigen::MatrixXd& of_intact) {
        const SignalFactors factors = signal_factors(of_intact, change.bridge);
        append(factors.own, own);
        append(factors.intact, intact);
        append(change.bridge.leftCols(leading), lead);
        append(change.epoch, epoch);
        first.push_back(first.back() + static_cast<std::int32_t>(factors.own.cols()));
      },
      [&](std::size_t) {
        append(Eigen::MatrixXd::Zero(points, leading), lead);
        append(Eigen::MatrixXd::Zero(points, sensitivities.of_epoch()), epoch);
        first.push_back(first.back());
      });
  std::vector<DatasetValue> datasets = {
      dataset_of(dataset::kSignalFirst, ElementType::int32, first, kFlat, "1",
                 "of each scene with sensitivities in each state, state after state: the first of its "
                 "columns, and one past the last column")};
  const std::uint64_t losses = sensitivities.known.size(), length = static_cast<std::uint64_t>(points);
  add_by_loss(dataset::kSignalLead, lead, losses, length,
              "of each loss, numbered likewise: the leading columns of D; zero where nothing is known",
              datasets);
  add_by_loss(dataset::kSignalEpoch, epoch, losses, length,
              "and what it changes in epoch_factors, column by column", datasets);
  if (own.empty()) return datasets;
  datasets.push_back(dataset_of(dataset::kSignalOwn, ElementType::float64, own, length, "m",
                                "what a loss changes in bridge_factors, D = B W^T, W having orthonormal "
                                "columns: the columns of B, the largest variance that is left first"));
  datasets.push_back(dataset_of(dataset::kSignalIntact, ElementType::float64, intact, length, "m",
                                "and those of the intact bridge's bridge_factors times W"));
  return datasets;
}

bool are_signals_right(const Sensitivities& sensitivities) {
  const StoredSignals& stored = *sensitivities.signals;
  bool right = true;
  for_each_loss(
      sensitivities,
      [&](std::size_t loss, const SceneFactors& change, const Eigen::MatrixXd& of_intact) {
        const StoredSignals::Columns columns = stored[loss];
        SignalFactors factors;  // named: g++ 12 destroys a temporary here twice if a number is not finite
        factors.own = columns.own.all();
        factors.intact = columns.intact.all();
        right = right && columns.lead.all() == change.bridge.leftCols(columns.lead.columns()) &&
                columns.epoch.all() == change.epoch && are_signal_factors(factors, of_intact, change.bridge);
      },
      [&](std::size_t loss) {
        const StoredSignals::Columns columns = stored[loss];
        right = right && columns.own.columns() == 0 && columns.lead.all().isZero(0.0) &&
                columns.epoch.all().isZero(0.0);
      });
  return right;
}

}  // namespace voussoir
