#include "database/records/shard.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::string_view kYes = "yes";
constexpr std::string_view kNo = "no";

std::string_view word(bool value) {
  return value ? kYes : kNo;
}

/// Options may be given with line ends in them, which mean what blanks do.
std::string in_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char sign) { return sign == '\n' || sign == '\r'; }, ' ');
  return text;
}

}  // namespace

std::string to_string(const Shard& shard) {
  return fmt::format("{}/{}", shard.number, shard.count);
}

std::optional<Shard> parse_shard(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, '/');
  if (parts.size() != 2) return std::nullopt;
  const auto number = parse_whole_number(parts[0]);
  const auto count = parse_whole_number(parts[1]);
  if (!number || !count || *number < 1 || *number > *count) return std::nullopt;
  return Shard{*number, *count};
}

std::string to_text(const ShardStatement& statement) {
  return fmt::format(
      "shard = {}\nscenes = {}\nscenes_of_variants = {}\nhistories = {}\nloads = {}\nkeeps_fields = {}\n"
      "known_bridge = {}\n",
      to_string(statement.shard), in_one_line(statement.scenes), in_one_line(statement.scenes_of_variants),
      in_one_line(statement.histories), in_one_line(statement.loads), word(statement.keeps_fields),
      word(statement.known_bridge));
}

std::optional<ShardStatement> parse_shard_statement(std::string_view text) {
  std::map<std::string_view, std::string_view> values;
  for (const std::string_view line : split(text, '\n')) {
    const std::size_t sign = line.find('=');
    if (sign != std::string_view::npos)
      values[trimmed(line.substr(0, sign))] = trimmed(line.substr(sign + 1));
  }
  const auto shard = parse_shard(values["shard"]);
  const auto is_word = [&](const char* key) { return values[key] == kYes || values[key] == kNo; };
  if (!shard || !is_word("keeps_fields") || !is_word("known_bridge")) return std::nullopt;
  const auto text_of = [&](const char* key) { return std::string(values[key]); };
  return ShardStatement{*shard,
                        text_of("scenes"),
                        text_of("scenes_of_variants"),
                        text_of("histories"),
                        text_of("loads"),
                        values["keeps_fields"] == kYes,
                        values["known_bridge"] == kYes};
}

}  // namespace voussoir
