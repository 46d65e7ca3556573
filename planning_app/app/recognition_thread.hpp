// The truck recogniser beside the app's loop, which it never delays: it takes in scanlines as they come, and asks when OngoingRecognition says so. Where time
// is real, what came while it was at work is taken in before it asks again, and the answer is there when it is; in lockstep every scanline has its
// question and the answer is taken in a fixed cycle after it, waiting if it must, so that runs are bit-identical.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "app/truck_finder.hpp"

namespace berm::app {

class RecognitionThread final : public TruckFinder {
public:
  // lockstep_cycles: from a question to its answer; 0 where time is real. Returns when the thread runs, so that a sandbox entered afterwards holds it too.
  RecognitionThread(TruckRangeSet ranges, std::uint64_t lockstep_cycles);
  ~RecognitionThread() override;
  RecognitionThread(const RecognitionThread&) = delete;
  RecognitionThread& operator=(const RecognitionThread&) = delete;

  void begin(const std::array<double, 3>& viewpoint) override;
  void take(std::vector<ScanPoint> scanline, double turned, std::uint64_t cycle) override;
  void end(std::uint64_t cycle) override;
  std::optional<RecognisedTruck> answer(std::uint64_t cycle) override;

private:
  struct Task {
    enum class What { begin, scanline, end } what = What::end;
    std::array<double, 3> viewpoint{};
    std::vector<ScanPoint> scanline;
    double turned = 0.0;
    std::uint64_t cycle = 0;
  };
  struct Answer {
    RecognisedTruck truck;
    std::uint64_t cycle = 0;  // of its question
  };
  void add(Task task);
  void work();
  bool due(std::uint64_t asked, std::uint64_t now) const { return now >= asked + lockstep_cycles_; }

  const TruckRangeSet ranges_;
  const std::uint64_t lockstep_cycles_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool runs_ = false, ends_ = false;
  std::deque<Task> tasks_;          // of the newest sweep
  std::optional<std::uint64_t> at_work_;  // on what was told in this cycle
  std::optional<Answer> answer_;    // of the newest sweep
  bool answered_ = false;           // and it was taken
  std::uint64_t sweep_ = 0;         // the newest one's number
  std::thread thread_;
};

}  // namespace berm::app
