// The rays of the lidars' next step, worked out while others are waited for: as they will be if the machine goes on as it does now. What came
// otherwise, in the machine's motion or the site, is found by comparison, and looked at again where it may be met: the step's results are the same to
// the last bit.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "plant/world/base_pose.hpp"
#include "plant/world/scene.hpp"
#include "plant/world/spinning_lidar.hpp"

namespace berm::plant {

class Foresight {
 public:
  // The scene to be filled with what is expected of the step.
  Scene& begin(const SpinningLidar::Span& span, const BasePose& base, std::size_t lidars);
  // Firing after firing, of all lidars alike, until all are seen or it is enough, which is asked again and again. Reads lidars and scene alone.
  void look(const std::vector<SpinningLidar>& lidars, const std::function<bool()>& enough);
  // The step as it came; from now on hits() are of it. Nothing foreseen is left when the machine moved otherwise.
  void compare(const SpinningLidar::Span& span, const BasePose& base, const Scene& scene);
  [[nodiscard]] SpinningLidar::Foreseen hits(std::size_t lidar) const {
    if (lidar >= seen_.size()) return {{}, difference_};
    return {std::span(hits_[lidar]).first(seen_[lidar]), difference_};
  }
  void forget();

 private:
  SpinningLidar::Span span_{};
  BasePose base_;
  Scene scene_;
  std::vector<std::vector<SpinningLidar::Hits>> hits_;  // by lidar
  std::vector<std::size_t> seen_;                       // of them
  SceneDifference difference_;
};

}  // namespace berm::plant
