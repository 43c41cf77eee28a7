#include "database/records/stored_sensitivities.h"

#include <algorithm>
#include <functional>

#include "database/format/names.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

using Shape = std::vector<std::uint64_t>;

constexpr double kMostInfluence = 1e-3;  // [m per N/m] bridges have some 1e-8

std::uint64_t extent(Eigen::Index size) {
  return static_cast<std::uint64_t>(size);
}

/// A dataset being filled.
template <class T>
struct Filling {
  const char* path;
  ElementType type;
  const char* units;
  const char* meaning;
  std::vector<T> values{};

  void add(const Eigen::MatrixXd& matrix) {
    const StackedMatrices::RowMajor rows = matrix;
    values.insert(values.end(), rows.data(), rows.data() + rows.size());
  }
  /// Nothing is kept of a dataset without elements.
  void finish(const Shape& shape, std::vector<DatasetValue>& datasets) const {
    if (values.empty()) return;
    datasets.push_back(dataset_of(path, type, values, kFlat, units, meaning));
    datasets.back().shape = shape;
  }
};

void append_matrix(const char* path, const char* units, const char* meaning, const Eigen::MatrixXd& matrix,
                   std::vector<DatasetValue>& datasets) {
  Filling<double> filling{path, ElementType::float64, units, meaning};
  filling.add(matrix);
  filling.finish({extent(matrix.rows()), extent(matrix.cols())}, datasets);
}

void append_parameters(const Sensitivities& from, std::vector<DatasetValue>& datasets) {
  std::vector<std::string> names, units;
  Filling<double> sigma{dataset::kUncertainSigma, ElementType::float64, "1",
                        "standard deviation of each, in its unit"};
  Filling<std::uint8_t> of_epoch{dataset::kUncertainOfEpoch, ElementType::uint8, "1",
                                 "1: has a value of its own in every epoch, 0: the bridge has one for good"};
  for (const UncertainParameter& parameter : from.parameters) {
    names.push_back(parameter.name);
    units.push_back(parameter.unit);
    sigma.values.push_back(parameter.sigma);
    of_epoch.values.push_back(parameter.of_epoch ? 1 : 0);
  }
  datasets.push_back(name_dataset(dataset::kUncertainName, names, kParameterNameWidth,
                                  "uncertain parameters: those of the bridge, then those of an epoch"));
  datasets.push_back(
      name_dataset(dataset::kUncertainUnit, units, kUnitWidth, "unit of each parameter; 1: of a logarithm"));
  sigma.finish({names.size()}, datasets);
  of_epoch.finish({names.size()}, datasets);
}

void append_scenes(const Sensitivities& from, std::vector<DatasetValue>& datasets) {
  std::size_t most_missing = 1;
  for (const Scene& scene : from.scenes) most_missing = std::max(most_missing, scene.removed.size());
  Filling<std::int32_t> removed{dataset::kSensitivityRemoved, ElementType::int32, "1",
                                "removed blocks of each scene with sensitivities, ascending, then -1"};
  for (const Scene& scene : from.scenes) {
    const std::size_t end = removed.values.size() + most_missing;
    for (const BlockId block : scene.removed) removed.values.push_back(value(block));
    removed.values.resize(end, -1);
  }
  removed.finish({from.scenes.size(), most_missing}, datasets);
}

/// Factors stay where they are.
void append_in_place(const char* path, const StackedMatrices& from, const Shape& shape, const char* meaning,
                     std::vector<DatasetValue>& datasets) {
  if (from.numbers().empty()) return;
  datasets.push_back({path, ElementType::float64, shape, 0, "m", meaning, {}, view_bytes(from.numbers())});
}

void append_factors(const Sensitivities& from, std::vector<DatasetValue>& datasets) {
  const std::uint64_t states = from.residuals.size(), scenes = from.scenes.size();
  Filling<std::uint8_t> known{
      dataset::kSensitivityKnown, ElementType::uint8, "1",
      "1: the scene has sensitivities in the state, 0: it does not stand, 2: it falls in the nominal bridge, "
      "but stands in some of those drawn at random, of which its sensitivities are"};
  for (const FactorsKnown one : from.known) known.values.push_back(static_cast<std::uint8_t>(one));
  known.finish({states, scenes}, datasets);
  const auto shape_of = [&](const StackedMatrices& of) {
    return Shape{states, scenes, extent(of.rows()), extent(of.columns())};
  };
  append_in_place(dataset::kBridgeFactors, from.bridge, shape_of(from.bridge),
                  "change of the control points' vertical displacements with each column of the basis",
                  datasets);
  append_in_place(dataset::kEpochFactors, from.epoch, shape_of(from.epoch),
                  "and with each parameter of an epoch, by one standard deviation", datasets);
  append_in_place(
      dataset::kSignalLeft, from.left, shape_of(from.left),
      "error of the first order in what an epoch changes of each loss's signal, a column for each of some "
      "sampled bridges, over the root of their number; zero where it does not stand",
      datasets);
}

