// Independent work on several threads, handed over in the order of its numbers.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace berm::truck_world {

// work(k) for every k below count, so many at a time; done(k, result) in the calling thread, k rising. What work throws is thrown here, and what has
// not begun is not begun.
template <typename Result>
void in_turn(int count, int at_a_time, const std::function<Result(int)>& work, const std::function<void(int, const Result&)>& done) {
  std::mutex mutex;
  std::condition_variable changed;
  std::map<int, Result> ready;
  std::exception_ptr failed;
  int next = 0;
  const auto worker = [&] {
    std::unique_lock lock(mutex);
    while (next < count && !failed) {
      const int k = next++;
      lock.unlock();
      try {
        Result result = work(k);
        lock.lock();
        ready.emplace(k, std::move(result));
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        if (!failed) failed = std::current_exception();
      }
      changed.notify_all();
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < at_a_time && i < count; ++i) threads.emplace_back(worker);
  for (int k = 0; k < count; ++k) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return ready.contains(k) || failed; });
    if (!ready.contains(k)) break;
    const Result result = std::move(ready.extract(k).mapped());
    lock.unlock();
    done(k, result);
  }
  threads.clear();  // joins
  if (failed) std::rethrow_exception(failed);
}

}  // namespace berm::truck_world
