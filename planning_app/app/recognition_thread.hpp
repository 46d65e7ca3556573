// The truck recogniser beside the app's loop, which it never delays. Where time is real the answer is taken when it is there; in lockstep in a fixed
// cycle after the question, waiting for it if it must, so that runs are bit-identical.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/truck_finder.hpp"

namespace berm::app {

class RecognitionThread final : public TruckFinder {
public:
  // lockstep_cycles: from question to answer; 0 where time is real. Returns when the thread runs, so that a sandbox entered afterwards holds it too.
  RecognitionThread(TruckRangeSet ranges, std::uint64_t lockstep_cycles);
  ~RecognitionThread() override;
  RecognitionThread(const RecognitionThread&) = delete;
  RecognitionThread& operator=(const RecognitionThread&) = delete;

  void ask(std::vector<ScanPoint> points, const std::array<double, 3>& viewpoint, std::uint64_t cycle) override;
  std::optional<RecognisedTruck> answer(std::uint64_t cycle) override;

private:
  struct Question {
    std::vector<ScanPoint> points;
    std::array<double, 3> viewpoint{};
  };
  void work();

  const TruckRangeSet ranges_;
  const std::uint64_t lockstep_cycles_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool runs_ = false, ends_ = false;
  std::optional<Question> question_;
  std::optional<RecognisedTruck> answer_;
  std::uint64_t number_ = 0;  // of the newest question
  bool open_ = false;
  std::uint64_t asked_cycle_ = 0;
  std::thread thread_;
};

}  // namespace berm::app
