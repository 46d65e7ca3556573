#include "plant/world/foresight.hpp"

#include <algorithm>

namespace berm::plant {

void Foresight::prepare(const SpinningLidar::Span& span, const BasePose& base, std::size_t lidars) {
  span_ = span;
  base_ = base;
  hits_.resize(lidars);
  seen_.assign(lidars, 0);
  for (auto& of_lidar : hits_) of_lidar.resize(SpinningLidar::firings_a_cycle);
}

Scene& Foresight::begin(const SpinningLidar::Span& span, const BasePose& base, std::size_t lidars) {
  prepare(span, base, lidars);
  return scene_;
}

void Foresight::look(const std::vector<SpinningLidar>& lidars, const std::function<bool()>& enough) {
  constexpr std::size_t asks_every = 8;  // firings of each: about 20 us
  const BaseFrame stand(base_);
  for (std::size_t k = 0; k < SpinningLidar::firings_a_cycle; ++k) {
    if (k % asks_every == 0 && enough()) return;
    for (std::size_t i = 0; i < lidars.size(); ++i)
      if (lidars[i].foresee(span_, k, scene_, stand, hits_[i][k])) seen_[i] = k + 1;
  }
}

void Foresight::compare(const SpinningLidar::Span& span, const BasePose& base, const Scene& scene, std::size_t lidars) {
  if (hits_.size() != lidars || !(span == span_) || !(base == base_)) prepare(span, base, lidars);
  else difference_ = scene.difference(scene_);
  next_ = done_ = 0;
}

void Foresight::complete(const std::vector<SpinningLidar>& lidars, const Scene& scene) {
  constexpr std::size_t takes = 4;  // firings of each: about 10 us
  const BaseFrame stand(base_);
  for (std::size_t first; (first = next_.fetch_add(takes, std::memory_order_relaxed)) < SpinningLidar::firings_a_cycle;) {
    const std::size_t end = std::min(first + takes, SpinningLidar::firings_a_cycle);
    for (std::size_t i = 0; i < lidars.size(); ++i)
      for (std::size_t k = first; k < end; ++k)
        if (k >= seen_[i] || lidars[i].may_meet(span_, k, difference_, stand)) lidars[i].foresee(span_, k, scene, stand, hits_[i][k]);
    done_.fetch_add(end - first, std::memory_order_release);
  }
}

}  // namespace berm::plant
