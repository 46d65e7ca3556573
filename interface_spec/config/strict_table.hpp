// Strict reading of TOML files: a key that is unknown, missing, of the wrong type or out of range is an error that names file and field.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace berm::config {

// what(): "FILE: field: reason", one line.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::size_t kLongestText = 200;  // bytes

class StrictTable {
 public:
  static StrictTable parse_file(const std::string& file);

  bool has(const std::string& key) const;
  double number(const std::string& key, double low, double high);           // integers are taken too
  double number_or(const std::string& key, double low, double high, double fallback);
  double degrees(const std::string& key, double low_deg, double high_deg);  // gives radians
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high);
  bool flag(const std::string& key);
  std::string text(const std::string& key);
  std::string choice(const std::string& key, const std::vector<std::string>& allowed);
  std::vector<double> numbers(const std::string& key, std::size_t count, double low, double high);
  std::vector<double> numbers(const std::string& key, std::size_t least_count, std::size_t most_count, double low, double high);
  template <std::size_t N>
  std::array<double, N> array(const std::string& key, double low, double high) {
    const std::vector<double> values = numbers(key, N, low, high);
    std::array<double, N> out{};
    for (std::size_t i = 0; i < N; ++i) out[i] = values[i];
    return out;
  }
  // Low and high end, at least least apart.
  std::array<double, 2> interval(const std::string& key, double low, double high, double least);
  std::vector<std::array<double, 2>> points(const std::string& key, std::size_t low_count, std::size_t high_count, double low, double high);
  // Exactly rows x columns numbers, an array of rows.
  std::vector<std::vector<double>> matrix(const std::string& key, std::size_t rows, std::size_t columns, double low, double high);
  StrictTable table(const std::string& key);
  std::vector<StrictTable> tables(const std::string& key);                  // [[key]]; none when absent
  void finish() const;                                                      // an unknown key is an error
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;
  const std::string& file() const { return file_; }

 private:
  struct Node;  // a value of the TOML library: its header costs every includer seconds to compile
  StrictTable(std::string file, std::string path, std::shared_ptr<const Node> node);

  std::string file_, path_;
  std::shared_ptr<const Node> node_;
  std::set<std::string> seen_;
};

constexpr double radians(double degrees) { return degrees * 3.14159265358979323846 / 180.0; }

}  // namespace berm::config
