#include "tools/trials/study_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/units.h"

namespace voussoir {
namespace {

std::string share_text(const Share& share) {
  return fmt::format("{:5.3f} ({:.3f})", share.value, share.standard_error);
}

double off_by(const ReliabilityBin& bin) {
  return bin.standard_error > 0.0 ? (bin.frequency - bin.mean_probability) / bin.standard_error : 0.0;
}

nlohmann::ordered_json share_json(const Share& share) {
  return {{"share", share.value}, {"standard_error", share.standard_error}};
}

nlohmann::ordered_json verdicts_json(const TrialRates& rates) {
  nlohmann::ordered_json json;
  for (const Verdict verdict : all_verdicts())
    json[std::string(to_string(verdict))] = rates.verdicts[static_cast<std::size_t>(verdict)];
  return json;
}

nlohmann::ordered_json row_json(const StudyRow& row) {
  nlohmann::ordered_json bins = nlohmann::ordered_json::array();
  for (const ReliabilityBin& bin : row.rates.bins)
    bins.push_back({{"scenes", bin.scenes},
                    {"mean_probability", bin.mean_probability},
                    {"frequency", bin.frequency},
                    {"standard_error", bin.standard_error}});
  return {{"truth", row.truth},
          {"looked_for", row.looked_for},
          {"readings", to_string(row.taken)},
          {"sigma_mm", kMillimetres * row.sigma},
          {"known_bridge", row.known_bridge},
          {"trials", row.rates.trials},
          {"bridges", row.rates.bridges},
          {"first", share_json(row.rates.first)},
          {"in_95_set", share_json(row.rates.in_credible)},
          {"in_exact_95", share_json(row.rates.in_exact)},
          {"wrong_and_sure", share_json(row.rates.wrong_and_sure)},
          {"called_damaged", share_json(row.rates.alarm)},
          {"names_sound_block", share_json(row.rates.names_sound)},
          {"stated_of_95_set", row.rates.mean_in_set},
          {"mean_set_size", row.rates.mean_set_size},
          {"mean_brier", row.rates.mean_brier},
          {"verdicts", verdicts_json(row.rates)},
          {"reliability", bins},
          {"milliseconds", row.milliseconds}};
}

}  // namespace

std::string heading_text() {
  std::string verdicts;
  for (const Verdict verdict : all_verdicts())
    verdicts += fmt::format("{}{}", verdicts.empty() ? "" : "/", to_string(verdict));
  return fmt::format(
      "{:<22} {:<21} {:<11} {:>5} {:>7} {:>6} {:>13} {:>13} {:>13} {:>6} {:>7} {:>13} {:>13} {:>13} {:>6} "
      "{:>6} "
      " {}\n",
      "truth", "looked for", "readings", "sigma", "bridge", "trials", "first", "95 % set", "exactly 95 %",
      "stated", "size", "wrong > 90 %", "called damaged", "names sound", "Brier", "ms", verdicts);
}

std::string to_text(const StudyRow& row) {
  const TrialRates& rates = row.rates;
  return fmt::format(
      "{:<22} {:<21} {:<11} {:>5.2g} {:>7} {:>6} {:>13} {:>13} {:>13} {:>6.3f} {:>7.1f} {:>13} {:>13} {:>13} "
      "{:>6.3f} {:>6.1f}  {}\n",
      row.truth, row.looked_for, to_string(row.taken), kMillimetres * row.sigma,
      row.known_bridge ? "known" : "unknown", rates.trials, share_text(rates.first),
      share_text(rates.in_credible), share_text(rates.in_exact), rates.mean_in_set, rates.mean_set_size,
      share_text(rates.wrong_and_sure), share_text(rates.alarm), share_text(rates.names_sound),
      rates.mean_brier, row.milliseconds, fmt::join(rates.verdicts, "/"));
}

std::vector<ReliabilityBin> joined_bins(const std::vector<StudyRow>& rows, bool known_bridge) {
  std::vector<ReliabilityBin> bins = unfinished_bins();
  for (const StudyRow& row : rows)
    if (row.known_bridge == known_bridge) add_finished(row.rates.bins, bins);
  finish_bins(bins);
  return bins;
}

std::string reliability_text(const std::vector<StudyRow>& rows) {
  std::string text;
  for (const bool known_bridge : {true, false}) {
    const std::vector<ReliabilityBin> bins = joined_bins(rows, known_bridge);
    text += fmt::format("\nReliability, {} bridge\n  {:>9} {:>8} {:>10} {:>10} {:>16}\n",
                        known_bridge ? "known" : "unknown", "stated p", "scenes", "mean p", "frequency",
                        "standard errors");
    for (std::size_t i = 0; i < bins.size(); ++i)
      text += fmt::format("  {:.1f}..{:.1f}  {:>8} {:>10.4f} {:>10.4f} {:>+16.2f}\n",
                          0.1 * static_cast<double>(i), 0.1 * static_cast<double>(i + 1), bins[i].scenes,
                          bins[i].mean_probability, bins[i].frequency, off_by(bins[i]));
  }
  return text;
}

std::string to_json(const StudySource& source, const std::vector<StudyRow>& rows) {
  nlohmann::ordered_json json = {
      {"source",
       {{"database", source.database},
        {"digest", source.digest},
        {"bridge", source.bridge},
        {"truths", source.truths},
        {"sampled_bridges", source.settings.sampled ? source.settings.sampled->count : 0},
        {"seed", source.settings.seed},
        {"load", source.settings.load},
        {"every", source.settings.every},
        {"every_all", source.settings.every_all}}},
      {"rows", nlohmann::ordered_json::array()}};
  for (const StudyRow& row : rows) json["rows"].push_back(row_json(row));
  return json.dump(1) + "\n";
}

}  // namespace voussoir