void append_falls(const Sensitivities& from, std::vector<DatasetValue>& datasets) {
  const std::uint64_t states = from.residuals.size(), scenes = from.scenes.size();
  Filling<double>{
      dataset::kStandingShare, ElementType::float64, "1",
      "of what falls in the nominal bridge but stands in some of those drawn at random, the share "
      "of these; 0: of all other scenes",
      from.standing_share}
      .finish({states, scenes}, datasets);
  append_in_place(dataset::kIfStanding, from.if_standing, {states, scenes, extent(from.if_standing.rows())},
                  "what control points of the nominal bridge would show then if it stood, to first order; 0 "
                  "where the block is gone, and of all other scenes",
                  datasets);
}

void append_residual(const Sensitivities& from, std::vector<DatasetValue>& datasets) {
  Filling<double> bridge{
      dataset::kResidualBridge, ElementType::float64, "m",
      "what the first order leaves of the intact bridge: independent columns, the same in all states"};
  Filling<double> epoch{
      dataset::kResidualEpoch, ElementType::float64, "m",
      "what it leaves of an epoch's own parameters: independent columns, the same in all states"};
  Filling<double> share{
      dataset::kResidualShare, ElementType::float64, "1",
      "what it leaves of a signal: as a share of the signal's own standard deviation, and at all "
      "points alike as a share of that one's root mean square; then the same two of an epoch"};
  for (const FirstOrderResidual& state : from.residuals) {
    bridge.add(state.bridge);
    epoch.add(state.epoch);
    share.values.insert(share.values.end(),
                        {state.share, state.common, state.epoch_share, state.epoch_common});
  }
  const std::uint64_t states = from.residuals.size();
  const FirstOrderResidual& first = from.residuals.front();
  bridge.finish({states, extent(first.bridge.rows()), extent(first.bridge.cols())}, datasets);
  epoch.finish({states, extent(first.epoch.rows()), extent(first.epoch.cols())}, datasets);
  share.finish({states, 4}, datasets);
}

void append_unevenness(const Sensitivities& from, std::vector<DatasetValue>& datasets) {
  if (from.unevenness.empty()) return;
  Filling<double> unevenness{
      dataset::kUnevenness, ElementType::float64, "m",
      "what differs from part to part in an epoch (joints that soften, blocks that warm) changes of "
      "the intact bridge: independent columns, the same in all states"};
  for (const Eigen::MatrixXd& state : from.unevenness) unevenness.add(state);
  const Eigen::MatrixXd& first = from.unevenness.front();
  unevenness.finish({from.unevenness.size(), extent(first.rows()), extent(first.cols())}, datasets);
}

void append_load(const LoadInfluence& load, std::vector<DatasetValue>& datasets) {
  Filling<double>{dataset::kLoadPlace, ElementType::float64, "m", "places along the top, x", load.places}
      .finish({load.places.size()}, datasets);
  append_matrix(dataset::kLoadInfluence, "m2/N",
                "what a force down of 1 N for each metre of the bridge's width at each place adds "
                "to what the points of the intact bridge read",
                load.readings, datasets);
}

// Reading.

std::span<const double> finite_numbers(const Hdf5File& file, const char* path, const Shape& shape) {
  const StoredNumbers found(file, path, shape);
  found.require_finite(found.all());
  return found.all();
}

/// Matrices of so many rows, one for each of `leading`; how many columns they have the file says. Without the
/// dataset they have none.
StackedMatrices read_matrices(const Hdf5File& file, const char* path, const Shape& leading,
                              std::size_t rows) {
  const auto height = static_cast<Eigen::Index>(rows);
  if (!file.has(path)) return {StoredNumbers(), height, 0};
  const Shape found = file.view(path).shape;
  const std::uint64_t columns = found.empty() ? 0 : found.back();
  Shape expected = leading;
  expected.insert(expected.end(), {rows, columns});
  return {StoredNumbers(file, path, expected), height, static_cast<Eigen::Index>(columns)};
}

