#include "database/records/variant_parameters.h"

#include <algorithm>
#include <array>

#include "database/records/schema.h"

namespace voussoir {
namespace {

struct ParameterColumn {
  const char* path;
  std::vector<double> VariantParameters::*values;
  bool of_joints;
  const char* units;
  const char* meaning;
};

constexpr std::array kColumns = {
    ParameterColumn{dataset::kYoungModulus, &VariantParameters::young_modulus, false, "Pa",
                    "Young's modulus of each block"},
    ParameterColumn{dataset::kPoissonRatio, &VariantParameters::poisson_ratio, false, "1",
                    "Poisson's ratio of each block"},
    ParameterColumn{dataset::kDensity, &VariantParameters::density, false, "kg/m3", "density of each block"},
    ParameterColumn{dataset::kNormalStiffness, &VariantParameters::normal_stiffness, true, "Pa/m",
                    "normal stiffness p_n of each joint"},
    ParameterColumn{dataset::kTangentialStiffness, &VariantParameters::tangential_stiffness, true, "Pa/m",
                    "tangential stiffness p_t of each joint"},
    ParameterColumn{dataset::kFriction, &VariantParameters::friction_coefficient, true, "1",
                    "tangent of the friction angle of each joint"}};

}  // namespace

std::optional<std::int32_t> find_variant(const std::vector<VariantParameters>& variants,
                                         const VariantParameters& parameters) {
  const auto found = std::ranges::find(variants, parameters);
  if (found == variants.end()) return std::nullopt;
  return static_cast<std::int32_t>(found - variants.begin());
}

VariantParameters variant_parameters(const Parameters& parameters) {
  VariantParameters result;
  for (const Material& block : parameters.blocks) {
    result.young_modulus.push_back(block.young_modulus);
    result.poisson_ratio.push_back(block.poisson_ratio);
    result.density.push_back(block.density);
  }
  for (const JointMaterial& joint : parameters.joints) {
    result.normal_stiffness.push_back(joint.normal_stiffness);
    result.tangential_stiffness.push_back(joint.tangential_stiffness);
    result.friction_coefficient.push_back(joint.friction_coefficient());
  }
  return result;
}

std::vector<DatasetValue> parameter_datasets(const std::vector<VariantParameters>& variants) {
  std::vector<DatasetValue> datasets;
  for (const ParameterColumn& column : kColumns) {
    std::vector<double> values;
    for (const VariantParameters& variant : variants)
      values.insert(values.end(), (variant.*column.values).begin(), (variant.*column.values).end());
    if (!values.empty())
      datasets.push_back(dataset_of(column.path, ElementType::float64, values,
                                    values.size() / variants.size(), column.units, column.meaning));
  }
  return datasets;
}

std::size_t read_variant_count(const Hdf5File& file) {
  const DatasetView view = file.view(kColumns.front().path);
  file.require(view.shape.size() == 2,
               fmt::format("dataset '{}' has not the expected type and shape", view.path));
  return view.shape[0];
}

std::vector<VariantParameters> read_parameters(const Hdf5File& file, std::size_t blocks, std::size_t joints) {
  const std::size_t count = read_variant_count(file);
  std::vector<VariantParameters> variants(count);
  for (const ParameterColumn& column : kColumns) {
    const std::size_t width = column.of_joints ? joints : blocks;
    if (width == 0) continue;
    const ByteView bytes = file.array(column.path, ElementType::float64, {count, width});
    const auto* values = reinterpret_cast<const double*>(bytes.data());
    for (std::size_t i = 0; i < count; ++i)
      (variants[i].*column.values).assign(values + i * width, values + (i + 1) * width);
  }
  return variants;
}

}  // namespace voussoir
