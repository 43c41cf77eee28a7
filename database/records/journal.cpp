#include "database/records/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "database/format/field_codec.h"
#include "database/format/mapped_file.h"
#include "database/records/columns.h"

namespace voussoir {
namespace {

constexpr std::string_view kMagic = "VOUSSOIR JOURNAL 4\n";
constexpr std::string_view kMagicOfAll = kMagic.substr(0, sizeof("VOUSSOIR JOURNAL") - 1);  // of any version
constexpr std::size_t kFrameHead = 2 * sizeof(std::uint32_t);

/// A whole frame's content at the front of the reader, or nothing.
std::optional<ByteView> next_frame(ByteReader& reader) {
  const auto size = reader.get<std::uint32_t>();
  const auto crc = reader.get<std::uint32_t>();
  if (!size || !crc) return std::nullopt;
  const auto content = reader.get_bytes(*size);
  return content && crc32_of(*content) == *crc ? content : std::nullopt;
}

Bytes header_content(const Provenance& provenance, const std::string& key) {
  const std::string text = key + "\n" + to_text(provenance);
  const ByteView bytes = view_bytes(text);
  return {bytes.begin(), bytes.end()};
}

/// Splits what header_content has put together.
struct Header {
  std::string key;
  Provenance provenance;
};

std::optional<Header> parse_header(ByteView content) {
  const std::string text(reinterpret_cast<const char*>(content.data()), content.size());
  const auto line_end = text.find('\n');
  if (line_end == std::string::npos) return std::nullopt;
  const auto provenance = parse_provenance(text.substr(line_end + 1));
  return provenance ? std::optional(Header{text.substr(0, line_end), *provenance}) : std::nullopt;
}

/// True if the open file still is the one of this name: another builder may just have finished and deleted
/// it.
bool is_current(const FileDescriptor& file, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file.get(), &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

FileDescriptor open_locked(const std::filesystem::path& path) {
  for (;;) {
    FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    if (!file)
      throw Failure(fmt::format("{}: cannot be written: {} (building needs a folder that can be written to)",
                                path.string(), std::strerror(errno)));
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
      throw Failure(errno == EWOULDBLOCK
                        ? fmt::format("{}: another build-database is working on this database; wait for it "
                                      "or give another file with -o",
                                      path.string())
                        : fmt::format("{}: cannot be locked against another build-database: {} (give a "
                                      "file in a folder of this machine with -o)",
                                      path.string(), std::strerror(errno)));
    if (is_current(file, path)) return file;
  }
}

}  // namespace

std::filesystem::path Journal::path_for(const std::filesystem::path& target) {
  return target.string() + ".partial";
}

Journal::Journal(std::filesystem::path path, FileDescriptor file)
    : path_(std::move(path)), file_(std::move(file)) {}

Journal::Journal(Journal&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::move(other.file_)),
      end_(other.end_),
      places_(std::move(other.places_)),
      discarded_(std::move(other.discarded_)) {}

Journal Journal::open(const std::filesystem::path& target, const Provenance& provenance,
                      const std::string& key, OtherRecords others) {
  const std::filesystem::path path = path_for(target);
  Journal journal(path, open_locked(path));
  journal.load(provenance, key, others);
  return journal;
}

/// Takes in the whole frames of the same build and cuts off what follows them.
void Journal::load(const Provenance& provenance, const std::string& key, OtherRecords others) {
  const MappedFile mapped(path_);
  ByteReader reader(mapped.bytes());
  const auto magic = reader.get_bytes(kMagic.size());
  const bool known = magic && std::memcmp(magic->data(), kMagic.data(), kMagic.size()) == 0;
  const auto header_frame = known ? next_frame(reader) : std::nullopt;
  const auto header = header_frame ? parse_header(*header_frame) : std::nullopt;
  const ByteView beginning = mapped.bytes().first(std::min(kMagicOfAll.size(), mapped.bytes().size()));
  if (!std::ranges::equal(beginning, view_bytes(kMagicOfAll.substr(0, beginning.size()))))
    throw Failure(
        fmt::format("{}: is there and holds no scenes of a build, which go there: move it away or "
                    "give another file with -o",
                    path_.string()));
  if (!header || header->key != key) {
    if (others == OtherRecords::refuse && next_frame(reader))
      throw Failure(fmt::format(
          "{}: holds scenes of an interrupted build-database: run that one again, delete the file "
          "or give another file with -o",
          path_.string()));
    if (header) discarded_ = header->provenance;
    begin(provenance, key);
    return;
  }
  end_ = mapped.bytes().size() - reader.left();
  while (const auto content = next_frame(reader)) {
    const auto record = parse_record(*content);
    if (!record) break;
    places_[record->key] = {end_ + kFrameHead, static_cast<std::uint32_t>(content->size())};
    end_ = mapped.bytes().size() - reader.left();
  }
  if (::ftruncate(file_.get(), static_cast<off_t>(end_)) != 0)
    fail("cannot be shortened", std::strerror(errno));
}

void Journal::begin(const Provenance& provenance, const std::string& key) {
  if (::ftruncate(file_.get(), 0) != 0) fail("cannot be emptied", std::strerror(errno));
  if (::pwrite(file_.get(), kMagic.data(), kMagic.size(), 0) != static_cast<ssize_t>(kMagic.size()))
    fail("cannot be written", std::strerror(errno));
  end_ = kMagic.size();
  write_frame(header_content(provenance, key));
}

void Journal::write_frame(ByteView content) {
  ByteWriter frame;
  frame.put(static_cast<std::uint32_t>(content.size()));
  frame.put(crc32_of(content));
  frame.put_bytes(content);
  ByteView rest = frame.bytes();
  std::uint64_t at = end_;
  while (!rest.empty()) {
    const ssize_t written = ::pwrite(file_.get(), rest.data(), rest.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("cannot be written", std::strerror(errno));
    at += static_cast<std::uint64_t>(written);
    rest = rest.subspan(static_cast<std::size_t>(written));
  }
  end_ = at;
}

void Journal::append(const Record& record) {
  const Bytes content = serialise(record);
  const std::scoped_lock lock(mutex_);
  const Place place{end_ + kFrameHead, static_cast<std::uint32_t>(content.size())};
  write_frame(content);
  places_[record.key] = place;
}

std::size_t Journal::size() const {
  const std::scoped_lock lock(mutex_);
  return places_.size();
}

bool Journal::contains(const RecordKey& key) const {
  const std::scoped_lock lock(mutex_);
  return places_.contains(key);
}

Record Journal::read(const RecordKey& key) const {
  const std::scoped_lock lock(mutex_);
  const Place place = places_.at(key);
  Bytes content(place.size);
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t size = ::pread(file_.get(), content.data() + done, content.size() - done,
                                 static_cast<off_t>(place.offset + done));
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) fail("cannot be read back", std::strerror(errno));
    if (size == 0) fail("cannot be read back", "it has become shorter");
    done += static_cast<std::size_t>(size);
  }
  auto record = parse_record(content);
  if (!record || record->key != key) fail("cannot be read back", "it has been changed");
  return std::move(*record);
}

void Journal::remove() {
  if (::unlink(path_.c_str()) != 0) fail("cannot be deleted", std::strerror(errno));
}

void Journal::fail(const std::string& what, const std::string& why) const {
  throw Failure(
      fmt::format("{}: {}: {}; the {} scenes done so far are kept in it: put things right and run the same "
                  "command again to go on",
                  path_.string(), what, why, places_.size()));
}

Bytes serialise(const Record& record) {
  ByteWriter out;
  out.put(static_cast<std::uint32_t>(record.states.size()));
  for_each_column(record.states.size(), [&](const Column& column, std::size_t state) {
    const ByteView values = column.values(record, state);
    out.put(static_cast<std::uint32_t>(values.size() / column.value_width));
    out.put_bytes(values);
  });
  return out.bytes();
}

std::optional<Record> parse_record(ByteView bytes) {
  ByteReader reader(bytes);
  const auto states = reader.get<std::uint32_t>();
  if (!states || *states > reader.left()) return std::nullopt;
  Record record;
  record.states.resize(*states);
  bool whole = true;
  for_each_column(record.states.size(), [&](const Column& column, std::size_t state) {
    const auto count = whole ? reader.get<std::uint32_t>() : std::nullopt;
    const auto values = count ? reader.get_bytes(*count * column.value_width) : std::nullopt;
    whole = values && column.set_values(record, state, *values);
  });
  return whole && reader.left() == 0 ? std::optional(std::move(record)) : std::nullopt;
}

}  // namespace voussoir
