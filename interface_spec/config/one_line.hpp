// Words of others in a line of ours: a file or a name may hold a newline, what moves a terminal's cursor, or a megabyte.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace berm::config {

// With a '?' for each control character, but for a newline that ends it, and a return of the carriage that begins it.
inline std::string one_line(std::string line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    char& c = line[i];
    const bool own = (c == '\r' && i == 0) || (c == '\n' && i + 1 == line.size());
    if (!own && (static_cast<unsigned char>(c) < ' ' || c == '\x7f')) c = '?';
  }
  return line;
}

// To standard error, for programs that have no fmt (else print_error).
inline void put_error(const std::string& words) { std::fputs(one_line(words + "\n").c_str(), stderr); }

// As a message quotes what a file holds: its beginning, with a '?' for what is not printable ASCII, and "..." where more follows.
inline std::string excerpt(std::string_view text, std::size_t most = 60) {
  std::string begin(text.substr(0, most));
  for (char& c : begin)
    if (c < ' ' || c > '~') c = '?';
  return text.size() > most ? begin + "..." : begin;
}

}  // namespace berm::config
