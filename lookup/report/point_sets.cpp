#include "lookup/report/point_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace voussoir {
namespace {

/// One number for the top and the arch; of others the course.
int course_of(const PicturedAnswer& report, std::size_t point) {
  if (site_of(report, point) != Site::elsewhere) return 0;
  return report.library.layout[report.library.points[point].block].index.course;
}

/// Puts them in the order of the axis, and gives them places there.
void lay_out(const PicturedAnswer& report, const std::string& under, PointSet& set) {
  std::ranges::stable_sort(set.points, {}, [&](std::size_t point) {
    return std::pair(course_of(report, point), report.library.points[point].position.x());
  });
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    if (i > 0 && course_of(report, set.points[i]) != course_of(report, set.points[i - 1]))
      set.names.emplace_back();
    const std::string& name = report.library.points[set.points[i]].name;
    set.names.push_back(name.substr(0, name.size() - under.size()));
    set.places.push_back(static_cast<double>(set.names.size()));
  }
}

bool is_read(const PicturedAnswer& report, std::size_t point) {
  return std::isfinite(report.shown.reading[point]);
}

/// Appends the set of the sensors that belong, silent ones among them, if one of them is read.
template <class Belongs>
void add_set(const PicturedAnswer& report, const std::string& title, const std::string& id, Quantity quantity,
             const Belongs& belongs, std::vector<PointSet>& sets) {
  PointSet set{title, id, quantity, {}, {}, {}};
  for (std::size_t point = 0; point < report.library.points.size(); ++point)
    if (quantity_of(report.comparison, point) == quantity && belongs(point) &&
        (is_read(report, point) || report.comparison.measured.silent[point]))
      set.points.push_back(point);
  if (std::ranges::none_of(set.points, [&](std::size_t point) { return is_read(report, point); })) return;
  const std::vector<std::string>& loads = report.comparison.load;
  const std::string under = loads.empty() ? "" : under_load(loads[set.points.front()]);
  lay_out(report, under, set);
  std::vector<std::string> names = set.names;
  std::erase(names, "");
  set.title += ", " + names_in_words(names) + under;
  sets.push_back(std::move(set));
}

std::vector<std::string> loads_of(const PicturedAnswer& report) {
  std::vector<std::string> loads;
  for (const std::string& load : report.comparison.load)
    if (std::find(loads.begin(), loads.end(), load) == loads.end()) loads.push_back(load);
  return loads.empty() ? std::vector<std::string>{""} : loads;
}

}  // namespace

std::vector<PointSet> point_sets(const PicturedAnswer& report) {
  std::vector<PointSet> sets;
  int count = 1;
  std::string number;  // of the load, from the second on
  for (const std::string& load : loads_of(report)) {
    const auto under = [&](std::size_t point) {
      return load.empty() || report.comparison.load[point] == load;
    };
    const auto at = [&](Site site) {
      return [&, site](std::size_t point) { return under(point) && site_of(report, point) == site; };
    };
    add_set(report, "Top", "top" + number, Quantity::uy, at(Site::top), sets);
    add_set(report, "Arch", "arch" + number, Quantity::uy, at(Site::arch), sets);
    add_set(report, "Wall", "wall" + number, Quantity::uy, at(Site::elsewhere), sets);
    add_set(report, "Horizontal", "horizontal" + number, Quantity::ux, under, sets);
    add_set(report, "Tilts", "tilt" + number, Quantity::tilt, under, sets);
    add_set(report, "Distances", "distance" + number, Quantity::distance, under, sets);
    number = fmt::format("-{}", ++count);
  }
  return sets;
}

}  // namespace voussoir
