// Stops of a joint that is known exactly: constant speed, dead time, constant deceleration, read every 10 ms.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "identify/stop_record.hpp"

namespace berm::identify::test {

struct IdealStop {
  double speed = 1.0, dead_time = 0.06, deceleration = 2.0;
  std::function<double(int)> speed_noise = [](int) { return 0.0; }, angle_noise = [](int) { return 0.0; };

  static constexpr std::size_t kSent = 40;  // index of the reading that the command answers
  double angle() const { return speed * speed / (2 * deceleration); }
  double time() const { return speed / deceleration; }

  std::vector<Sample> samples() const {
    std::vector<Sample> out;
    for (int i = 0; i < 1500; ++i) {
      const double t = 0.01 * i, braked = std::clamp(t - 0.01 * kSent - dead_time, 0.0, time());
      const double moved = speed * std::min(t, 0.01 * kSent + dead_time) + speed * braked - 0.5 * deceleration * braked * braked;
      out.push_back({t, moved + angle_noise(i), speed - deceleration * braked + speed_noise(i)});
    }
    return out;
  }
};

}  // namespace berm::identify::test
