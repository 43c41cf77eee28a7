#include "tools/validation/suite.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <mutex>

#include "core/error.h"
#include "core/threads.h"
#include "tools/validation/studies.h"

namespace voussoir::validation {
namespace {

StudyResult run_study(const Study& study) {
  StudyResult result{.name = study.name, .title = study.title};
  const auto begin = std::chrono::steady_clock::now();
  try {
    result.findings = study.run();
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

bool fits(const Study& study, const std::string& word) {
  return study.name.find(word) != std::string::npos;
}

[[noreturn]] void refuse(const std::string& word, const std::vector<Study>& studies) {
  std::string names;
  for (const Study& study : studies) names += (names.empty() ? "" : ", ") + study.name;
  throw InputError(fmt::format("no study's name contains '{}': expected one of {}", word, names));
}

}  // namespace

std::vector<Study> all_studies() {
  std::vector<Study> all;
  for (auto group : {elasticity_studies(), rest_studies(), motion_studies(), arch_studies(), shape_studies(),
                     spreading_studies(), bridge_studies(), load_studies(), loss_studies(), wall_studies(),
                     material_sweeps(), geometry_sweeps(), solver_sweeps()})
    std::move(group.begin(), group.end(), std::back_inserter(all));
  return all;
}

std::vector<Study> chosen_studies(const std::vector<std::string>& words, bool quick_only) {
  const std::vector<Study> all = all_studies();
  for (const std::string& word : words)
    if (std::none_of(all.begin(), all.end(), [&](const Study& s) { return fits(s, word); }))
      refuse(word, all);
  std::vector<Study> chosen;
  for (const Study& study : all) {
    const bool named = words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& word) {
                         return fits(study, word);
                       });
    if (named && (study.quick || !quick_only)) chosen.push_back(study);
  }
  return chosen;
}

std::vector<StudyResult> run_studies(const std::vector<Study>& studies, int threads,
                                     const std::function<void(const StudyResult&)>& finished) {
  std::vector<StudyResult> results(studies.size());
  std::mutex reporting;
  for_each_index_on_threads(studies.size(), threads, [&](std::size_t i) {
    results[i] = run_study(studies[i]);
    const std::lock_guard lock(reporting);
    finished(results[i]);
  });
  return results;
}

Tally tally(const std::vector<StudyResult>& results) {
  Tally sum;
  for (const StudyResult& result : results) {
    for (const Case& c : result.findings.cases) {
      sum.comparisons += !c.tolerance;
      sum.cases += c.tolerance.has_value();
      sum.within += c.tolerance && c.within();
    }
    for (const HardCase& c : result.findings.hard_cases) {
      ++sum.hard_cases;
      sum.correct += c.correct;
    }
    sum.failures += !result.failure.empty();
  }
  return sum;
}

}  // namespace voussoir::validation
