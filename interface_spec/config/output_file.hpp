// Files that a program is to write, looked at before the work is done: a result that cannot be written is lost with hours of it.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

namespace berm::config {

// Why nothing can be written there; empty when it can. A folder gets a new file, a device is written into.
inline std::string why_not_written(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(file, error)) return "is a folder";
  const fs::path folder = fs::path(file).has_parent_path() ? fs::path(file).parent_path() : ".";
  if (!fs::is_directory(folder, error)) return "its folder does not exist";
  const bool written_into = fs::exists(file, error) && !fs::is_regular_file(file, error);
  return access(written_into ? file.c_str() : folder.c_str(), W_OK) == 0 ? "" : std::string("cannot be written: ") + std::strerror(errno);
}

// Whether two names are of one file, which neither need be there yet.
inline bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  return std::filesystem::weakly_canonical(a, error) == std::filesystem::weakly_canonical(b, error);
}

}  // namespace berm::config
