#pragma once
/// @file Parts of a database that several machines compute, and what each states of itself.

#include <optional>
#include <string>
#include <string_view>

namespace voussoir {

/// One of so many parts, numbered from 1. Every part has the intact bridge; all other scenes are in just one.
struct Shard {
  int number = 1;
  int count = 1;
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// "3/16"
std::string to_string(const Shard& shard);

/// Nothing for text that is no such part.
std::optional<Shard> parse_shard(std::string_view text);

/// What a shard's file states beside its own records: which part it is, and what the whole is to hold, in the
/// words of build-database's options.
struct ShardStatement {
  Shard shard;
  std::string scenes, scenes_of_variants, histories, loads;
  bool keeps_fields = true;
  bool known_bridge = false;
  friend bool operator==(const ShardStatement&, const ShardStatement&) = default;
};

/// "key = value" lines, and back; nothing if the text is no such statement.
std::string to_text(const ShardStatement& statement);
std::optional<ShardStatement> parse_shard_statement(std::string_view text);

}  // namespace voussoir
