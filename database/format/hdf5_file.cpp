#include "database/format/hdf5_file.h"

#include <algorithm>
#include <array>

namespace voussoir {
namespace {

constexpr std::size_t kLongestAttribute = 4096;  ///< bytes; those written are far shorter
constexpr std::array<unsigned char, 8> kSignature = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};

bool has_signature(ByteView bytes) {
  return bytes.size() > kSignature.size() &&
         std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) == 0;
}

/// True for the superblock versions whose metadata is protected by checksums throughout.
bool is_checksummed_hdf5(ByteView bytes) {
  if (!has_signature(bytes)) return false;
  const int version = std::to_integer<int>(bytes[kSignature.size()]);
  return version == 2 || version == 3;
}

/// Elements times width in bytes; nothing if that is more than `most`.
std::optional<std::uint64_t> size_within(const std::vector<std::uint64_t>& shape, std::uint64_t width,
                                         std::uint64_t most) {
  std::uint64_t size = width;
  for (const std::uint64_t extent : shape) {
    if (extent != 0 && size > most / extent) return std::nullopt;
    size *= extent;
  }
  return size <= most ? std::optional(size) : std::nullopt;
}

/// True if the only filters are shuffle and then deflate and a chunk is one row of one state.
bool is_row_chunked(const hdf5_format::ObjectHeader& header, const hdf5_format::Shape& shape) {
  return shape.size() == 4 && header.chunked &&
         header.chunked->chunk == hdf5_format::Shape{1, 1, shape[2], shape[3], sizeof(double)} &&
         header.filters == std::vector{hdf5_format::kShuffle, hdf5_format::kDeflate} && !header.external;
}

std::string without_padding(const char* text, std::size_t width) {
  return {text, static_cast<std::size_t>(std::find(text, text + width, '\0') - text)};
}

}  // namespace

bool begins_like_hdf5(const std::filesystem::path& path) {
  return has_signature(MappedFile(path).bytes());
}

Hdf5File::Hdf5File(const std::filesystem::path& path) : path_(path), mapped_(path) {
  if (!is_checksummed_hdf5(mapped_.bytes()))
    refuse("this is no database (expected an HDF5 file written by build-database)");
  root_ = header_at(root(), "the root group");
}

std::uint64_t Hdf5File::root() const {
  try {
    return hdf5_format::root_address(mapped_.bytes());
  } catch (const InputError& error) {
    refuse(fmt::format("damaged or incomplete HDF5 file: {}", error.what()));
  }
}

void Hdf5File::refuse(const std::string& why) const {
  throw InputError(fmt::format("{}: {}", path_.string(), why));
}

const hdf5_format::StoredAttribute& Hdf5File::attribute(const char* name) const {
  const auto found = root_.attributes.find(name);
  require(found != root_.attributes.end(), fmt::format("attribute '{}' is missing", name));
  return found->second;
}

std::string Hdf5File::text_attribute(const char* name) const {
  const hdf5_format::StoredAttribute& found = attribute(name);
  const bool is_text = found.type.type == ElementType::text && found.shape && found.shape->empty() &&
                       found.type.width == found.value.size() && found.value.size() <= kLongestAttribute;
  require(is_text, fmt::format("attribute '{}' is no text of at most {} bytes", name, kLongestAttribute));
  return without_padding(reinterpret_cast<const char*>(found.value.data()), found.value.size());
}

int Hdf5File::int_attribute(const char* name) const {
  const hdf5_format::StoredAttribute& found = attribute(name);
  std::int32_t number = 0;
  require(found.type.type == ElementType::int32 && found.shape && found.shape->empty() &&
              found.value.size() == sizeof number,
          fmt::format("attribute '{}' is no whole number", name));
  std::memcpy(&number, found.value.data(), sizeof number);
  return number;
}

