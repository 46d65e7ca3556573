#include "config/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "config/strict_table.hpp"

namespace berm::config {
namespace {

constexpr std::size_t kDeepest = 100;  // ours are 5 deep; toml11 needs some kB of stack for each
constexpr std::size_t kLargest = std::size_t{1} << 24;  // bytes; ours have 20 kB, and a device has no end

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
  return std::string(key);
}

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
    std::istringstream lines(std::move(text));
    return toml::parse(lines, file);
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
