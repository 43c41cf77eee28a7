#include "database/hdf5_file.h"

#include <algorithm>
#include <array>

#include "database/database.h"

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

Hdf5Handle open_file(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_sec2(access.get());
  H5Pset_file_locking(access.get(), false, true);  // files are replaced as a whole, never changed
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

std::optional<ElementType> number_type(hid_t type) {
  if (H5Tequal(type, H5T_IEEE_F64LE) > 0) return ElementType::float64;
  if (H5Tequal(type, H5T_STD_I32LE) > 0) return ElementType::int32;
  if (H5Tequal(type, H5T_STD_U8LE) > 0) return ElementType::uint8;
  if (H5Tequal(type, H5T_STD_U32LE) > 0) return ElementType::uint32;
  return std::nullopt;
}

bool is_fixed_text(hid_t type) {
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
}

/// Extents of a simple dataspace (none for a scalar); nothing for other kinds and ranks above 3.
std::optional<std::vector<std::uint64_t>> shape_of(hid_t space) {
  constexpr int kHighestRank = 3;
  if (H5Sget_simple_extent_type(space) == H5S_SCALAR) return std::vector<std::uint64_t>{};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (H5Sget_simple_extent_type(space) != H5S_SIMPLE || rank < 1 || rank > kHighestRank) return std::nullopt;
  std::array<hsize_t, kHighestRank> extent{};
  if (H5Sget_simple_extent_dims(space, extent.data(), nullptr) != rank) return std::nullopt;
  return std::vector<std::uint64_t>(extent.begin(), extent.begin() + rank);
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

/// True if the dataset's bytes lie in one piece in this very file.
bool is_contiguous(hid_t dataset) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_layout(properties.get()) == H5D_CONTIGUOUS && H5Pget_external_count(properties.get()) == 0;
}

/// True if the only filters are shuffle and then deflate and a chunk is one row.
bool is_row_chunked(hid_t dataset, std::uint64_t nodes) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset), H5Pclose);
  std::array<hsize_t, 3> chunk{};
  if (H5Pget_layout(properties.get()) != H5D_CHUNKED || H5Pget_chunk(properties.get(), 3, chunk.data()) != 3)
    return false;
  const auto filter = [&](unsigned position) {
    unsigned flags = 0;
    std::size_t values = 0;
    return H5Pget_filter2(properties.get(), position, &flags, &values, nullptr, 0, nullptr, nullptr);
  };
  return chunk == std::array<hsize_t, 3>{1, nodes, 2} && H5Pget_nfilters(properties.get()) == 2 &&
         filter(0) == H5Z_FILTER_SHUFFLE && filter(1) == H5Z_FILTER_DEFLATE;
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
  const auto lock = lock_hdf5();
  file_ = open_file(path);
  if (!file_) refuse(fmt::format("damaged or incomplete HDF5 file ({})", last_hdf5_error()));
}

Hdf5File::~Hdf5File() {
  const auto lock = lock_hdf5();
  file_.close();
}

ChunkedDataset::~ChunkedDataset() {
  const auto lock = lock_hdf5();
  handle.close();
}

void Hdf5File::refuse(const std::string& why) const {
  throw InputError(fmt::format("{}: {}", path_.string(), why));
}

