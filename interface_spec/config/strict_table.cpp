#include "config/strict_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/one_line.hpp"
#include "config/toml_file.hpp"

namespace berm::config {

struct StrictTable::Node {
  toml::value value;

  static const toml::value& at(StrictTable& table, const std::string& key);
  static double checked(const StrictTable& table, const std::string& key, const toml::value& value, double low, double high);
};

StrictTable::StrictTable(std::string file, std::string path, std::shared_ptr<const Node> node)
    : file_(std::move(file)), path_(std::move(path)), node_(std::move(node)) {
  if (!node_->value.is_table()) throw ConfigError(fmt::format("{}: {}: must be a table", file_, path_));
}

StrictTable StrictTable::parse_file(const std::string& file) {
  return StrictTable(file, "", std::make_shared<Node>(Node{parse_toml_file(file)}));
}

void StrictTable::fail(const std::string& key, const std::string& reason) const {
  throw ConfigError(fmt::format("{}: {}{}: {}", file_, path_, excerpt(key), reason));
}

bool StrictTable::has(const std::string& key) const { return node_->value.contains(key); }

const toml::value& StrictTable::Node::at(StrictTable& table, const std::string& key) {
  if (!table.has(key)) table.fail(key, "is missing");
  table.seen_.insert(key);
  return table.node_->value.at(key);
}

double StrictTable::Node::checked(const StrictTable& table, const std::string& key, const toml::value& value, double low, double high) {
  double x = 0.0;
  if (value.is_floating()) {
    x = value.as_floating();
  } else if (value.is_integer()) {
    x = static_cast<double>(value.as_integer());
  } else {
    table.fail(key, "must be a number");
  }
  if (!std::isfinite(x) || x < low || x > high) table.fail(key, fmt::format("{} is outside {} .. {}", x, low, high));
  return x;
}

double StrictTable::number(const std::string& key, double low, double high) { return Node::checked(*this, key, Node::at(*this, key), low, high); }

double StrictTable::number_or(const std::string& key, double low, double high, double fallback) {
  return has(key) ? number(key, low, high) : fallback;
}

double StrictTable::degrees(const std::string& key, double low_deg, double high_deg) { return radians(number(key, low_deg, high_deg)); }

std::int64_t StrictTable::integer(const std::string& key, std::int64_t low, std::int64_t high) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_integer()) fail(key, "must be a whole number");
  const std::int64_t x = value.as_integer();
  if (x < low || x > high) fail(key, fmt::format("{} is outside {} .. {}", x, low, high));
  return x;
}

bool StrictTable::flag(const std::string& key) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_boolean()) fail(key, "must be true or false");
  return value.as_boolean();
}

std::string StrictTable::text(const std::string& key) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_string()) fail(key, "must be a text");
  const std::string s = value.as_string().str;
  if (s.empty() || s.size() > kLongestText) fail(key, fmt::format("must have 1 to {} characters", kLongestText));
  return s;
}

std::string StrictTable::choice(const std::string& key, const std::vector<std::string>& allowed) {
  std::string s = text(key);
  if (std::find(allowed.begin(), allowed.end(), s) == allowed.end()) fail(key, fmt::format("'{}' is not one of {}", excerpt(s), fmt::join(allowed, ", ")));
  return s;
}

std::vector<double> StrictTable::numbers(const std::string& key, std::size_t count, double low, double high) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_array() || value.as_array().size() != count) fail(key, fmt::format("must be an array of {} numbers", count));
  std::vector<double> out;
  for (const toml::value& item : value.as_array()) out.push_back(Node::checked(*this, key, item, low, high));
  return out;
}

std::vector<double> StrictTable::numbers(const std::string& key, std::size_t least_count, std::size_t most_count, double low, double high) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_array() || value.as_array().size() < least_count || value.as_array().size() > most_count)
    fail(key, fmt::format("must be an array of {} to {} numbers", least_count, most_count));
  std::vector<double> out;
  for (const toml::value& item : value.as_array()) out.push_back(Node::checked(*this, key, item, low, high));
  return out;
}

std::array<double, 2> StrictTable::interval(const std::string& key, double low, double high, double least) {
  const auto ends = array<2>(key, low, high);
  if (ends[1] - ends[0] < least) fail(key, fmt::format("the low end {} is not below the high end {} by {} or more", ends[0], ends[1], least));
  return ends;
}

std::vector<std::array<double, 2>> StrictTable::points(const std::string& key, std::size_t low_count, std::size_t high_count, double low, double high) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_array()) fail(key, "must be an array of points");
  const auto& items = value.as_array();
  if (items.size() < low_count || items.size() > high_count) fail(key, fmt::format("must have {} to {} points", low_count, high_count));
  std::vector<std::array<double, 2>> out;
  for (const toml::value& item : items) {
    if (!item.is_array() || item.as_array().size() != 2) fail(key, "each point must be an array of 2 numbers");
    out.push_back({Node::checked(*this, key, item.as_array()[0], low, high), Node::checked(*this, key, item.as_array()[1], low, high)});
  }
  return out;
}

std::vector<std::vector<double>> StrictTable::matrix(const std::string& key, std::size_t rows, std::size_t columns, double low, double high) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_array() || value.as_array().size() != rows) fail(key, fmt::format("must have {} rows", rows));
  std::vector<std::vector<double>> out;
  for (const toml::value& row : value.as_array()) {
    if (!row.is_array() || row.as_array().size() != columns) fail(key, fmt::format("each row must have {} numbers", columns));
    out.emplace_back();
    for (const toml::value& item : row.as_array()) out.back().push_back(Node::checked(*this, key, item, low, high));
  }
  return out;
}

StrictTable StrictTable::table(const std::string& key) {
  const toml::value& value = Node::at(*this, key);
  if (!value.is_table()) fail(key, "must be a table");
  return StrictTable(file_, path_ + key + ".", std::make_shared<Node>(Node{value}));
}

std::vector<StrictTable> StrictTable::tables(const std::string& key) {
  std::vector<StrictTable> out;
  if (!has(key)) return out;
  const toml::value& value = Node::at(*this, key);
  if (!value.is_array()) fail(key, "must be an array of tables");
  std::size_t index = 0;
  for (const toml::value& item : value.as_array()) {
    const std::string name = fmt::format("{}[{}]", key, index++);
    if (!item.is_table()) fail(name, "must be a table");
    out.push_back(StrictTable(file_, path_ + name + ".", std::make_shared<Node>(Node{item})));
  }
  return out;
}

void StrictTable::finish() const {
  for (const auto& [key, value] : node_->value.as_table()) {
    if (seen_.find(key) == seen_.end()) fail(key, "is not a known key");
  }
}

}  // namespace berm::config
