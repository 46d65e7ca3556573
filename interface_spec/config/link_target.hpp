// Where symbolic links lead, for who replaces a file: the link is to stay, and what it points to is what is meant.
#pragma once

#include <linux/magic.h>
#include <sys/vfs.h>

#include <filesystem>
#include <string>

namespace berm::config {

// The file at the end of a chain of links, there or not. A link of the process file system (/dev/stdout is one) is kept: it is an open file, not a name.
inline std::string link_target(const std::string& file) {
  namespace fs = std::filesystem;
  constexpr int kLongestChain = 40;  // the system's own limit; what is left of a longer one cannot be opened
  std::error_code error;
  fs::path path = file;
  for (int i = 0; i < kLongestChain; ++i) {
    const fs::path to = fs::read_symlink(path, error);
    if (error) break;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    struct statfs system {};
    if (statfs(folder.c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC) break;
    path = folder / to;  // to alone where it is absolute
  }
  return path.string();
}

}  // namespace berm::config
