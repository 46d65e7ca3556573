// In the recogniser's place: tells what the test gives it, some cycles after the question.
#pragma once

#include <cstdint>
#include <vector>

#include "app/truck_finder.hpp"
#include "app_bench/bench_machine.hpp"

namespace berm::app_bench {

// The truck of the miniature bench, as a recogniser would tell of it.
inline app::RecognisedTruck bench_truck() {
  const app::TruckBed bed = bench_bed();
  app::RecognisedTruck truck;
  truck.found = true;
  truck.truck_class = "box";
  truck.pose.middle = {bed.centre_x, bed.centre_y, bed.wall_top};
  truck.yaw = truck.pose.yaw = bed.yaw;
  truck.length = truck.pose.length = bed.length;
  truck.width = truck.pose.width = bed.width;
  truck.height = bed.height;
  return truck;
}

class BenchFinder final : public app::TruckFinder {
public:
  void ask(std::vector<app::ScanPoint> points, const std::array<double, 3>& viewpoint, std::uint64_t cycle) override {
    asked.push_back({std::move(points), viewpoint});
    due_ = cycle + cycles;
    open_ = true;
  }
  std::optional<app::RecognisedTruck> answer(std::uint64_t cycle) override {
    if (!open_ || cycle < due_) return std::nullopt;
    open_ = false;
    return truck;
  }

  struct Question {
    std::vector<app::ScanPoint> points;
    std::array<double, 3> viewpoint{};
  };
  std::vector<Question> asked;
  app::RecognisedTruck truck = bench_truck();
  std::uint64_t cycles = 10;

private:
  std::uint64_t due_ = 0;
  bool open_ = false;
};

}  // namespace berm::app_bench
