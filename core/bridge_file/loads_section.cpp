#include "core/bridge_file/loads_section.h"

#include <algorithm>
#include <cctype>

namespace voussoir {
namespace {

constexpr std::size_t kLongestLoadName =
    12;  ///< [bytes] names of states have room for history, load and step
constexpr int kMostPlaces = 999;

/// Reads a force beside its place.
void read_force(TomlSection& section, const char* key, double& force) {
  section.require(key);
  section.positive(key, force);
}

void read_place(TomlSection& section, const char* key, const Interval& within, double& place) {
  section.require(key);
  section.number(key, place, within.left, within.right);
}

/// The tables of an array, each read by `read`.
template <class Value, class Read>
std::vector<Value> read_all(TomlSection& load, const char* key, const char* how, const Read& read) {
  std::vector<Value> values;
  const toml::array* tables = load.tables(key, how);
  if (tables == nullptr) return values;
  for (const toml::node& node : *tables) {
    TomlSection section(load.file(), node.as_table(), fmt::format(" in {} of [[loads]]", key));
    read(section, values.emplace_back());
    section.refuse_unknown_keys();
  }
  return values;
}

void read_forces(TomlSection& section, const Interval& bridge, LoadDescription& load) {
  load.points = read_all<PointLoad>(section, "points", "points = [{x_m = 1.0, force_N = 1e3}]",
                                    [&](TomlSection& one, PointLoad& point) {
                                      read_place(one, "x_m", bridge, point.x);
                                      read_force(one, "force_N", point.force);
                                    });
  load.lines = read_all<LineLoad>(
      section, "lines", "lines = [{from_x_m = 1.0, to_x_m = 2.0, force_N_per_m = 1e3}]",
      [&](TomlSection& one, LineLoad& line) {
        read_place(one, "from_x_m", bridge, line.from_x);
        read_place(one, "to_x_m", bridge, line.to_x);
        read_force(one, "force_N_per_m", line.force_per_length);
        if (!(line.to_x > line.from_x))
          one.refuse("to_x_m",
                     fmt::format("is {:g}: expected more than from_x_m = {:g}", line.to_x, line.from_x));
      });
  load.axles = read_all<Axle>(section, "axles", "axles = [{at_m = 0.0, force_N = 1e3}]",
                              [](TomlSection& one, Axle& axle) {
                                read_place(one, "at_m", {0.0, kLargestLength}, axle.at);
                                read_force(one, "force_N", axle.force);
                              });
  if (load.points.empty() && load.lines.empty() && load.axles.empty())
    section.refuse("name", "expected points, lines or axles beside it");
}

bool stands_on(const Interval& bridge, const LoadDescription& load, double place) {
  return std::ranges::any_of(load.axles, [&](const Axle& axle) {
    return place - axle.at >= bridge.left && place - axle.at <= bridge.right;
  });
}

/// Where the vehicle stands, if there is one: at one place or at several in turn.
void read_places(TomlSection& section, const Interval& bridge, LoadDescription& load) {
  constexpr Interval kAnywhere{-2.0 * kLargestLength, 2.0 * kLargestLength};
  const bool moves = section.has("from_m") || section.has("to_m") || section.has("steps");
  double from = 0.0, to = 0.0;
  int steps = 1;
  if (load.axles.empty()) {
    if (moves || section.has("place_m")) section.refuse("axles", "expected beside the vehicle's place");
    return;
  }
  if (moves && section.has("place_m")) section.refuse("place_m", "expected it, or from_m, to_m and steps");
  if (moves) {
    read_place(section, "from_m", kAnywhere, from);
    read_place(section, "to_m", kAnywhere, to);
    section.require("steps");
    section.count("steps", steps, 2, kMostPlaces);
  } else {
    read_place(section, "place_m", kAnywhere, from);
  }
  for (int step = 0; step < steps; ++step) {
    load.places.push_back(steps == 1 ? from : from + (to - from) * step / (steps - 1));
    if (!stands_on(bridge, load, load.places.back()))
      section.refuse(
          moves ? "from_m" : "place_m",
          fmt::format("with the front at x = {:g} m no axle is on the bridge: expected one between {:g} and "
                      "{:g} m",
                      load.places.back(), bridge.left, bridge.right));
  }
}

void read_name(TomlSection& section, const std::vector<LoadDescription>& before, LoadDescription& load) {
  section.require("name");
  section.text("name", load.name);
  const bool legible = std::ranges::all_of(load.name, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
  });
  if (load.name.empty() || load.name.size() > kLongestLoadName || !legible || load.name == "all" ||
      load.name == "none")
    section.refuse(
        "name", fmt::format("is '{}': expected up to {} letters, digits, - and _, and neither all nor none",
                            load.name, kLongestLoadName));
  if (std::ranges::find(before, load.name, &LoadDescription::name) != before.end())
    section.refuse("name",
                   fmt::format("there are two loads '{}': expected a name of its own for each", load.name));
}

}  // namespace

std::vector<LoadDescription> read_loads(const toml::array& tables, const std::string& file,
                                        const Interval& bridge) {
  std::vector<LoadDescription> loads;
  for (const toml::node& node : tables) {
    TomlSection section(file, node.as_table(), " in [[loads]]");
    LoadDescription load;
    read_name(section, loads, load);
    read_forces(section, bridge, load);
    for (const char* key : {"place_m", "from_m", "to_m", "steps", "width_m"}) section.know(key);
    read_places(section, bridge, load);
    if (section.has("width_m")) section.length("width_m", load.width.emplace(0.0));
    section.flag("unload", load.unload);
    section.refuse_unknown_keys();
    loads.push_back(std::move(load));
  }
  return loads;
}

}  // namespace voussoir
