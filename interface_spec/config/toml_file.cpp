#include "config/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "config/one_line.hpp"
#include "config/strict_table.hpp"

namespace berm::config {
namespace {

constexpr std::size_t kDeepest = 100;  // ours are 5 deep; toml11 needs some kB of stack for each
constexpr std::size_t kLargest = std::size_t{1} << 20;  // bytes; ours have 20 kB, and a device has no end
constexpr std::size_t kLongest = 10000;                 // bytes of a line; ours have 200, and toml11 takes the square of it: minutes for a megabyte

// How deep arrays, inline tables and dotted keys lie in one another. A dot of a number counts too, until its value ends.
class Depth {
 public:
  explicit Depth(std::string_view text) : text_(text) {}

  // The line in which the text becomes too deep; 0: in none.
  std::size_t too_deep_line() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
      } else if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        ++at_;
        take(c);
        if (depth_ > kDeepest) return line_;
      }
    }
    return 0;
  }

 private:
  void take(char c) {
    if (c == '[' || c == '{') {
      outside_.push_back(depth_++);
    } else if (c == '.') {
      ++depth_;
    } else if ((c == ']' || c == '}') && !outside_.empty()) {
      depth_ = outside_.back();
      outside_.pop_back();
    } else if (c == ',' || c == '\n') {  // no key and no number goes on behind these
      depth_ = outside_.empty() ? 0 : outside_.back() + 1;
    }
    if (c == '\n') ++line_;
  }

  // As toml11 does: three quotes open a text of lines, three to five close it; any other ends in its line.
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool lines = text_.substr(at_, 3) == three;
    for (at_ += lines ? 3 : 1; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') {
        if (!lines) return;
        ++line_;
      } else if (text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
        ++at_;
      } else if (lines && text_.substr(at_, 3) == three) {
        at_ += 3;
        for (int more = 0; more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
        return;
      } else if (!lines && text_[at_] == quote) {
        ++at_;
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1, depth_ = 0;
  std::vector<std::size_t> outside_;  // the depth outside of each open bracket
};

// The first line that is too long; 0: none is.
std::size_t too_long_line(std::string_view text) {
  std::size_t line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kLongest) return line;
    begin = end + 1;
  }
  return 0;
}

// toml11's first line of it: [error] toml::insert_value: ... ("KEY") or (KEY) ... . The key as its own part of the file has it, without the header's;
// empty for another error, and for a key that would not stay in a line.
std::string key_defined_again(const std::string& error) {
  const std::string_view line = std::string_view(error).substr(0, error.find('\n'));
  if (line.find("toml::insert_value: ") == std::string_view::npos) return "";
  const std::size_t open = line.find('('), close = line.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return "";
  std::string_view key = line.substr(open + 1, close - open - 1);
  if (key.size() > 2 && key.front() == '"' && key.back() == '"') key = key.substr(1, key.size() - 2);
  if (std::any_of(key.begin(), key.end(), [](unsigned char c) { return std::iscntrl(c) != 0; })) return "";
  return excerpt(key);
}

// toml11 takes the nearest that fits for a number that does not, and of a binary one what is left of it.
class Fit {
 public:
  Fit(const std::string& file, std::string_view text) : file_(file) {
    for (std::size_t at = text.find("0b"); at != std::string_view::npos && !binary_; at = text.find("0b", at + 2)) {
      const std::size_t end = std::min(text.find_first_not_of("01_", at + 2), text.size());
      binary_ = end - at - 2 >= kBits;
    }
  }

