// Counts what may not happen in a cycle, process-wide: allocation, throwing, locking. The functions themselves are replaced, so that libraries count too.
#pragma once

namespace berm::kernel::test {

struct ForbiddenCalls {
  long allocations = 0;  // malloc family and operator new, and what is given back
  long throws = 0;
  long locks = 0;        // mutexes, read-write locks, spin locks, condition variables, semaphores

  ForbiddenCalls since(const ForbiddenCalls& before) const { return {allocations - before.allocations, throws - before.throws, locks - before.locks}; }
  long all() const { return allocations + throws + locks; }
};

// Up to now.
ForbiddenCalls forbidden_calls();

// False where a sanitizer has replaced these functions already.
bool forbidden_calls_count();

}  // namespace berm::kernel::test
