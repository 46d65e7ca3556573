// The rays of the lidars' next step, worked out while others are waited for: as they will be if the machine goes on as it does now. What came
// otherwise, in the machine's motion or the site, is found by comparison, and looked at again where it may be met, with what was not reached: by as many
// threads as there are, each taking what none has begun. The step's results are the same to the last bit.
#pragma once

#include <atomic>
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
  // The step as it came. Nothing foreseen is left when the machine moved otherwise.
  void compare(const SpinningLidar::Span& span, const BasePose& base, const Scene& scene, std::size_t lidars);
  // What is still to be looked at of it, in the scene as it came; any number of threads at a time. Ends when nothing is left to begin.
  void complete(const std::vector<SpinningLidar>& lidars, const Scene& scene);
  // Whether all threads have ended what they began: from then on hits() may be asked for.
  [[nodiscard]] bool completed() const { return done_.load(std::memory_order_acquire) >= SpinningLidar::firings_a_cycle; }
  // Of the step as it came, firing by firing.
  [[nodiscard]] std::span<const SpinningLidar::Hits> hits(std::size_t lidar) const {
    return lidar < hits_.size() ? std::span<const SpinningLidar::Hits>(hits_[lidar]) : std::span<const SpinningLidar::Hits>();
  }
  // hits() are of no step any more.
  void forget() { hits_.clear(); }

 private:
  void prepare(const SpinningLidar::Span& span, const BasePose& base, std::size_t lidars);

  SpinningLidar::Span span_{};
  BasePose base_;
  Scene scene_;
  std::vector<std::vector<SpinningLidar::Hits>> hits_;  // by lidar, of each firing that a cycle may have
  std::vector<std::size_t> seen_;                       // of them, before the step
  SceneDifference difference_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;        // firings, of all lidars: begun, and ended, since compare()
};

}  // namespace berm::plant
