#include "in_process/workers.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace berm::in_process {

int run_trials(int count, int jobs, const std::function<void(int)>& do_one, const std::function<void(int, int)>& done, const std::function<bool()>& stop) {
  if (jobs == 0) jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::atomic<int> next = 0;
  int finished = 0;
  std::mutex telling;
  std::exception_ptr wrong;
  const auto work = [&] {
    while (!stop || !stop()) {
      const int i = next++;
      if (i >= count) return;
      try {
        do_one(i);
      } catch (...) {
        const std::lock_guard lock(telling);
        if (!wrong) wrong = std::current_exception();
        next = count;
        return;
      }
      const std::lock_guard lock(telling);
      done(++finished, i);
    }
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < jobs; ++i) workers.emplace_back(work);
  work();
  for (auto& worker : workers) worker.join();
  if (wrong) std::rethrow_exception(wrong);
  return finished;
}

}  // namespace berm::in_process