  void check(const toml::value& value, const std::string& field) {
    if (value.is_table()) {
      for (const auto& [key, inner] : value.as_table()) check(inner, field.empty() ? key : field + "." + key);
    } else if (value.is_array()) {
      std::size_t i = 0;
      for (const toml::value& inner : value.as_array()) check(inner, inner.is_table() ? fmt::format("{}[{}]", field, i++) : field);
    } else if (value.is_integer()) {
      const std::int64_t x = value.as_integer();
      if (x != Integer::max() && x != Integer::min() && !binary_) return;
      look_up(field);
      if (!integer_fits(written(value))) refuse(field, written(value), Integer::min(), Integer::max());
    } else if (value.is_floating() && std::abs(value.as_floating()) == Floating::max()) {
      look_up(field);
      if (!std::isfinite(std::strtod(written(value).c_str(), nullptr))) refuse(field, written(value), -Floating::max(), Floating::max());
    }
  }

 private:
  using Integer = std::numeric_limits<std::int64_t>;
  using Floating = std::numeric_limits<double>;
  static constexpr std::size_t kBits = 64;
  static constexpr std::size_t kQuoted = 80;  // a path of keys, and a number of so many bits
  static constexpr int kMostLookedUp = 200;  // toml11 counts the text's lines for each: a megabyte of them would be minutes

  // Only those are looked up in the text that may be another's stand-in.
  void look_up(const std::string& field) {
    if (++looked_up_ > kMostLookedUp) throw ConfigError(fmt::format("{}: {}: more than {} numbers that may not fit into 64 bits", file_, excerpt(field, kQuoted), kMostLookedUp));
  }

  // As the file has it, without the underscores.
  static std::string written(const toml::value& value) {
    const toml::source_location place = value.location();
    std::string text = place.line_str().substr(place.column() - 1, place.region());
    text.erase(std::remove(text.begin(), text.end(), '_'), text.end());
    return text;
  }

  static bool integer_fits(const std::string& text) {
    const std::string_view prefix = std::string_view(text).substr(0, 2);
    const int base = prefix == "0x" ? 16 : prefix == "0o" ? 8 : prefix == "0b" ? 2 : 10;
    const char* begin = text.data() + (base != 10 ? 2 : text.front() == '+' ? 1 : 0);
    std::int64_t x = 0;
    return std::from_chars(begin, text.data() + text.size(), x, base).ec == std::errc();
  }

  template <typename Number>
  [[noreturn]] void refuse(const std::string& field, const std::string& text, Number low, Number high) const {
    throw ConfigError(fmt::format("{}: {}: {} is outside {} .. {}", file_, excerpt(field, kQuoted), excerpt(text, kQuoted), low, high));
  }

  const std::string& file_;
  bool binary_ = false;  // there is one of 64 digits or more
  int looked_up_ = 0;
};

}  // namespace

toml::value parse_toml_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw ConfigError(fmt::format("{}: cannot be read", file));
  try {
    std::string text(kLargest + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (stream.bad()) throw ConfigError(fmt::format("{}: cannot be read", file));
    if (text.size() > kLargest) throw ConfigError(fmt::format("{}: more than {} bytes", file, kLargest));
    if (const std::size_t line = Depth(text).too_deep_line(); line != 0)
      throw ConfigError(fmt::format("{}: line {}: nested more than {} deep", file, line, kDeepest));
    if (const std::size_t line = too_long_line(text); line != 0) throw ConfigError(fmt::format("{}: line {}: more than {} bytes", file, line, kLongest));
    Fit fit(file, text);
    std::istringstream lines(std::move(text));
    toml::value value = toml::parse(lines, file);
    fit.check(value, "");
    return value;
  } catch (const toml::exception& error) {
    if (const std::string key = key_defined_again(error.what()); !key.empty())
      throw ConfigError(fmt::format("{}: line {}: not valid TOML: {} is defined already", file, error.location().line(), key));
    throw ConfigError(fmt::format("{}: line {}: not valid TOML", file, error.location().line()));
  } catch (const ConfigError&) {
    throw;
  } catch (const std::exception&) {  // of unreadable streams, and what toml11 throws for numbers that fit nowhere
    throw ConfigError(fmt::format("{}: cannot be read as TOML", file));
  }
}

}  // namespace berm::config
