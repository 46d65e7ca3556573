// Texts in tables of comma-separated values.
#pragma once

#include <string>

namespace berm::config {

// As RFC 4180 has it: in quotation marks where a comma, a quotation mark or the end of a line is in it, with each such mark of its own twice.
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace berm::config
