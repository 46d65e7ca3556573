// In the recogniser's place: tells what the test gives it, some cycles after the question.
#pragma once

#include <algorithm>
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
  void begin(const std::array<double, 3>& viewpoint) override {
    looks.push_back({{}, viewpoint, {}});
    due_.reset();
    answered_ = false;
  }
  void take(std::vector<app::ScanPoint> scanline, double turned, std::uint64_t cycle) override {
    looks.back().turned.push_back(turned);
    std::vector<app::ScanPoint>& points = looks.back().points;
    points.insert(points.end(), scanline.begin(), scanline.end());
    if (!due_ && ++looks.back().scanlines >= stands_after) due_ = cycle + cycles;
  }
  void end(std::uint64_t cycle) override {
    looks.back().ended = true;
    if (!due_) due_ = cycle + cycles;
  }
  std::optional<app::RecognisedTruck> answer(std::uint64_t cycle) override {
    if (answered_ || !due_ || cycle < *due_) return std::nullopt;
    answered_ = true;
    return truck;
  }

  struct Look {
    std::vector<app::ScanPoint> points;
    std::array<double, 3> viewpoint{};
    std::vector<double> turned;  // of each scanline
    std::size_t scanlines = 0;
    bool ended = false;
  };
  std::vector<Look> looks;
  app::RecognisedTruck truck = bench_truck();
  std::uint64_t cycles = 10;
  std::size_t stands_after = 1000000;  // scanlines: the sweep's end

  // Sweeps that were told to their end.
  std::size_t ended() const {
    return static_cast<std::size_t>(std::count_if(looks.begin(), looks.end(), [](const Look& l) { return l.ended; }));
  }

private:
  std::optional<std::uint64_t> due_;
  bool answered_ = false;
};

}  // namespace berm::app_bench
