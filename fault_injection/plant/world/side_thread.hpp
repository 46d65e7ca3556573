// A thread beside the caller's that does one job at a time: work that needs nothing of what the caller does meanwhile.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace berm::plant {

class SideThread {
 public:
  SideThread() : thread_([this] { serve(); }) {}
  SideThread(const SideThread&) = delete;
  SideThread& operator=(const SideThread&) = delete;
  ~SideThread() {
    give({});
    thread_.join();
  }

  // Begins the job as soon as the thread gets to it; the one before has ended. It must not throw.
  void give(std::function<void()> job) {
    {
      const std::lock_guard lock(mutex_);
      job_ = std::move(job);
      given_ = true;
    }
    changed_.notify_one();
  }
  // Until the job is done; one that has not begun is taken back, and never done.
  void end() {
    std::unique_lock lock(mutex_);
    if (!begun_) given_ = false;
    changed_.wait(lock, [this] { return !given_; });
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return given_; });
      if (!job_) return;
      begun_ = true;
      lock.unlock();
      job_();
      lock.lock();
      given_ = begun_ = false;
      changed_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;
  bool given_ = false, begun_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace berm::plant
