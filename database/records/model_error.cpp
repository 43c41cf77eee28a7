#include "database/records/model_error.h"

#include <algorithm>
#include <cmath>

#include "database/records/schema.h"

namespace voussoir {
namespace {

std::span<const double> read_sizes(const Hdf5File& file, const char* path, std::vector<std::uint64_t> shape) {
  const ByteView bytes = file.array(path, ElementType::float64, shape);
  const std::span values(reinterpret_cast<const double*>(bytes.data()), bytes.size() / sizeof(double));
  file.require(std::ranges::all_of(values, [](double value) { return std::isfinite(value) && value >= 0.0; }),
               fmt::format("dataset '{}' holds a number that is negative or not finite", path));
  return values;
}

}  // namespace

std::vector<DatasetValue> model_error_datasets(std::vector<ModelError> errors, std::size_t states,
                                               std::size_t points) {
  errors.resize(states);
  std::vector<double> share;
  std::vector<double> common;
  std::vector<double> intact;
  for (const ModelError& error : errors) {
    share.push_back(error.share);
    common.push_back(error.common);
    intact.insert(intact.end(), error.intact.begin(), error.intact.end());
    intact.resize(share.size() * points, 0.0);
  }
  return {dataset_of(dataset::kErrorShare, ElementType::float64, share, kFlat, "1",
                     "error of a signal (standard deviation) as a share of it, in each state"),
          dataset_of(dataset::kErrorCommon, ElementType::float64, common, kFlat, "1",
                     "and, at all points alike, as a share of its root mean square"),
          dataset_of(dataset::kErrorIntact, ElementType::float64, intact, points, "m",
                     "error of the intact bridge's displacement at each control point, in each state")};
}

std::vector<ModelError> read_model_errors(const Hdf5File& file, std::size_t states, std::size_t points) {
  const auto share = read_sizes(file, dataset::kErrorShare, {states});
  const auto common = read_sizes(file, dataset::kErrorCommon, {states});
  const auto intact = read_sizes(file, dataset::kErrorIntact, {states, points});
  std::vector<ModelError> errors;
  for (std::size_t state = 0; state < states; ++state) {
    const auto row = intact.subspan(state * points, points);
    errors.push_back({share[state], common[state], {row.begin(), row.end()}});
  }
  return errors;
}

}  // namespace voussoir