std::span<const std::uint8_t> read_flags(const Hdf5File& file, const char* path, const Shape& shape,
                                         std::uint8_t most = 1) {
  const ByteView bytes = file.array(path, ElementType::uint8, shape);
  const std::span flags(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  file.require(std::ranges::all_of(flags, [&](std::uint8_t flag) { return flag <= most; }),
               fmt::format("dataset '{}' holds a value above {}", path, most));
  return flags;
}

std::vector<UncertainParameter> read_parameters(const Hdf5File& file) {
  const auto names = read_names(file, dataset::kUncertainName, kParameterNameWidth);
  const auto units = read_names(file, dataset::kUncertainUnit, kUnitWidth);
  const auto sigma = finite_numbers(file, dataset::kUncertainSigma, {names.size()});
  const auto of_epoch = read_flags(file, dataset::kUncertainOfEpoch, {names.size()});
  file.require(units.size() == names.size(),
               fmt::format("dataset '{}' has {} rows where {} were expected", dataset::kUncertainUnit,
                           units.size(), names.size()));
  file.require(std::ranges::is_sorted(of_epoch),
               fmt::format("dataset '{}': expected those of the bridge first", dataset::kUncertainOfEpoch));
  file.require(std::ranges::all_of(sigma, [](double value) { return value > 0.0; }),
               fmt::format("dataset '{}': expected positive numbers", dataset::kUncertainSigma));
  std::vector<UncertainParameter> parameters;
  for (std::size_t i = 0; i < names.size(); ++i)
    parameters.push_back({names[i], units[i], sigma[i], of_epoch[i] != 0});
  return parameters;
}

std::vector<Scene> read_scenes(const Hdf5File& file, std::size_t blocks) {
  const DatasetView found = file.view(dataset::kSensitivityRemoved);
  const ByteView bytes = file.array(dataset::kSensitivityRemoved, ElementType::int32, found.shape);
  file.require(found.shape.size() == 2,
               fmt::format("dataset '{}' has not the expected type and shape", found.path));
  const std::span ids(reinterpret_cast<const std::int32_t*>(bytes.data()),
                      bytes.size() / sizeof(std::int32_t));
  const std::size_t width = found.shape[1];
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i % width == 0) scenes.emplace_back();
    Scene& scene = scenes.back();
    const bool is_padding = ids[i] == -1;
    const bool names_a_block = ids[i] >= 0 && static_cast<std::size_t>(ids[i]) < blocks &&
                               scene.removed.size() == i % width &&
                               (scene.removed.empty() || value(scene.removed.back()) < ids[i]);
    file.require(is_padding || names_a_block,
                 fmt::format("dataset '{}' holds a row that is no scene", found.path));
    if (!is_padding) scene.removed.push_back(BlockId{ids[i]});
  }
  const auto unordered = std::ranges::adjacent_find(
      scenes, [](const Scene& first, const Scene& second) { return !precedes(first, second); });
  file.require(
      scenes.front().removed.empty() && unordered == scenes.end(),
      fmt::format("dataset '{}': expected the intact bridge and then scenes in ascending order", found.path));
  return scenes;
}

void read_residuals(const Hdf5File& file, const SensitivitySizes& sizes, Sensitivities& into) {
  const StackedMatrices bridge = read_matrices(file, dataset::kResidualBridge, {sizes.states}, sizes.points);
  const StackedMatrices epoch = read_matrices(file, dataset::kResidualEpoch, {sizes.states}, sizes.points);
  const auto shares = finite_numbers(file, dataset::kResidualShare, {sizes.states, 4});
  for (std::size_t state = 0; state < sizes.states; ++state) {
    const auto own = shares.subspan(4 * state, 4);
    into.residuals.push_back({bridge[state], epoch[state], own[0], own[1], own[2], own[3]});
  }
}

void read_unevenness(const Hdf5File& file, const SensitivitySizes& sizes, Sensitivities& into) {
  if (!file.has(dataset::kUnevenness)) return;
  const StackedMatrices found = read_matrices(file, dataset::kUnevenness, {sizes.states}, sizes.points);
  for (std::size_t state = 0; state < sizes.states; ++state) into.unevenness.emplace_back(found[state]);
}

void read_load(const Hdf5File& file, const SensitivitySizes& sizes, Sensitivities& into) {
  const StackedMatrices found = read_matrices(file, dataset::kLoadInfluence, {}, sizes.points);
  if (found.columns() == 0) return;
  const auto count = static_cast<std::uint64_t>(found.columns());
  file.require(count <= kMostLoadPlaces, fmt::format("dataset '{}' has {} columns, at most {} were expected",
                                                     dataset::kLoadInfluence, count, kMostLoadPlaces));
  const auto places = finite_numbers(file, dataset::kLoadPlace, {count});
  file.require(std::ranges::adjacent_find(places, std::greater_equal{}) == places.end(),
               fmt::format("dataset '{}': expected places in ascending order", dataset::kLoadPlace));
  into.load = {{places.begin(), places.end()}, found[0]};
  file.require(into.load.readings.cwiseAbs().maxCoeff() < kMostInfluence,
               fmt::format("dataset '{}' holds a number that is not below {:g}", dataset::kLoadInfluence,
                           kMostInfluence));
}

