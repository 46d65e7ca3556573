// Changes values in a machine file's text and leaves every other byte as it is.
#pragma once

#include <string>

namespace berm::identify {

// A text as TOML writes it, quotes included, whatever is in it.
std::string toml_string(const std::string& text);

class MachineFileText {
 public:
  // Throws std::runtime_error when the file cannot be read.
  explicit MachineFileText(const std::string& path);

  // Replaces the value of a key that stands under the header [section]; several lines when it is an array. Throws std::runtime_error when the key does
  // not stand so, once.
  void replace(const std::string& section, const std::string& key, const std::string& value);
  // Puts the text, which begins with the header [table], in the place of that table and of all [table.*], which must stand together; else at the end.
  // Throws std::runtime_error when they do not.
  void replace_tables(const std::string& table, const std::string& text);
  const std::string& text() const { return text_; }

 private:
  std::string path_, text_;
};

}  // namespace berm::identify
