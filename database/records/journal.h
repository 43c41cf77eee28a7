#pragma once
/// @file The records of an unfinished build, safe as soon as each is computed.
///
/// A plain file next to the database that will be. It begins with the bytes "VOUSSOIR JOURNAL 4\n" and a
/// frame that holds the build's provenance; a frame with one record follows for every scene of a variant that
/// is done. A frame is the size of its content (uint32), the content's CRC-32 (uint32) and the content. The
/// file only ever grows, so whatever moment the program or the machine stops at, all frames but the last are
/// whole; the torn rest is cut off on opening.

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

#include "database/format/file_descriptor.h"
#include "database/records/provenance.h"
#include "database/records/record_source.h"

namespace voussoir {

/// What becomes of the records that an interrupted build of another key has left.
enum class OtherRecords { drop, refuse };

/// Thread-safe, once it is open, but for its end.
class Journal : public RecordSource {
 public:
  /// Opens the journal for building `target`, or begins one, and locks it against other builders. Records of
  /// an interrupted build are kept if it was a build of the same `key`; otherwise they are thrown away and
  /// `discarded` tells whose they were, or Failure is thrown. Throws Failure, too, if the file cannot be
  /// written or another program is building `target`.
  static Journal open(const std::filesystem::path& target, const Provenance& provenance,
                      const std::string& key, OtherRecords others = OtherRecords::drop);

  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;
  ~Journal() override = default;

  static std::filesystem::path path_for(const std::filesystem::path& target);
  const std::filesystem::path& path() const { return path_; }

  /// Provenance of the records of another build that were in the way.
  const std::optional<Provenance>& discarded() const { return discarded_; }

  /// Throws Failure (disk full); what was appended before stays whole.
  void append(const Record& record);

  std::size_t size() const;
  bool contains(const RecordKey& key) const override;

  /// Throws Failure if the file cannot be read back.
  Record read(const RecordKey& key) const override;

  /// Deletes the file: its records have found their place in a database.
  void remove();

 private:
  struct Place {
    std::uint64_t offset = 0;  ///< of the frame's content
    std::uint32_t size = 0;
  };

  Journal(std::filesystem::path path, FileDescriptor file);
  void load(const Provenance& provenance, const std::string& key, OtherRecords others);
  void begin(const Provenance& provenance, const std::string& key);
  void write_frame(ByteView content);
  /// `why` in the system's words, if it is the system that cannot.
  [[noreturn]] void fail(const std::string& what, const std::string& why) const;

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t end_ = 0;  ///< of the last whole frame
  std::map<RecordKey, Place> places_;
  std::optional<Provenance> discarded_;
  mutable std::mutex mutex_;  // of the places
};

/// The content of a record's frame and back; nothing if the bytes are no record.
Bytes serialise(const Record& record);
std::optional<Record> parse_record(ByteView bytes);

}  // namespace voussoir
