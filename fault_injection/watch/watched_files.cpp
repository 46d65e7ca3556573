#include "watch/watched_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "config/machine_file.hpp"
#include "config/whole_file.hpp"
#include "run/parameter_file.hpp"
#include "run/scenario_names.hpp"

namespace berm::watch {

namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return text.str();
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

struct Line { std::size_t begin, end; };  // of a key, without the line's end

// Tables come with their names alone on a line, keys with their values on one: as in every file that Berm ships.
std::optional<Line> find_key(const std::string& text, const std::string& table, const std::string& key) {
  std::string here;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = trimmed(text.substr(at, end - at));
    if (!line.empty() && line[0] == '[') {
      const auto close = line.find(']');
      if (line[1] != '[' && close != std::string::npos) here = trimmed(line.substr(1, close - 1));
      else if (line[1] == '[') here = line;
    } else if (here == table && trimmed(line.substr(0, line.find('='))) == key) {
      return Line{at, end};
    }
    at = end + 1;
  }
  return std::nullopt;
}

std::string in_quotes(const std::string& words) { return '"' + words + '"'; }

// The plant's profile as the scenario names it; a path is relative to the scenario and stays valid for a copy elsewhere.
std::string plant_of(const std::string& text, const std::string& scenario) {
  const auto line = find_key(text, "", "plant");
  if (!line) throw std::runtime_error(scenario + ": plant: missing");
  const std::string whole = text.substr(line->begin, line->end - line->begin);
  const auto first = whole.find('"'), last = whole.find('"', first + 1);
  if (first == std::string::npos || last == std::string::npos) throw std::runtime_error(scenario + ": plant: no name in quotes");
  const std::string name = whole.substr(first + 1, last - first - 1);
  if (name.find('/') == std::string::npos && name.find('.') == std::string::npos) return name;
  return std::filesystem::absolute(std::filesystem::path(scenario).parent_path() / name).string();
}

}  // namespace

std::string with_value(const std::string& text, const std::string& table, const std::string& key, const std::string& value) {
  const auto line = find_key(text, table, key);
  if (!line) throw std::runtime_error(fmt::format("{}{}: missing", table.empty() ? "" : "[" + table + "] ", key));
  return text.substr(0, line->begin) + key + " = " + value + text.substr(line->end);
}

WatchedFiles write_watched(const std::string& scenario, const std::string& machine, bool histogram, std::optional<double> max_time_s,
                           const std::string& folder) {
  const std::string scenario_path = run::find_scenario(scenario);
  const auto names = run::scenario_names(scenario_path);
  const std::string machine_path = run::find_machine(machine.empty() ? names.machine : machine);
  const config::MachineFile before = config::load_machine_file(machine_path);
  WatchedFiles files{folder + "/watched_scenario.toml", folder + "/watched_machine.toml", run::find_site(names.site)};
  const auto changed = [](const std::string& path, const std::string& text, const char* table, const char* key, const std::string& value) {
    try {
      return with_value(text, table, key, value);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path + ": " + error.what() + " on a line of its own");
    }
  };
  std::string machine_text = changed(machine_path, text_of(machine_path), "workspace", "watched", "true");
  if (histogram) machine_text = changed(machine_path, machine_text, "workspace", "histogram", "true");
  config::write_whole_file(files.machine, machine_text);
  if (!config::load_machine_file(files.machine).workspace.watched) throw std::runtime_error(machine_path + ": [workspace] watched: cannot be set");
  std::string text = text_of(scenario_path);
  const std::string plant = machine.empty() ? plant_of(text, scenario_path) : before.name + "_plant";
  text = changed(scenario_path, text, "", "machine", in_quotes(files.machine));
  text = changed(scenario_path, text, "", "plant", in_quotes(plant));
  if (max_time_s) text = changed(scenario_path, text, "run", "max_time_s", fmt::format("{:.2f}", *max_time_s));
  config::write_whole_file(files.scenario, text);
  return files;
}

}  // namespace berm::watch
