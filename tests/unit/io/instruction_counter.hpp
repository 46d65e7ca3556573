// Instructions of this thread in user mode, where the machine lets them be counted (perf_event_open).
#pragma once

#include <cstdint>

namespace berm::kernel::test {

class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  bool counts() const { return fd_ >= 0; }
  std::uint64_t read() const;  // since construction; 0 where nothing counts

 private:
  int fd_;
};

}  // namespace berm::kernel::test
