#include "run/kernel_session.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace berm::run {

namespace {

constexpr uid_t kKernelUid = 64600;  // outside Debian's ranges for people and packages
constexpr uid_t kAppUid = 64601;
constexpr uid_t kJournalUid = 64602;
constexpr int kReadyDescriptor = 10;  // number in the kernel's process
constexpr int kReadyPatienceMs = 20000;
constexpr const char* kFolder = "berm-run-";
constexpr const char* kAlive = "/alive";

// Only what this user's runs left: folders under /tmp may be anybody's.
bool is_left_over(const std::string& folder) {
  const int fd = open((folder + kAlive).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0) return false;
  struct stat about{};
  const bool free = fstat(fd, &about) == 0 && S_ISREG(about.st_mode) && about.st_uid == geteuid() && flock(fd, LOCK_EX | LOCK_NB) == 0;
  close(fd);
  return free;
}

void remove_left_over(const std::string& base) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(base, std::filesystem::directory_options::skip_permission_denied, ignored))
    if (entry.path().filename().string().starts_with(kFolder) && is_left_over(entry.path())) std::filesystem::remove_all(entry.path(), ignored);
}

// Under its name only when it is locked: else who cleans up would take it for left over.
int locked_file(const std::string& path) {
  const std::string early = path + ".part";
  const int fd = open(early.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
  if (fd < 0 || flock(fd, LOCK_EX | LOCK_NB) != 0 || rename(early.c_str(), path.c_str()) != 0) throw std::system_error(errno, std::generic_category(), path);
  return fd;
}

}  // namespace

RunFolder::RunFolder() {
  const char* named = std::getenv("TMPDIR");
  const std::string base = named != nullptr && *named != '\0' ? named : "/tmp";
  remove_left_over(base);
  std::string pattern = base + "/" + kFolder + "XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), pattern);
  path_ = pattern;
  chmod(path_.c_str(), 0755);
  alive_ = locked_file(path_ + kAlive);
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  if (alive_ >= 0) close(alive_);
}

void RunFolder::give_to(uid_t uid) const {
  if (chown(path_.c_str(), uid, static_cast<gid_t>(uid)) != 0) throw std::system_error(errno, std::generic_category(), path_);
}

Uids choose_uids() {
  const uid_t own = geteuid();
  if (own == 0) return {true, kKernelUid, kAppUid, own, kJournalUid};
  return {false, own, own, own, own};
}

void expect_reachable(const RunFolder& folder, const Uids& uids) {
  namespace fs = std::filesystem;
  if (!uids.separate) return;
  for (fs::path up = fs::canonical(folder.path()).parent_path(); up.has_relative_path(); up = up.parent_path()) {
    struct stat about{};
    if (stat(up.c_str(), &about) != 0) throw std::system_error(errno, std::generic_category(), up.string());
    if ((about.st_mode & S_IXOTH) == 0)
      throw std::runtime_error(fmt::format("TMPDIR: {}: mode {:04o} keeps the users of kernel and app ({} and {}) out: others must be able to enter it", up.string(),
                                           about.st_mode & 07777, uids.kernel, uids.app));
  }
}

void open_to_children(const std::string& path) {
  constexpr mode_t kFolderMode = 0755, kFileMode = 0644;
  const bool folder = std::filesystem::is_directory(path);
  if (chmod(path.c_str(), folder ? kFolderMode : kFileMode) != 0) throw std::system_error(errno, std::generic_category(), path);
  if (!folder) return;
  for (const auto& entry : std::filesystem::directory_iterator(path)) open_to_children(entry.path());
}

void copy_for_children(const std::string& source, const std::string& target) {
  std::filesystem::copy_file(source, target);
  open_to_children(target);
}

std::string program_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path().string(); }

std::string last_json_line(const std::vector<std::string>& lines) {
  for (auto line = lines.rbegin(); line != lines.rend(); ++line)
    if (!line->empty() && line->front() == '{') return *line;
  return {};
}

void start_kernel(ChildProcess& kernel, const RunFolder& folder, const Uids& uids, const std::string& parameters, std::vector<std::string> extra,
                  std::vector<std::pair<int, int>> descriptors) {
  int ready[2];
  if (pipe2(ready, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  ChildOptions options;
  options.program = program_folder() + "/berm_kernel";
  options.arguments = {"--parameters",   parameters,
                       "--socket",       folder.file("kernel.sock"),
                       "--app-uid",      std::to_string(uids.app),
                       "--recorder-uid", std::to_string(uids.recorder),
                       "--ready-fd",     std::to_string(kReadyDescriptor)};
  options.arguments.insert(options.arguments.end(), extra.begin(), extra.end());
  options.descriptors = std::move(descriptors);
  options.descriptors.emplace_back(ready[1], kReadyDescriptor);
  if (uids.separate) {
    folder.give_to(uids.kernel);
    options.uid = uids.kernel;
  }
  kernel.start(options);
  close(ready[1]);
  pollfd wait{ready[0], POLLIN, 0};
  char byte = 0;
  const bool good = poll(&wait, 1, kReadyPatienceMs) == 1 && read(ready[0], &byte, 1) == 1;
  close(ready[0]);
  if (!good) {
    kernel.wait_ended(1.0);
    throw std::runtime_error("the kernel did not start: " + kernel.describe_end());
  }
  // Whoever may connect is decided by the kernel from the peer's uid, not by the file's mode.
  chmod(folder.file("kernel.sock").c_str(), 0666);
}

}  // namespace berm::run
