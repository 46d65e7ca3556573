#include "points/file_bytes.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "config/whole_file.hpp"
#include "points/point_cloud.hpp"

namespace berm::app {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

}  // namespace

std::string read_file_bytes(const std::string& path, std::size_t limit) {
  const File file(std::fopen(path.c_str(), "rbe"));
  if (!file) throw PointFileError(fmt::format("{}: {}", path, std::strerror(errno)));
  struct stat status {};
  if (fstat(fileno(file.get()), &status) == 0 && S_ISDIR(status.st_mode)) throw PointFileError(fmt::format("{}: is a folder", path));
  std::string bytes;
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  while (true) {
    const std::size_t have = bytes.size();
    bytes.resize(have + kPiece);
    const std::size_t got = std::fread(bytes.data() + have, 1, kPiece, file.get());
    bytes.resize(have + got);
    if (bytes.size() > limit) throw PointFileError(fmt::format("{}: size: more than {} bytes", path, limit));
    if (got < kPiece) break;
  }
  if (std::ferror(file.get()) != 0) throw PointFileError(fmt::format("{}: cannot be read", path));
  return bytes;
}

void write_file_bytes(const std::string& path, std::string_view bytes) try {
  config::write_whole_file(path, bytes);
} catch (const std::runtime_error& error) {
  throw PointFileError(error.what());
}

}  // namespace berm::app
