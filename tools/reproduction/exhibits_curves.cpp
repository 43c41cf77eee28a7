#include <fmt/format.h>

#include "tools/reproduction/exhibits.h"
#include "tools/reproduction/shares.h"

namespace voussoir {
namespace {

double per_cent(int count, const Success& success) {
  return kPerCent * share(count, success.trials);
}

/// One way to rank scenes, and its colour.
struct Ranking {
  const char* name;
  int colour;
  Success OperatingPoint::*success;
};

constexpr std::array<Ranking, 3> kRankings = {
    Ranking{"Eq. 1", 2, &OperatingPoint::misfit},
    Ranking{"posterior, noise known", 1, &OperatingPoint::known},
    Ranking{"posterior, noise unknown", 3, &OperatingPoint::unknown}};

/// One way to succeed.
struct Measure {
  const char* title;
  int Success::*count;
  bool for_misfit;  ///< Eq. 1 gives no set
};

constexpr std::array<Measure, 3> kMeasures = {
    Measure{"truth first [%]", &Success::first, true},
    Measure{"truth among the first five [%]", &Success::in_five, true},
    Measure{"truth in the 95 % set [%]", &Success::in_credible, false}};

Chart operating_chart(const std::vector<OperatingPoint>& curve, const Measure& measure) {
  Chart chart{measure.title, {"noise [%]"}, {measure.title, AxisScale::linear, {{0.0, 100.0}}}, {}};
  for (const Ranking& ranking : kRankings) {
    if (!measure.for_misfit && ranking.success == &OperatingPoint::misfit) continue;
    Series series{ranking.name, ranking.colour, Mark::beads, {}, {}};
    for (const OperatingPoint& point : curve) {
      const Success& success = point.*ranking.success;
      series.x.push_back(noise_per_cent(point.noise));
      series.y.push_back(per_cent(success.*measure.count, success));
    }
    chart.series.push_back(series);
  }
  return chart;
}

Table operating_table(const std::vector<OperatingPoint>& curve) {
  Table table{{"noise [%]"}, {}};
  for (const Ranking& ranking : kRankings)
    for (const Measure& measure : kMeasures)
      if (measure.for_misfit || ranking.success != &OperatingPoint::misfit)
        table.columns.push_back(fmt::format("{}: {}", ranking.name, measure.title));
  for (const OperatingPoint& point : curve) {
    table.rows.push_back({noise_per_cent(point.noise)});
    for (const Ranking& ranking : kRankings)
      for (const Measure& measure : kMeasures)
        if (measure.for_misfit || ranking.success != &OperatingPoint::misfit)
          table.rows.back().emplace_back(
              per_cent((point.*ranking.success).*measure.count, point.*ranking.success));
  }
  return table;
}

}  // namespace

Exhibit operating_exhibit(const std::vector<OperatingPoint>& curve, const std::string& id,
                          const std::string& title) {
  std::string pictures = "<div class=\"figures thirds\">";
  for (const Measure& measure : kMeasures)
    pictures += "<div>" + chart_html(operating_chart(curve, measure)) + "</div>\n";
  return {{id, title,
           fmt::format(
               "{} random standing scenes at each level, the same at all; candidates are all scenes with as "
               "many missing blocks. Uniform relative noise on every control point.",
               curve.front().misfit.trials),
           pictures + "</div>\n", operating_table(curve), true}};
}

Exhibit course_exhibit(const std::vector<CourseSuccess>& courses) {
  Series misfit{"Eq. 1", 2, Mark::beads, {}, {}};
  Series known{"posterior, noise known", 1, Mark::beads, {}, {}};
  Table table{{"course", "trials", "Eq. 1: truth first [%]", "posterior, noise known: truth first [%]"}, {}};
  for (const CourseSuccess& course : courses) {
    for (Series* series : {&misfit, &known}) series->x.push_back(course.course);
    misfit.y.push_back(per_cent(course.misfit.first, course.misfit));
    known.y.push_back(per_cent(course.known.first, course.known));
    table.rows.push_back({static_cast<double>(course.course), static_cast<double>(course.misfit.trials),
                          misfit.y.back(), known.y.back()});
  }
  return {{"courses", "Which courses are easy",
           fmt::format("Every block of the wall whose removal leaves the bridge standing, missing alone, at "
                       "{:.0f} % noise, "
                       "five trials each.",
                       kPerCent * kComparedNoise),
           chart_html({"Success by course",
                       {"course, from the bottom"},
                       {"truth first [%]", AxisScale::linear, {{0.0, 100.0}}},
                       {misfit, known}}),
           table}};
}

}  // namespace voussoir
