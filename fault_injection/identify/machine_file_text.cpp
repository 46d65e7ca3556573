#include "identify/machine_file_text.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace berm::identify {

namespace {

std::string_view trimmed(std::string_view s) {
  const auto begin = s.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return s.substr(begin, s.find_last_not_of(" \t\r") - begin + 1);
}

// Goes over a text, strings and comments apart.
class Reader {
 public:
  Reader(const std::string& text, std::size_t at) : text_(text), at_(at) {}
  // End of the value that begins here: the first line's end, comma or comment outside of brackets and strings.
  std::size_t value_end() {
    int depth = 0;
    std::size_t last = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        if (depth == 0) break;
        at_ = text_.find('\n', at_);
        if (at_ == std::string::npos) break;
        continue;
      }
      if (c == '\n' && depth == 0) break;
      if (c == '"' || c == '\'') skip_string(c);
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      if (c != ' ' && c != '\t' && c != '\r' && c != '\n') last = at_ + 1;
      ++at_;
    }
    return last;
  }

 private:
  void skip_string(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_)
      if (quote == '"' && text_[at_] == '\\') ++at_;
  }
  const std::string& text_;
  std::size_t at_;
};

struct Span { std::size_t begin, end; };

// Of the value of section.key.
std::optional<Span> find_value(const std::string& text, const std::string& section, const std::string& key, int& times) {
  std::optional<Span> found;
  std::string current;
  for (std::size_t line = 0; line < text.size();) {
    std::size_t end = text.find('\n', line);
    if (end == std::string::npos) end = text.size();
    const std::string_view content = trimmed(std::string_view(text).substr(line, end - line));
    if (!content.empty() && content.front() == '[') {
      const auto close = content.find(']');
      current = std::string(trimmed(content.substr(1, close == std::string_view::npos ? close : close - 1)));
    } else if (const auto equals = content.find('='); !content.empty() && content.front() != '#' && equals != std::string_view::npos) {
      const std::size_t begin = text.find_first_not_of(" \t", text.find('=', line) + 1);
      const std::size_t value_end = begin == std::string::npos ? text.size() : Reader(text, begin).value_end();
      if (current == section && trimmed(content.substr(0, equals)) == key) {
        found = Span{begin, value_end};
        ++times;
      }
      end = std::max(end, text.find('\n', value_end));
      if (end == std::string::npos) end = text.size();
    }
    line = end + 1;
  }
  return found;
}

// Name in a header line; empty for another line.
std::string header_of(std::string_view line) {
  const std::string_view content = trimmed(line);
  if (content.empty() || content.front() != '[') return {};
  const std::size_t from = content.substr(0, 2) == "[[" ? 2 : 1;
  const auto close = content.find(']');
  return std::string(trimmed(content.substr(from, close == std::string_view::npos ? close : close - from)));
}

}  // namespace

std::string toml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20 || code == 0x7F) quoted += fmt::format("\\u{:04X}", code);
    else quoted += c;
  }
  return quoted + '"';
}

MachineFileText::MachineFileText(const std::string& path) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream all;
  all << file.rdbuf();
  if (!file) throw std::runtime_error(path + ": cannot be read");
  text_ = all.str();
}

void MachineFileText::replace(const std::string& section, const std::string& key, const std::string& value) {
  int times = 0;
  const auto span = find_value(text_, section, key, times);
  if (!span || times != 1) throw std::runtime_error(fmt::format("{}: {}.{}: must stand once, under its header [{}], to be replaced", path_, section, key, section));
  text_.replace(span->begin, span->end - span->begin, value);
}

void MachineFileText::replace_tables(const std::string& table, const std::string& new_text) {
  std::optional<Span> found;
  bool inside = false;
  for (std::size_t line = 0; line < text_.size();) {
    std::size_t end = text_.find('\n', line);
    const std::string_view content = std::string_view(text_).substr(line, end == std::string::npos ? end : end - line);
    const std::string header = header_of(content);
    const auto equals = content.find('='), comment = content.find('#');
    if (header.empty() && equals < comment) end = text_.find('\n', Reader(text_, text_.find_first_not_of(" \t", line + equals + 1)).value_end());
    end = end == std::string::npos ? text_.size() : end + 1;
    if (!header.empty()) {
      const bool ours = header == table || header.rfind(table + ".", 0) == 0;
      if (ours && found && !inside) throw std::runtime_error(fmt::format("{}: [{}]: its tables must stand together to be replaced", path_, table));
      if (ours && !found) found = Span{line, line};
      inside = ours;
    }
    if (inside) found->end = end;
    line = end;
  }
  if (found) {
    const std::size_t last = text_.find_last_not_of(" \t\r\n", found->end - 1);  // empty lines before the next table stay
    text_.replace(found->begin, last + 1 - found->begin, new_text.substr(0, new_text.find_last_not_of('\n') + 1));
  } else {
    if (!text_.empty() && text_.back() != '\n') text_ += '\n';
    text_ += "\n" + new_text;
  }
}

}  // namespace berm::identify
