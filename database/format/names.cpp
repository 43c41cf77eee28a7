#include "database/format/names.h"

#include <algorithm>

namespace voussoir {

DatasetValue name_dataset(const char* path, const std::vector<std::string>& names, std::size_t width,
                          const char* meaning) {
  DatasetValue dataset{path, ElementType::text, {names.size()}, width, "text", meaning, {}};
  for (std::string name : names) {
    if (name.size() > width)
      throw Failure(fmt::format("'{}' is too long a name for {} ({} bytes)", name, path, width));
    name.resize(width);
    const ByteView bytes = view_bytes(name);
    dataset.bytes.insert(dataset.bytes.end(), bytes.begin(), bytes.end());
  }
  return dataset;
}

std::vector<std::string> read_names(const Hdf5File& file, const char* path, std::size_t width) {
  const DatasetView found = file.view(path);
  file.require(found.type == ElementType::text && found.shape.size() == 1 && found.text_width == width,
               fmt::format("dataset '{}' has not the expected type and shape", path));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < found.shape[0]; ++i) {
    const auto* name = reinterpret_cast<const char*>(found.bytes.data()) + i * width;
    names.emplace_back(name, std::find(name, name + width, '\0'));
  }
  return names;
}

}  // namespace voussoir
