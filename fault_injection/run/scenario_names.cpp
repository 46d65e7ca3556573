#include "run/scenario_names.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "config/toml_file.hpp"
#include "run/parameter_file.hpp"
#include "run/trace_reader.hpp"

namespace berm::run {

namespace {

double number(const toml::value& value) { return value.is_integer() ? static_cast<double>(value.as_integer()) : value.as_floating(); }
double number(const toml::value& table, const char* key) { return number(toml::find(table, key)); }

std::vector<Point2> rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

}  // namespace

ScenarioNames scenario_names(const std::string& path) {
  const auto file = config::parse_toml_file(path);
  const auto name = [&](const char* key) {
    if (!file.is_table() || !file.contains(key) || !toml::find(file, key).is_string())
      throw std::runtime_error(fmt::format("{}: {}: missing, or no name in quotes", path, key));
    return toml::find<std::string>(file, key);
  };
  return {name("machine"), name("site")};
}

std::vector<config::NamedFile> files_of_scenario(const std::string& path) {
  const ScenarioNames names = scenario_names(path);
  std::vector<config::NamedFile> files{{"the scenario", path}};
  const auto add = [&files](const char* what, const auto& find, const std::string& name) {
    try {
      files.push_back({what, find(name)});
    } catch (const std::runtime_error&) {  // no file of that name: told by who needs it
    }
  };
  add("the scenario's machine", find_machine, names.machine);
  add("the scenario's site", find_site, names.site);
  const auto scenario = config::parse_toml_file(path);
  if (scenario.contains("plant") && toml::find(scenario, "plant").is_string())
    files.push_back({"the scenario's plant", (std::filesystem::path(path).parent_path() / toml::find<std::string>(scenario, "plant")).string()});
  return files;
}

std::size_t lidar_count(const std::string& machine) {
  const auto file = config::parse_toml_file(machine);
  return file.is_table() && file.contains("lidar") && toml::find(file, "lidar").is_array() ? toml::find(file, "lidar").as_array().size() : 0;
}

void describe_site(const std::string& machine, const std::string& site, SitePictureInput& picture) {
  const auto m = toml::find(config::parse_toml_file(machine), "kinematics");
  picture.arm = {number(m, "boom_pin_x"), number(m, "boom_pin_z"), number(m, "boom"), number(m, "stick"), number(m, "bucket")};
  const auto s = config::parse_toml_file(site);
  for (const auto& zone : toml::find(s, "dig_zone").as_array()) {
    const auto& x = toml::find(zone, "x").as_array();
    const auto& y = toml::find(zone, "y").as_array();
    picture.dig_zones.push_back(rectangle(number(x[0]), number(y[0]), number(x[1]), number(y[1])));
  }
  const auto truck = toml::find(s, "truck");
  const auto& centre = toml::find(truck, "centre").as_array();
  picture.truck_bearing_rad = std::atan2(number(centre[1]), number(centre[0]));
  const auto& swing = toml::find(toml::find(s, "dig"), "swing_deg").as_array();
  picture.dig_bearing_rad = 0.5 * (number(swing[0]) + number(swing[1])) * std::numbers::pi / 180.0;
}

std::vector<MoverPath> mover_paths(const std::string& trace) {
  constexpr double kMoved_m = 0.5;
  constexpr int kEvery = 10;
  std::vector<MoverPath> paths;
  if (!std::filesystem::exists(trace)) return paths;
  TraceReader rows(trace);
  for (std::string& name : rows.movers()) paths.push_back({std::move(name), {}});
  for (int row = 0; rows.next(); ++row) {
    if (row % kEvery != 0) continue;
    for (MoverPath& path : paths) path.points.emplace_back(rows.value(path.name + "_x_m"), rows.value(path.name + "_y_m"));
  }
  std::erase_if(paths, [](const MoverPath& path) {
    for (const auto& point : path.points)
      if (std::hypot(point.first - path.points.front().first, point.second - path.points.front().second) > kMoved_m) return false;
    return true;
  });
  return paths;
}

}  // namespace berm::run