std::string Hdf5File::text_attribute(const char* name) const {
  const auto lock = lock_hdf5();
  const Hdf5Handle found(H5Aopen(file_.get(), name, H5P_DEFAULT), H5Aclose);
  require(static_cast<bool>(found), fmt::format("attribute '{}' is missing", name));
  const Hdf5Handle type(H5Aget_type(found.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(found.get()), H5Sclose);
  const bool scalar = H5Sget_simple_extent_type(space.get()) == H5S_SCALAR;
  const std::size_t width = H5Tget_size(type.get());
  require(is_fixed_text(type.get()) && scalar && width <= kLongestAttribute,
          fmt::format("attribute '{}' is no text of at most {} bytes", name, kLongestAttribute));
  std::string text(width, '\0');
  require(H5Aread(found.get(), type.get(), text.data()) >= 0,
          fmt::format("attribute '{}' cannot be read", name));
  return without_padding(text.data(), width);
}

int Hdf5File::int_attribute(const char* name) const {
  const auto lock = lock_hdf5();
  const Hdf5Handle found(H5Aopen(file_.get(), name, H5P_DEFAULT), H5Aclose);
  require(static_cast<bool>(found), fmt::format("attribute '{}' is missing", name));
  const Hdf5Handle type(H5Aget_type(found.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(found.get()), H5Sclose);
  std::int32_t number = 0;
  require(number_type(type.get()) == ElementType::int32 &&
              H5Sget_simple_extent_type(space.get()) == H5S_SCALAR &&
              H5Aread(found.get(), H5T_STD_I32LE, &number) >= 0,
          fmt::format("attribute '{}' is no whole number", name));
  return number;
}

bool Hdf5File::has_hard_link(const std::string& link_path) const {
  H5L_info_t info{};
  return H5Lexists(file_.get(), link_path.c_str(), H5P_DEFAULT) > 0 &&
         H5Lget_info(file_.get(), link_path.c_str(), &info, H5P_DEFAULT) >= 0 && info.type == H5L_TYPE_HARD;
}

/// Follows hard links only: the file may not send the reader to other files or round in circles.
Hdf5Handle Hdf5File::open_dataset(const char* dataset_path) const {
  const std::string whole(dataset_path);
  const bool present = has_hard_link(whole.substr(0, whole.find('/'))) && has_hard_link(whole);
  require(present, fmt::format("dataset '{}' is missing", dataset_path));
  Hdf5Handle opened(H5Dopen2(file_.get(), dataset_path, H5P_DEFAULT), H5Dclose);
  require(static_cast<bool>(opened),
          fmt::format("dataset '{}' cannot be opened ({})", dataset_path, last_hdf5_error()));
  return opened;
}

bool Hdf5File::has(const char* dataset_path) const {
  const auto lock = lock_hdf5();
  const std::string whole(dataset_path);
  return has_hard_link(whole.substr(0, whole.find('/'))) && has_hard_link(whole);
}

DatasetView Hdf5File::view(const char* dataset_path) const {
  const auto lock = lock_hdf5();
  const Hdf5Handle opened = open_dataset(dataset_path);
  const Hdf5Handle type(H5Dget_type(opened.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(opened.get()), H5Sclose);
  const auto shape = shape_of(space.get());
  const auto numbers = number_type(type.get());
  require(shape.has_value() && (numbers || is_fixed_text(type.get())) && is_contiguous(opened.get()),
          fmt::format("dataset '{}' has not the expected type and layout", dataset_path));
  const std::size_t width = H5Tget_size(type.get());
  const auto size = size_within(*shape, width, mapped_.bytes().size());
  const haddr_t offset = H5Dget_offset(opened.get());
  require(size && *size > 0 && offset != HADDR_UNDEF && offset <= mapped_.bytes().size() - *size,
          fmt::format("dataset '{}' is empty or does not lie within the file", dataset_path));
  return {dataset_path, numbers.value_or(ElementType::text), *shape, numbers ? 0 : width,
          mapped_.bytes().subspan(offset, *size)};
}

void Hdf5File::check_numbers(const DatasetView& found, ElementType type, std::uint64_t columns) const {
  const bool fits =
      columns == kFlat ? found.shape.size() == 1 : found.shape.size() == 2 && found.shape[1] == columns;
  require(found.type == type && fits,
          fmt::format("dataset '{}' has not the expected type and shape", found.path));
  const auto address = reinterpret_cast<std::uintptr_t>(found.bytes.data());
  require(address % alignof(double) == 0, fmt::format("dataset '{}' is not aligned to 8 bytes", found.path));
}

std::string Hdf5File::text(const char* dataset_path) const {
  const DatasetView found = view(dataset_path);
  require(found.type == ElementType::text && found.shape.empty(),
          fmt::format("dataset '{}' is no text", dataset_path));
  return without_padding(reinterpret_cast<const char*>(found.bytes.data()), found.bytes.size());
}

ChunkedDataset Hdf5File::open_chunked(const char* dataset_path, std::uint64_t rows,
                                      std::uint64_t nodes) const {
  const auto lock = lock_hdf5();
  ChunkedDataset dataset(open_dataset(dataset_path));
  const Hdf5Handle type(H5Dget_type(dataset.handle.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.handle.get()), H5Sclose);
  const bool expected = number_type(type.get()) == ElementType::float64 &&
                        shape_of(space.get()) == std::vector<std::uint64_t>{rows, nodes, 2} &&
                        is_row_chunked(dataset.handle.get(), nodes);
  require(expected, fmt::format("dataset '{}' has not the expected type, shape and chunks", dataset_path));
  return dataset;
}

Bytes Hdf5File::chunk(const ChunkedDataset& dataset, std::uint64_t row, std::size_t most_bytes) const {
  const auto lock = lock_hdf5();
  const std::array<hsize_t, 3> offset = {row, 0, 0};
  hsize_t size = 0;
  const bool sized = H5Dget_chunk_storage_size(dataset.handle.get(), offset.data(), &size) >= 0;
  require(sized && size > 0 && size <= most_bytes,
          fmt::format("the field of row {} is missing or too large", row));
  Bytes bytes(size);
  std::uint32_t skipped_filters = 0;
  const bool read =
      H5Dread_chunk(dataset.handle.get(), H5P_DEFAULT, offset.data(), &skipped_filters, bytes.data()) >= 0;
  require(read && skipped_filters == 0, fmt::format("the field of row {} cannot be read", row));
  return bytes;
}

}  // namespace voussoir
