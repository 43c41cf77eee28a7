#include "tools/trials/paper_cases.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace voussoir {
namespace {

using nlohmann::json;

PaperCase case_of(const json& entry) {
  return {entry.at("scene").get<std::string>(), entry.at("noise").get<double>(),
          entry.value("generations", std::string())};
}

std::vector<PaperCase> cases_of(const json& list) {
  std::vector<PaperCase> cases;
  for (const json& entry : list) cases.push_back(case_of(entry));
  return cases;
}

template <typename Value>
std::optional<Value> if_there(const json& file, const char* key) {
  return file.contains(key) ? std::optional(file.at(key).get<Value>()) : std::nullopt;
}

PaperCases cases_of_file(const json& file) {
  PaperCases cases;
  cases.source = file.at("source").get<std::string>();
  cases.example = case_of(file.at("example"));
  for (const json& field : file.at("fields"))
    cases.fields.push_back({field.at("scene").get<std::string>(), field.at("figure").get<std::string>()});
  cases.one_block = cases_of(file.at("one_block"));
  cases.two_blocks = cases_of(file.at("two_blocks"));
  if (file.contains("hard_pair")) cases.hard_pair = case_of(file.at("hard_pair"));
  if (file.contains("local_collapse")) {
    cases.collapse_in_paper = file.at("local_collapse").at("paper").get<std::string>();
    cases.local_collapse = file.at("local_collapse").at("scenes").get<std::vector<std::string>>();
  }
  if (file.contains("noise_limit")) {
    cases.noise_limit_in_paper = file.at("noise_limit").at("paper").get<std::string>();
    cases.noise_limit_levels = file.at("noise_limit").at("levels").get<std::vector<double>>();
  }
  cases.triangles = if_there<int>(file, "triangles");
  cases.top_mm = if_there<std::array<double, 2>>(file, "top_mm");
  cases.arch_mm = if_there<std::array<double, 2>>(file, "arch_mm");
  cases.radius_m = if_there<double>(file, "radius_m");
  return cases;
}

}  // namespace

PaperCases read_paper_cases(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw InputError(fmt::format("{}: cannot be read, expected a file of cases", path.string()));
  try {
    return cases_of_file(json::parse(stream));
  } catch (const json::exception& error) {
    throw InputError(
        fmt::format("{}: {}, expected a file like examples/cases/paper.json", path.string(), error.what()));
  }
}

std::filesystem::path paper_cases_file() {
  return std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "examples" / "cases" / "paper.json";
}

}  // namespace voussoir
