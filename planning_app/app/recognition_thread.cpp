#include "app/recognition_thread.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace berm::app {

namespace {

constexpr int behind_the_loop = 10;  // nice

}  // namespace

RecognitionThread::RecognitionThread(TruckRangeSet ranges, std::uint64_t lockstep_cycles) : ranges_(std::move(ranges)), lockstep_cycles_(lockstep_cycles) {
  thread_ = std::thread([this] { work(); });
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return runs_; });
}

RecognitionThread::~RecognitionThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RecognitionThread::ask(std::vector<ScanPoint> points, const std::array<double, 3>& viewpoint, std::uint64_t cycle) {
  {
    const std::lock_guard lock(mutex_);
    question_ = Question{std::move(points), viewpoint};
    answer_.reset();
    ++number_;
    open_ = true;
    asked_cycle_ = cycle;
  }
  changed_.notify_all();
}

std::optional<RecognisedTruck> RecognitionThread::answer(std::uint64_t cycle) {
  std::unique_lock lock(mutex_);
  if (!open_) return std::nullopt;
  if (lockstep_cycles_ > 0) {
    if (cycle < asked_cycle_ + lockstep_cycles_) return std::nullopt;
    changed_.wait(lock, [this] { return answer_.has_value(); });
  }
  if (!answer_) return std::nullopt;
  open_ = false;
  return std::exchange(answer_, std::nullopt);
}

void RecognitionThread::work() {
  // Of this thread; where it fails the scheduler is merely fairer. In lockstep the loop waits for the answer, and on a busy computer a thread that stands
  // behind all others would keep it waiting until the plant takes the app for dead.
  if (lockstep_cycles_ == 0) ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), behind_the_loop);
  std::unique_lock lock(mutex_);
  runs_ = true;
  changed_.notify_all();
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || question_.has_value(); });
    if (ends_) return;
    const Question question = *std::exchange(question_, std::nullopt);
    const std::uint64_t number = number_;
    lock.unlock();
    RecognisedTruck truck = recognise_truck(question.points, question.viewpoint, ranges_);
    lock.lock();
    if (number != number_) continue;  // a newer question
    answer_ = std::move(truck);
    changed_.notify_all();
  }
}

}  // namespace berm::app
