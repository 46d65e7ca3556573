// A child process of a run: started with named descriptors, optionally under another uid, its standard output read line by line.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace berm::run {

struct ChildOptions {
  std::string program;                               // path
  std::vector<std::string> arguments;                // without the program's name
  std::vector<std::pair<int, int>> descriptors;      // (ours, number in the child); everything else is closed
  std::optional<uid_t> uid;                          // switch to this uid and gid (root only)
  bool no_network = false;                           // a network namespace with nothing in it; one line on stderr where the launcher may not (root only)
};

class ChildProcess {
 public:
  ChildProcess() = default;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();  // kills and reaps what still runs

  // Starts the program; throws std::system_error naming it. The program file is opened before the uid is switched, so that it may lie where that uid cannot look.
  void start(const ChildOptions& options);

  pid_t pid() const { return pid_; }
  const std::string& name() const { return name_; }
  int output_fd() const { return output_; }          // non-blocking read end of its standard output; -1 after end of file
  // Complete lines that have arrived since the last call.
  std::vector<std::string> take_lines();
  void signal(int number) const;
  // Reaps if it has ended. True when it has (now or before).
  bool ended();
  // Waits up to this long; true when it has ended.
  bool wait_ended(double seconds);
  int exit_status() const { return status_; }        // as from waitpid; valid once ended
  std::string describe_end() const;                  // "exit 0", "signal 9 (Killed)"

 private:
  pid_t pid_ = -1;
  int output_ = -1;
  bool ended_ = false;
  int status_ = 0;
  std::string name_;
  std::string pending_;
};

}  // namespace berm::run
