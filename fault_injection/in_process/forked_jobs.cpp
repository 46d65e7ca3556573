#include "in_process/forked_jobs.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace berm::in_process {

namespace {

constexpr int kAsk_ms = 100;

struct Job {
  int number = -1;
  pid_t pid = -1;
  int output = -1;
  std::string pending;  // of a line that is not yet whole
};

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

// Ends without what the parent has yet to write, or to close.
[[noreturn]] void become(pid_t parent, const std::function<void()>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it ended before that was set
  try {
    work();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    _exit(1);
  }
  _exit(0);
}

void write_line(int output, std::string line) {
  line += '\n';
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t n = write(output, line.data() + written, line.size() - written);
    if (n < 0 && errno != EINTR) fail("a job's result");
    if (n > 0) written += static_cast<std::size_t>(n);
  }
}

Job begin(int number, const std::function<void(int, const Say&)>& do_one) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
  const pid_t parent = getpid(), pid = fork();
  if (pid == 0) {
    const int output = ends[1];
    become(parent, [&] { do_one(number, [output](const std::string& line) { write_line(output, line); }); });
  }
  const int error = errno;
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    errno = error;
    fail("fork");
  }
  return {number, pid, ends[0], {}};
}

void wait_for(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) fail("waitpid");
  if (WIFSIGNALED(status)) throw std::runtime_error("a job was ended by signal " + std::to_string(WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) throw std::runtime_error("a job failed");
}

// False when there is no more to come.
bool listen(Job& job, const std::function<void(int, const std::string&)>& told) {
  char buffer[65536];
  const ssize_t n = read(job.output, buffer, sizeof buffer);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  if (n == 0) return false;
  job.pending.append(buffer, static_cast<std::size_t>(n));
  std::size_t from = 0;
  for (std::size_t end; (end = job.pending.find('\n', from)) != std::string::npos; from = end + 1)
    told(job.number, job.pending.substr(from, end - from));
  job.pending.erase(0, from);
  return true;
}

void end_all(const std::vector<Job>& running) {
  for (const Job& job : running) {
    kill(job.pid, SIGKILL);
    waitpid(job.pid, nullptr, 0);
    close(job.output);
  }
}

}  // namespace

void run_in_processes(int count, int at_a_time, const std::function<void(int, const Say&)>& do_one,
                      const std::function<void(int, const std::string&)>& told, const std::function<bool()>& stop) {
  if (at_a_time == 0) at_a_time = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<Job> running;
  int next = 0;
  try {
    while (next < count || !running.empty()) {
      if (stop && stop()) return end_all(running);
      while (next < count && static_cast<int>(running.size()) < at_a_time) running.push_back(begin(next++, do_one));
      std::vector<pollfd> ready;
      for (const Job& job : running) ready.push_back({job.output, POLLIN, 0});
      if (poll(ready.data(), ready.size(), stop ? kAsk_ms : -1) < 0 && errno != EINTR) fail("poll");
      for (std::size_t i = ready.size(); i-- > 0;) {
        if (ready[i].revents == 0 || listen(running[i], told)) continue;
        const Job ended = running[i];
        running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
        close(ended.output);
        wait_for(ended.pid);
      }
    }
  } catch (...) {
    end_all(running);
    throw;
  }
}

void in_a_copy(const std::function<void()>& work) {
  const pid_t parent = getpid(), pid = fork();
  if (pid == 0) become(parent, work);
  if (pid < 0) fail("fork");
  wait_for(pid);
}

}  // namespace berm::in_process
