#include "app/recognition_thread.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "recognition/ongoing_recognition.hpp"

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

void RecognitionThread::add(Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (task.what == Task::What::begin) {
      tasks_.clear();
      answer_.reset();
      answered_ = false;
      ++sweep_;
    }
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

void RecognitionThread::begin(const std::array<double, 3>& viewpoint) { add({Task::What::begin, viewpoint, {}, 0.0, 0}); }
void RecognitionThread::take(std::vector<ScanPoint> scanline, double turned, std::uint64_t cycle) { add({Task::What::scanline, {}, std::move(scanline), turned, cycle}); }
void RecognitionThread::end(std::uint64_t cycle) { add({Task::What::end, {}, {}, 0.0, cycle}); }

std::optional<RecognisedTruck> RecognitionThread::answer(std::uint64_t cycle) {
  std::unique_lock lock(mutex_);
  if (answered_) return std::nullopt;
  if (lockstep_cycles_ > 0) {
    // Whatever is due now has been worked on when there is an answer, or nothing that is due is left.
    changed_.wait(lock, [&] { return answer_ || !((at_work_ && due(*at_work_, cycle)) || (!tasks_.empty() && due(tasks_.front().cycle, cycle))); });
  }
  if (!answer_ || !due(answer_->cycle, cycle)) return std::nullopt;
  answered_ = true;
  tasks_.clear();
  return std::move(answer_->truck);
}

void RecognitionThread::work() {
  // Of this thread; where it fails the scheduler is merely fairer. In lockstep the loop waits for the answer, and on a busy computer a thread that stands
  // behind all others would keep it waiting until the plant takes the app for dead.
  if (lockstep_cycles_ == 0) ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), behind_the_loop);
  std::optional<OngoingRecognition> recognition;
  bool asks = false;  // since the last question
  std::unique_lock lock(mutex_);
  runs_ = true;
  changed_.notify_all();
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
    if (ends_) return;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    const std::uint64_t sweep = sweep_;
    const bool catches_up = lockstep_cycles_ == 0 && !tasks_.empty();
    if (answer_) continue;  // it stands
    at_work_ = task.cycle;
    lock.unlock();
    std::optional<Answer> answer;
    switch (task.what) {
      case Task::What::begin:
        recognition.emplace(task.viewpoint, ranges_);
        asks = false;
        break;
      case Task::What::scanline:
        asks = recognition->take(task.scanline, task.turned) || asks;
        if (!asks || catches_up) break;
        asks = false;
        if (const RecognisedTruck& truck = recognition->ask(); recognition->stands()) answer = Answer{truck, task.cycle};
        break;
      case Task::What::end: answer = Answer{recognition->ask(), task.cycle}; break;
    }
    const bool done = answer.has_value();
    lock.lock();
    at_work_.reset();
    if (sweep == sweep_ && !answered_) answer_ = std::move(answer);
    changed_.notify_all();
    if (!done) continue;
    // What a truck took is given back: left to itself the allocator keeps it in this thread's arena, and the arena grew with the largest of the trucks.
    lock.unlock();
    recognition.reset();
    malloc_trim(0);
    lock.lock();
  }
}

}  // namespace berm::app
