// Files that a program is to write, looked at before the work is done: a result that cannot be written is lost with hours of it.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/link_target.hpp"

namespace berm::config {

// Why nothing can be written there; empty when it can. A folder gets a new file, a device is written into.
inline std::string why_not_written(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(file, error)) return "is a folder";
  const fs::path meant = link_target(file), folder = meant.has_parent_path() ? meant.parent_path() : ".";
  if (!fs::is_directory(folder, error)) return "its folder does not exist";
  const bool written_into = fs::exists(file, error) && !fs::is_regular_file(file, error);
  return access(written_into ? file.c_str() : folder.c_str(), W_OK) == 0 ? "" : std::string("cannot be written: ") + std::strerror(errno);
}

// Whether two names are of one file, which neither need be there yet.
inline bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  // absolute first: of a relative name that is not there yet weakly_canonical makes no whole path
  return fs::weakly_canonical(fs::absolute(a, error), error) == fs::weakly_canonical(fs::absolute(b, error), error);
}

struct NamedFile {
  std::string name, file;  // what the user knows it by: an option, a key; its path
};

// Which file that is to be written is one that is read too, or written twice; empty for none.
inline std::string overwritten(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read) {
  namespace fs = std::filesystem;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const auto& [name, file] = written[i];
    std::error_code error;
    if (file.empty() || (fs::exists(file, error) && !fs::is_regular_file(file, error))) continue;  // /dev/null may be named twice
    for (const NamedFile& other : read)
      if (fs::is_regular_file(other.file, error) && same_file(file, other.file)) return name + ": " + file + " is " + other.name + " too, and would be overwritten";
    for (std::size_t k = 0; k < i; ++k)
      if (!written[k].file.empty() && same_file(file, written[k].file)) return name + ": " + file + " is " + written[k].name + " too";
  }
  return "";
}

// Throws std::runtime_error with that, if there is one: of files that are known only when others have been read.
inline void expect_apart(const std::vector<NamedFile>& written, const std::vector<NamedFile>& read) {
  if (const std::string wrong = overwritten(written, read); !wrong.empty()) throw std::runtime_error(wrong);
}

}  // namespace berm::config
