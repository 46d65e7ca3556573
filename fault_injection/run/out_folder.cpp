#include "run/out_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace berm::run {

OutFolder::OutFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw std::runtime_error(fmt::format("{}: {}", path, error.message()));
  fd_ = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd_ < 0) throw std::runtime_error(fmt::format("{}: {}", path, strerror(errno)));
  const auto refuse = [&](const std::string& why) {
    close(fd_);
    throw std::runtime_error(fmt::format("{}: {}", path, why));
  };
  if (faccessat(fd_, ".", W_OK | X_OK, AT_EACCESS) != 0) refuse(fmt::format("cannot be written: {}", strerror(errno)));
  if (flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;  // a file system that knows no locks must not keep a run from it
  refuse("in use: another run is writing to this folder");
}

OutFolder::~OutFolder() { close(fd_); }

std::vector<config::NamedFile> run_files(const std::string& out) {
  std::vector<config::NamedFile> files;
  if (out.empty()) return files;
  for (const std::string name : kRunFiles) files.push_back({"--out's " + name, out + "/" + name});
  return files;
}

std::string remove_former_run(const std::string& out) {
  std::string removed;
  for (const std::string name : kRunFiles)
    for (const std::string& file : {name, name + ".part"})
      if (std::filesystem::remove(out + "/" + file)) removed += (removed.empty() ? "" : ", ") + file;
  return removed;
}

}  // namespace berm::run