hdf5_format::ObjectHeader Hdf5File::header_at(std::uint64_t address, const std::string& what) const {
  try {
    return hdf5_format::read_object_header(mapped_.bytes(), address);
  } catch (const InputError& error) {
    refuse(fmt::format("damaged or incomplete HDF5 file: {} cannot be opened: {}", what, error.what()));
  }
}

std::optional<std::uint64_t> Hdf5File::find(const char* dataset_path) const {
  const std::string_view whole(dataset_path);
  const auto group = root_.links.find(whole.substr(0, whole.find('/')));
  if (group == root_.links.end()) return std::nullopt;
  const hdf5_format::ObjectHeader header = header_at(group->second, "the group of " + std::string(whole));
  const auto dataset = header.links.find(whole.substr(whole.find('/') + 1));
  return dataset == header.links.end() ? std::nullopt : std::optional(dataset->second);
}

hdf5_format::ObjectHeader Hdf5File::dataset_header(const char* dataset_path) const {
  const auto address = find(dataset_path);
  require(address.has_value(), fmt::format("dataset '{}' is missing", dataset_path));
  return header_at(*address, fmt::format("dataset '{}'", dataset_path));
}

bool Hdf5File::has(const char* dataset_path) const {
  return find(dataset_path).has_value();
}

DatasetView Hdf5File::view(const char* dataset_path) const {
  const hdf5_format::ObjectHeader header = dataset_header(dataset_path);
  require(header.shape && header.type && header.type->type && header.contiguous && header.filters.empty() &&
              !header.external,
          fmt::format("dataset '{}' has not the expected type and layout", dataset_path));
  const std::uint32_t width = header.type->width;
  const auto size = size_within(*header.shape, width, mapped_.bytes().size());
  const std::uint64_t offset = header.contiguous->offset;
  require(size && *size > 0 && *size == header.contiguous->size && offset <= mapped_.bytes().size() - *size,
          fmt::format("dataset '{}' is empty or does not lie within the file", dataset_path));
  const ElementType type = *header.type->type;
  return {dataset_path, type, *header.shape, type == ElementType::text ? width : 0,
          mapped_.bytes().subspan(offset, *size)};
}

void Hdf5File::check_numbers(const DatasetView& found, bool expected) const {
  require(expected, fmt::format("dataset '{}' has not the expected type and shape", found.path));
  const auto address = reinterpret_cast<std::uintptr_t>(found.bytes.data());
  require(address % alignof(double) == 0, fmt::format("dataset '{}' is not aligned to 8 bytes", found.path));
}

ByteView Hdf5File::array(const char* dataset_path, ElementType type,
                         const std::vector<std::uint64_t>& shape) const {
  const DatasetView found = view(dataset_path);
  check_numbers(found, found.type == type && found.shape == shape);
  return found.bytes;
}

std::string Hdf5File::text(const char* dataset_path) const {
  const DatasetView found = view(dataset_path);
  require(found.type == ElementType::text && found.shape.empty(),
          fmt::format("dataset '{}' is no text", dataset_path));
  return without_padding(reinterpret_cast<const char*>(found.bytes.data()), found.bytes.size());
}

ChunkedDataset Hdf5File::open_chunked(const char* dataset_path,
                                      const std::vector<std::uint64_t>& shape) const {
  const hdf5_format::ObjectHeader header = dataset_header(dataset_path);
  const bool expected = header.type && header.type->type == ElementType::float64 && header.shape == shape &&
                        is_row_chunked(header, shape);
  require(expected, fmt::format("dataset '{}' has not the expected type, shape and chunks", dataset_path));
  ChunkedDataset dataset;
  try {
    const std::uint64_t count = shape[0] * shape[1];
    for (const auto& [offset, size] : hdf5_format::read_chunk_places(mapped_.bytes(), *header.chunked, count))
      dataset.chunks.push_back(mapped_.bytes().subspan(offset, size));
  } catch (const InputError& error) {
    refuse(fmt::format("dataset '{}' cannot be opened: {}", dataset_path, error.what()));
  }
  return dataset;
}

}  // namespace voussoir
