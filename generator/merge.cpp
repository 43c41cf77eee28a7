#include "generator/merge.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "generator/records/build_settings.h"

namespace voussoir {
namespace {

[[noreturn]] void refuse(const Database& part, const std::string& why) {
  throw InputError(fmt::format("{}: {}", part.path().string(), why));
}

std::vector<Database> open_parts(const std::vector<std::filesystem::path>& paths) {
  std::vector<Database> parts;
  for (const std::filesystem::path& path : paths) {
    parts.push_back(Database::open(path));
    if (!parts.back().shard())
      refuse(parts.back(), "is a whole database, expected a part that build-database --shard I/N wrote");
  }
  return parts;
}

/// The statement of the whole: that of a part without its number.
ShardStatement of_whole(ShardStatement statement) {
  statement.shard.number = 1;
  return statement;
}

/// "2, 5": which numbers up to `count` are not there.
std::string missing_numbers(const std::map<int, const Database*>& by_number, int count) {
  std::vector<int> missing;
  for (int number = 1; number <= count; ++number)
    if (!by_number.contains(number)) missing.push_back(number);
  return fmt::format("{}", fmt::join(missing, ", "));
}

/// Every part once.
void check_numbers(const std::vector<Database>& parts) {
  std::map<int, const Database*> by_number;
  for (const Database& part : parts) {
    const auto [same, is_new] = by_number.emplace(part.shard()->shard.number, &part);
    if (!is_new)
      refuse(part, fmt::format("is part {}, and so is {}", to_string(part.shard()->shard),
                               same->second->path().string()));
  }
  const int count = parts.front().shard()->shard.count;
  if (static_cast<int>(by_number.size()) != count)
    throw InputError(fmt::format("of {} parts these are not among the files: {}", count,
                                 missing_numbers(by_number, count)));
}

Sha256 checksum_of_intact(const Database& part) {
  const auto row = part.find(Scene{});
  if (!row) refuse(part, "lacks the intact bridge, which every part has");
  return part.record(*row).checksum;
}

/// Two parts of the same whole, computed alike.
void check_alike(const Database& part, const Database& first) {
  const auto refuse_beside = [&](const std::string& why) {
    refuse(part, fmt::format("does not fit to {}: {}", first.path().string(), why));
  };
  const auto changes = differences(part.provenance(), first.provenance());
  if (!changes.empty()) refuse_beside(fmt::format("{}", fmt::join(changes, "; ")));
  if (of_whole(*part.shard()) != of_whole(*first.shard()))
    refuse_beside(fmt::format("it is a part of another whole\n{}where the other has\n{}",
                              to_text(*part.shard()), to_text(*first.shard())));
  if (part.states() != first.states()) refuse_beside("other states");
  if (part.variants() != first.variants()) refuse_beside("other variants of the bridge");
  if (checksum_of_intact(part) != checksum_of_intact(first))
    refuse_beside(
        "they disagree about the intact bridge, which both have solved: one of the machines does not compute "
        "right");
}

/// The build that would have made the whole.
BuildRequest request_of(const MergeRequest& request, const Database& part) {
  const ShardStatement& statement = *part.shard();
  BuildRequest whole;
  whole.bridge = parse_bridge_file(part.bridge_text(), part.path().string() + " (bridge text)");
  whole.output = request.output;
  whole.scenes = statement.scenes;
  whole.scenes_of_variants = statement.scenes_of_variants;
  whole.histories = statement.histories;
  whole.loads = statement.loads;
  whole.other_variants.assign(part.variants().begin() + 1, part.variants().end());
  whole.threads = request.threads;
  whole.fields = statement.keeps_fields ? KeepField::yes : KeepField::no;
  whole.rules = rules_in(part.provenance().solver_settings);
  whole.known_bridge = statement.known_bridge;
  whole.force = request.force;
  whole.drop = request.drop;
  return whole;
}

}  // namespace

BuildSummary merge_databases(const MergeRequest& request, const SolverOfSettings& solver,
                             Progress& progress) {
  for (const std::filesystem::path& part : request.parts)
    if (std::error_code unknown; std::filesystem::equivalent(part, request.output, unknown))
      throw InputError(
          fmt::format("--output {} is one of the parts, expected another file", request.output.string()));
  std::vector<Database> parts = open_parts(request.parts);
  for (const Database& part : parts) check_alike(part, parts.front());
  check_numbers(parts);
  const Database& first = parts.front();
  const BuildRequest whole = request_of(request, first);
  const SolverChoice choice = solver(first.provenance().solver_settings);
  const auto changes = differences(provenance_of(whole, choice), first.provenance());
  if (!changes.empty())
    refuse(first, fmt::format("another version of the program made it, expected the one that merges: {}",
                              fmt::join(changes, "; ")));
  return build_from_parts(whole, choice, std::move(parts), progress);
}

}  // namespace voussoir
