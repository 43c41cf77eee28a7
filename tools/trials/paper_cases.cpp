#include "tools/trials/paper_cases.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr double kMostNoise = 1.0;  // [-] of a displacement
constexpr double kMostShown = 1e6;  // [mm], [m], triangles: what a paper may state of a bridge
constexpr std::size_t kMostLevels = 1000;

double number_in(const nlohmann::json& value, const char* key, double least, double most) {
  if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most))
    throw InputError(
        fmt::format("{} is {}, expected a number from {:g} to {:g}", key, value.dump(), least, most));
  return value.get<double>();
}

std::string text_in(const nlohmann::json& object, const char* key) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_string()) throw InputError(fmt::format("{} is {}, expected a text", key, value.dump()));
  return value.get<std::string>();
}

PaperCase case_of(const nlohmann::json& entry) {
  return {text_in(entry, "scene"), number_in(entry.at("noise"), "noise", 0.0, kMostNoise),
          entry.contains("generations") ? text_in(entry, "generations") : std::string()};
}

std::vector<PaperCase> cases_of(const nlohmann::json& list) {
  std::vector<PaperCase> cases;
  for (const nlohmann::json& entry : list) cases.push_back(case_of(entry));
  return cases;
}

std::vector<double> numbers_in(const nlohmann::json& list, const char* key, double least, double most) {
  if (!list.is_array() || list.size() > kMostLevels)
    throw InputError(fmt::format("{} is no list of at most {} numbers", key, kMostLevels));
  std::vector<double> numbers;
  for (const nlohmann::json& value : list) numbers.push_back(number_in(value, key, least, most));
  return numbers;
}

std::optional<double> if_there(const nlohmann::json& file, const char* key) {
  return file.contains(key) ? std::optional(number_in(file.at(key), key, 0.0, kMostShown)) : std::nullopt;
}

/// Smallest and largest.
std::optional<std::array<double, 2>> two_if_there(const nlohmann::json& file, const char* key) {
  if (!file.contains(key)) return std::nullopt;
  const std::vector<double> numbers = numbers_in(file.at(key), key, -kMostShown, kMostShown);
  if (numbers.size() != 2)
    throw InputError(fmt::format("{} has {} numbers, expected two", key, numbers.size()));
  return std::array{numbers[0], numbers[1]};
}

PaperCases cases_of_file(const nlohmann::json& file) {
  PaperCases cases;
  cases.source = text_in(file, "source");
  cases.example = case_of(file.at("example"));
  for (const nlohmann::json& field : file.at("fields"))
    cases.fields.push_back({text_in(field, "scene"), text_in(field, "figure")});
  cases.one_block = cases_of(file.at("one_block"));
  cases.two_blocks = cases_of(file.at("two_blocks"));
  if (file.contains("hard_pair")) cases.hard_pair = case_of(file.at("hard_pair"));
  if (file.contains("local_collapse")) {
    cases.collapse_in_paper = text_in(file.at("local_collapse"), "paper");
    cases.local_collapse = file.at("local_collapse").at("scenes").get<std::vector<std::string>>();
  }
  if (file.contains("noise_limit")) {
    cases.noise_limit_in_paper = text_in(file.at("noise_limit"), "paper");
    cases.noise_limit_levels = numbers_in(file.at("noise_limit").at("levels"), "levels", 0.0, kMostNoise);
  }
  if (const auto triangles = if_there(file, "triangles")) cases.triangles = static_cast<int>(*triangles);
  cases.top_mm = two_if_there(file, "top_mm");
  cases.arch_mm = two_if_there(file, "arch_mm");
  cases.radius_m = if_there(file, "radius_m");
  return cases;
}

}  // namespace

PaperCases read_paper_cases(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw InputError(fmt::format("{}: cannot be read, expected a file of cases", path.string()));
  try {
    return cases_of_file(nlohmann::json::parse(stream));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: {}, expected a file like examples/cases/paper.json", path.string(), error.what()));
  }
}

std::filesystem::path paper_cases_file() {
  return std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "examples" / "cases" / "paper.json";
}

}  // namespace voussoir
