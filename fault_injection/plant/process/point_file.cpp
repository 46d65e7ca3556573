#include "plant/process/point_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

#include "config/one_line.hpp"
#include "plant/machine/strict_table.hpp"

namespace berm::plant {

namespace {

constexpr double kFarthest_m = 1e6;
constexpr std::size_t kMostPoints = 20'000'000;

[[noreturn]] void refuse(const std::string& path, std::string_view field, const std::string& reason) {
  throw ConfigError(fmt::format("{}: {}: {}", path, field, reason));
}

// The next number of a line; false when there is none.
bool next_number(std::string_view& line, double& value) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return false;
  const char* const end = line.data() + line.size();
  const auto [stop, error] = std::from_chars(line.data() + begin, end, value);
  const bool whole = error == std::errc{} && (stop == end || *stop == ' ' || *stop == '\t' || *stop == '\r');
  line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
  return whole && std::abs(value) <= kFarthest_m;
}

// Keyword to the words behind it, to the line DATA; what has to be there is checked.
std::size_t read_header(std::ifstream& file, const std::string& path) {
  std::map<std::string, std::string> header;
  for (std::string line; !header.contains("DATA") && std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string key, value;
    words >> key;
    for (std::string word; words >> word;) value += (value.empty() ? "" : " ") + word;
    header[key] = value;
    if (header.size() > 16) refuse(path, "DATA", "no such line among the first: no PCD file");
  }
  static constexpr std::array<std::pair<const char*, const char*>, 3> kWanted{{{"FIELDS", "x y z"}, {"TYPE", "F F F"}, {"DATA", "ascii"}}};
  for (const auto& [key, value] : kWanted) {
    if (!header.contains(key)) refuse(path, key, "is missing: no PCD file");
    if (header[key] != value) refuse(path, key, fmt::format("'{}' is not '{}', the one kind of PCD that ground is read from", config::excerpt(header[key]), value));
  }
  if (header.contains("COUNT") && header["COUNT"] != "1 1 1") refuse(path, "COUNT", fmt::format("'{}' is not '1 1 1'", config::excerpt(header["COUNT"])));
  const std::string& words = header["POINTS"];
  std::size_t points = 0;
  const auto [stop, error] = std::from_chars(words.data(), words.data() + words.size(), points);
  if (error != std::errc{} || stop != words.data() + words.size() || points < 3 || points > kMostPoints)
    refuse(path, "POINTS", fmt::format("'{}' is no number from 3 to {}", config::excerpt(words), kMostPoints));
  return points;
}

}  // namespace

std::vector<MeasuredPoint> read_point_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!file || (file.peek(), !file)) refuse(path, "file", "cannot be read");
  const std::size_t count = read_header(file, path);
  std::vector<MeasuredPoint> points;
  while (std::getline(file, line)) {
    std::string_view rest = line;
    if (rest.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    MeasuredPoint point{};
    for (double& value : point)
      if (!next_number(rest, value))
        refuse(path, "DATA", fmt::format("point {} is no three numbers within {:.0f} m", points.size() + 1, kFarthest_m));
    if (rest.find_first_not_of(" \t\r") != std::string_view::npos)
      refuse(path, "DATA", fmt::format("point {} has more than three numbers", points.size() + 1));
    points.push_back(point);
    if (points.size() > count) break;
  }
  if (points.size() != count)
    refuse(path, "POINTS", fmt::format("says {}, there are {}{}", count, points.size() > count ? "at least " : "", points.size()));
  return points;
}

}  // namespace berm::plant