void read_falls(const Hdf5File& file, const SensitivitySizes& sizes, Sensitivities& into) {
  const std::uint64_t scenes = into.scenes.size();
  file.require(file.has(dataset::kStandingShare) == file.has(dataset::kIfStanding),
               fmt::format("has one of the datasets '{}' and '{}', expected both or none",
                           dataset::kStandingShare, dataset::kIfStanding));
  if (file.has(dataset::kStandingShare)) {
    const auto shares = finite_numbers(file, dataset::kStandingShare, {sizes.states, scenes});
    into.standing_share.assign(shares.begin(), shares.end());
    into.if_standing = {StoredNumbers(file, dataset::kIfStanding, {sizes.states, scenes, sizes.points}),
                        static_cast<Eigen::Index>(sizes.points), 1};
  }
  for (std::size_t place = 0; place < into.known.size(); ++place) {
    const double share = into.standing_share.empty() ? 0.0 : into.standing_share[place];
    const bool is_fall = into.known[place] == FactorsKnown::of_uncertain_fall;
    if (is_fall ? share > 0.0 && share <= 1.0 && place % scenes != 0 : share == 0.0) continue;
    file.refuse(fmt::format("dataset '{}' says {} of a scene of which '{}' says {}", dataset::kStandingShare,
                            share, dataset::kSensitivityKnown, static_cast<int>(into.known[place])));
  }
}

void read_factors(const Hdf5File& file, const SensitivitySizes& sizes, Sensitivities& into) {
  const std::uint64_t scenes = into.scenes.size();
  const auto known = read_flags(file, dataset::kSensitivityKnown, {sizes.states, scenes},
                                static_cast<std::uint8_t>(FactorsKnown::of_uncertain_fall));
  for (const std::uint8_t flag : known) into.known.push_back(static_cast<FactorsKnown>(flag));
  into.bridge = read_matrices(file, dataset::kBridgeFactors, {sizes.states, scenes}, sizes.points);
  into.epoch = read_matrices(file, dataset::kEpochFactors, {sizes.states, scenes}, sizes.points);
  into.left = read_matrices(file, dataset::kSignalLeft, {sizes.states, scenes}, sizes.points);
  file.require(
      into.bridge.columns() == into.basis.cols() && into.epoch.columns() == into.of_epoch(),
      fmt::format("datasets '{}' and '{}' have not the columns of '{}' and '{}'", dataset::kBridgeFactors,
                  dataset::kEpochFactors, dataset::kSensitivityBasis, dataset::kUncertainName));
  into.signals = read_signals(file, sizes.states * scenes, sizes.points,
                              static_cast<std::size_t>(into.leading_columns()),
                              static_cast<std::size_t>(into.of_epoch()));
}

}  // namespace

std::vector<DatasetValue> sensitivity_datasets(const Sensitivities& sensitivities) {
  std::vector<DatasetValue> datasets;
  append_parameters(sensitivities, datasets);
  append_matrix(dataset::kSensitivityBasis, "1",
                "the bridge's standardised parameters along the columns: L V, V orthonormal directions of "
                "the independent parameters that L makes them of",
                sensitivities.basis, datasets);
  append_scenes(sensitivities, datasets);
  append_factors(sensitivities, datasets);
  append_falls(sensitivities, datasets);
  append_residual(sensitivities, datasets);
  append_unevenness(sensitivities, datasets);
  append_load(sensitivities.load, datasets);
  return datasets;
}

std::optional<Sensitivities> read_sensitivities(const Hdf5File& file, const SensitivitySizes& sizes) {
  if (!file.has(dataset::kUncertainName)) return std::nullopt;
  Sensitivities result;
  result.parameters = read_parameters(file);
  const auto of_bridge = std::ranges::count(result.parameters, false, &UncertainParameter::of_epoch);
  result.basis = read_matrices(file, dataset::kSensitivityBasis, {}, static_cast<std::size_t>(of_bridge))[0];
  result.scenes = read_scenes(file, sizes.blocks);
  read_factors(file, sizes, result);
  read_falls(file, sizes, result);
  read_residuals(file, sizes, result);
  read_unevenness(file, sizes, result);
  read_load(file, sizes, result);
  return result;
}

}  // namespace voussoir
