#include "config/whole_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "config/link_target.hpp"

namespace berm::config {
namespace {

bool replaceable(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
}

}  // namespace

void write_whole_file(const std::string& path, std::string_view bytes, bool durable) {
  const std::string meant = link_target(path);
  const bool replace = replaceable(meant);
  const std::string written = replace ? meant + ".part" + std::to_string(getpid()) : meant;
  std::FILE* file = std::fopen(written.c_str(), "wbe");
  bool good = file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
  good = good && (!durable || fsync(fileno(file)) == 0 || errno == EINVAL);  // a pipe or /dev/null keeps nothing
  int error = good ? 0 : errno;
  if (file != nullptr && std::fclose(file) != 0 && error == 0) error = errno;
  if (replace && error == 0 && std::rename(written.c_str(), meant.c_str()) != 0) error = errno;
  if (error == 0) return;
  if (replace) std::remove(written.c_str());
  throw std::runtime_error(path + ": cannot be written: " + std::strerror(error));
}

}  // namespace berm::config
