#include "points/pcd_header.hpp"

#include <fmt/format.h>

#include <charconv>
#include <algorithm>
#include <cmath>
#include <map>

#include "config/one_line.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {
namespace {

constexpr std::size_t kHeaderLines = 100;
constexpr std::size_t kLineBytes = 8192;
constexpr std::size_t kFields = 256;
constexpr std::size_t kElements = 4096;  // of one point, all fields together
constexpr std::uint64_t kPoints = 1'000'000'000;

using Words = std::vector<std::string_view>;

Words words_of(std::string_view line) {
  Words words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class Header {
public:
  Header(std::string_view bytes, const std::string& name) : name_(name) {
    std::size_t at = 0;
    for (std::size_t line = 0; line < kHeaderLines; ++line) {
      const std::size_t end = bytes.substr(0, at + kLineBytes).find('\n', at);
      if (end == std::string_view::npos) fail("header", fmt::format("ends before its DATA line, or a line is longer than {} bytes", kLineBytes));
      const Words words = words_of(bytes.substr(at, end - at));
      at = end + 1;
      if (words.empty() || words[0].front() == '#') continue;
      const std::string key(words[0]);
      if (!lines_.emplace(key, Words(words.begin() + 1, words.end())).second) fail(key, "is given twice");
      if (key == "DATA") {
        data_begin_ = at;
        return;
      }
    }
    fail("header", fmt::format("no DATA line within {} lines", kHeaderLines));
  }

  PcdHeader header() const {
    PcdHeader out;
    out.data_begin = data_begin_;
    read_fields(out);
    read_points(out);
    read_viewpoint(out);
    const Words& data = line("DATA", 1);
    if (data[0] == "ascii") out.data = PcdData::kAscii;
    else if (data[0] == "binary") out.data = PcdData::kBinary;
    else if (data[0] == "binary_compressed") out.data = PcdData::kCompressed;
    else fail("DATA", "is none of ascii, binary, binary_compressed");
    return out;
  }

private:
  [[noreturn]] void fail(const std::string& field, const std::string& why) const { throw PointFileError(fmt::format("{}: {}: {}", name_, config::excerpt(field), why)); }

  const Words& line(const std::string& key, std::size_t count) const {
    const auto found = lines_.find(key);
    if (found == lines_.end()) fail(key, "is missing");
    if (found->second.size() != count) fail(key, fmt::format("has {} values, {} wanted", found->second.size(), count));
    return found->second;
  }

  std::uint64_t number(const std::string& key, std::string_view word, std::uint64_t least, std::uint64_t most) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value < least || value > most)
      fail(key, fmt::format("is no whole number from {} to {}", least, most));
    return value;
  }

  void read_fields(PcdHeader& out) const {
    const auto names = lines_.find("FIELDS");
    if (names == lines_.end()) fail("FIELDS", "is missing");
    const std::size_t n = names->second.size();
    if (n == 0 || n > kFields) fail("FIELDS", fmt::format("names {} fields, 1 to {} allowed", n, kFields));
    const Words& sizes = line("SIZE", n);
    const Words& types = line("TYPE", n);
    for (std::size_t i = 0; i < n; ++i) {
      PcdField field;
      field.name = names->second[i];
      if (types[i] != "F" && types[i] != "I" && types[i] != "U") fail("TYPE", "is none of F, I, U");
      field.type = types[i].front();
      field.size = number("SIZE", sizes[i], 1, 8);
      if (field.size != 1 && field.size != 2 && field.size != 4 && field.size != 8) fail("SIZE", "is none of 1, 2, 4, 8");
      if (field.type == 'F' && field.size < 4) fail("SIZE", "of a field of type F is neither 4 nor 8");
      field.count = lines_.count("COUNT") != 0 ? number("COUNT", line("COUNT", n)[i], 1, kElements) : 1;
      field.offset = out.point_bytes;
      field.first_word = out.point_words;
      out.point_bytes += field.size * field.count;
      out.point_words += field.count;
      if (out.point_words > kElements) fail("COUNT", fmt::format("gives a point more than {} elements", kElements));
      if (field.name != "_" && out.find(field.name) != nullptr) fail("FIELDS", fmt::format("{} is given twice", config::excerpt(field.name)));
      out.fields.push_back(field);
    }
    for (const char* wanted : {"x", "y", "z"})
      if (out.find(wanted) == nullptr) fail("FIELDS", fmt::format("{} is missing", wanted));
  }

  void read_points(PcdHeader& out) const {
    const std::uint64_t width = number("WIDTH", line("WIDTH", 1)[0], 0, kPoints);
    const std::uint64_t height = number("HEIGHT", line("HEIGHT", 1)[0], 0, kPoints);
    out.points = lines_.count("POINTS") != 0 ? number("POINTS", line("POINTS", 1)[0], 0, kPoints) : width * height;
    if (out.points != width * height) fail("POINTS", "is not WIDTH times HEIGHT");
  }

  void read_viewpoint(PcdHeader& out) const {
    if (lines_.count("VIEWPOINT") == 0) return;
    const Words& words = line("VIEWPOINT", 7);
    constexpr double kFarthest = 1e7, kWritten = 1e-6;  // m; as the digits of a file may have a rotation
    std::array<double, 7> value{};
    for (std::size_t i = 0; i < 7; ++i) {
      const auto [end, error] = std::from_chars(words[i].data(), words[i].data() + words[i].size(), value[i]);
      if (error != std::errc{} || end != words[i].data() + words[i].size()) value[i] = NAN;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (!(std::abs(value[i]) <= kFarthest)) fail("VIEWPOINT", "is no finite place within 1e7 m");
    // Points are taken as they stand in the file; who turned them by it would get others.
    value[3] = std::abs(value[3]) - 1.0;
    for (std::size_t i = 3; i < 7; ++i)
      if (!(std::abs(value[i]) <= kWritten)) fail("VIEWPOINT", "its rotation is not 1 0 0 0, and no other is taken");
    std::copy_n(value.begin(), 3, out.viewpoint.begin());
  }

  const std::string& name_;
  std::map<std::string, Words> lines_;
  std::size_t data_begin_ = 0;
};

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  for (const PcdField& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

PcdHeader parse_pcd_header(std::string_view bytes, const std::string& name) { return Header(bytes, name).header(); }

}  // namespace berm::app
