#include "plant/world/foresight.hpp"

#include <algorithm>

namespace berm::plant {

void Foresight::forget() { std::fill(seen_.begin(), seen_.end(), 0); }

Scene& Foresight::begin(const SpinningLidar::Span& span, const BasePose& base, std::size_t lidars) {
  span_ = span;
  base_ = base;
  hits_.resize(lidars);
  seen_.assign(lidars, 0);
  for (auto& of_lidar : hits_) of_lidar.resize(SpinningLidar::firings_a_cycle);
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

void Foresight::compare(const SpinningLidar::Span& span, const BasePose& base, const Scene& scene) {
  if (!(span == span_) || !(base == base_)) return forget();
  difference_ = scene.difference(scene_);
}

}  // namespace berm::plant
