#include "run/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace berm::run {

namespace {

constexpr int kHighDescriptor = 200;  // above every number that a child is given
constexpr std::size_t kMostDescriptors = 16;

[[noreturn]] void child_fail(const char* what) {
  const int error = errno;
  dprintf(2, "berm: cannot start: %s: %s\n", what, strerror(error));
  _exit(127);
}

// Runs in the child between fork and exec: only async-signal-safe calls.
[[noreturn]] void become(const ChildOptions& options, int program_fd, int output_fd, char* const* argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);  // what the launcher keeps back for itself is not kept from the child
  if (dup2(output_fd, 1) < 0) child_fail("stdout");
  // To free numbers above what the child gets: neither do they overwrite one another nor what the launcher has there.
  std::array<int, kMostDescriptors> moved{};
  for (std::size_t i = 0; i < options.descriptors.size(); ++i) {
    moved[i] = fcntl(options.descriptors[i].first, F_DUPFD, kHighDescriptor);
    if (moved[i] < 0) child_fail("descriptor");
  }
  const int program = fcntl(program_fd, F_DUPFD, kHighDescriptor);
  if (program < 0) child_fail("program");
  for (int fd = 3; fd < kHighDescriptor; ++fd) close(fd);
  for (std::size_t i = 0; i < options.descriptors.size(); ++i)
    if (dup2(moved[i], options.descriptors[i].second) < 0) child_fail("descriptor");
  if (close_range(kHighDescriptor, ~0U, CLOSE_RANGE_CLOEXEC) != 0) child_fail("descriptors");
  if (options.no_network && unshare(CLONE_NEWNET) != 0)
    dprintf(2, "berm: note: %s keeps the computer's network: %s\n", argv[0], strerror(errno));
  if (options.uid) {
    if (setgroups(0, nullptr) != 0 || setgid(*options.uid) != 0 || setuid(*options.uid) != 0) child_fail("uid");
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // switching the uid clears it
  }
  fexecve(program, argv, environ);
  child_fail(argv[0]);
}

}  // namespace

ChildProcess::~ChildProcess() {
  if (pid_ > 0 && !ended()) {
    kill(pid_, SIGKILL);
    kill(pid_, SIGCONT);
    waitpid(pid_, &status_, 0);
  }
  if (output_ >= 0) close(output_);
}

void ChildProcess::start(const ChildOptions& options) {
  if (options.descriptors.size() > kMostDescriptors) throw std::invalid_argument(fmt::format("{}: more than {} descriptors", options.program, kMostDescriptors));
  name_ = options.program.substr(options.program.rfind('/') + 1);
  const int program = open(options.program.c_str(), O_RDONLY | O_CLOEXEC);
  if (program < 0) throw std::system_error(errno, std::generic_category(), options.program);
  int pipe_fds[2];
  if (pipe2(pipe_fds, O_CLOEXEC) != 0) {
    const int error = errno;
    close(program);
    throw std::system_error(error, std::generic_category(), "pipe");
  }
  std::vector<char*> argv;
  argv.push_back(const_cast<char*>(name_.c_str()));
  for (const auto& argument : options.arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) become(options, program, pipe_fds[1], argv.data());
  const int error = errno;
  close(program);
  close(pipe_fds[1]);
  if (pid_ < 0) {
    close(pipe_fds[0]);
    throw std::system_error(error, std::generic_category(), "fork");
  }
  output_ = pipe_fds[0];
  fcntl(output_, F_SETFL, O_NONBLOCK);
}

std::vector<std::string> ChildProcess::take_lines() {
  std::vector<std::string> lines;
  char buffer[4096];
  while (output_ >= 0) {
    const ssize_t n = read(output_, buffer, sizeof buffer);
    if (n > 0) {
      pending_.append(buffer, static_cast<std::size_t>(n));
    } else {
      if (n == 0) {
        close(output_);
        output_ = -1;
      } else if (errno == EINTR) {
        continue;
      }
      break;
    }
  }
  std::size_t begin = 0;
  for (std::size_t end; (end = pending_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    lines.push_back(pending_.substr(begin, end - begin));
  }
  pending_.erase(0, begin);
  return lines;
}

void ChildProcess::signal(int number) const {
  if (pid_ > 0 && !ended_) kill(pid_, number);
}

bool ChildProcess::ended() {
  if (!ended_ && pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
  return ended_;
}

bool ChildProcess::wait_ended(double seconds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!ended()) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

std::string ChildProcess::describe_end() const {
  if (!ended_) return "still running";
  if (WIFSIGNALED(status_)) return fmt::format("signal {} ({})", WTERMSIG(status_), strsignal(WTERMSIG(status_)));
  return fmt::format("exit {}", WEXITSTATUS(status_));
}

}  // namespace berm::run
