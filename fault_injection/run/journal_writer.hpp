// The journal's writer of a run: a process that is handed the open file, for its uid can write nothing in the run's folder.
#pragma once

#include <cstdint>
#include <string>

#include "run/child_process.hpp"
#include "run/kernel_session.hpp"

namespace berm::run {

class JournalWriter {
 public:
  // pace: a socket on which it tells the plant how far it is; -1: in real time nobody waits for it. Returns when it has the kernel's ring; throws
  // std::runtime_error when it does not come to that.
  void start(const std::string& file, const RunFolder& folder, const Uids& uids, int pace);

  // After the kernel's end it empties the ring and closes the file, which then gets its name: true, with the cycles whose record was lost.
  // False: it ended early, and the file is left as .part.
  bool finish(std::uint64_t& lost);

  pid_t pid() const { return process_.pid(); }
  void signal(int number) const { process_.signal(number); }
  std::string describe_end() const { return process_.describe_end(); }

 private:
  std::string file_;
  ChildProcess process_;
};

}  // namespace berm::run
