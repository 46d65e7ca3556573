#include "recognition/arriving_sweep.hpp"

#include <algorithm>
#include <utility>

namespace berm::app {
namespace {

constexpr std::size_t kReturnsExpected = 40000;  // of a sweep

}  // namespace

ArrivingSweep::ArrivingSweep(const std::array<double, 3>& viewpoint) : head_(viewpoint[0], viewpoint[1], viewpoint[2]) {
  whole_.returns.reserve(kReturnsExpected);
  whole_.directions.reserve(kReturnsExpected);
}

void ArrivingSweep::Thinned::take(const FanSweep& whole, std::size_t fan) {
  append_thinned(sweep, whole, fan);
  std::vector<UprightSegment> segments;
  upright_segments(sweep, sweep.heads.size() - 1, segments);
  for (const UprightSegment& s : segments) growth.take(s);
}

ArrivingSweep::Thinned ArrivingSweep::thin(const FanSweep& whole, std::size_t stride) {
  Thinned out;
  out.sweep.returns.reserve(kReturnsExpected / stride);
  out.sweep.directions.reserve(kReturnsExpected / stride);
  for (std::size_t fan = 0; fan < whole.heads.size(); fan += stride) out.take(whole, fan);
  return out;
}

void ArrivingSweep::take(std::span<const ScanPoint> scanline, double turned) {
  auto plane = append_fan(whole_, scanline, head_turned(head_, turned));
  if (!plane) return;
  plane->turned = turned;
  if (!planes_.empty()) {
    const double step = turn_between(planes_.back(), *plane);
    steps_.insert(std::upper_bound(steps_.begin(), steps_.end(), std::abs(step)), std::abs(step));
    turned_ += step;
  }
  planes_.push_back(*plane);
  if (!steps_.empty()) whole_.step = steps_[steps_.size() / 2];
  const std::size_t stride = thinning(whole_.step), fan = planes_.size() - 1;
  if (stride != stride_) {
    stride_ = stride;
    if (std::exchange(swung_, false)) place_heads(whole_, planes_, head_, {});
    thinned_ = thin(whole_, stride_);
  } else if (fan % stride_ == 0) {
    thinned_.take(whole_, fan);
  }
}

bool ArrivingSweep::passed(const Eigen::Vector2d& at) const {
  if (planes_.empty()) return false;
  const FanPlane& newest = planes_.back();
  const Eigen::Vector3d head = head_turned(head_, newest.turned);
  const bool ahead = newest.normal.y() * (at.x() - head.x()) - newest.normal.x() * (at.y() - head.y()) > 0.0;  // where the normal is to the left of the fan
  const double to_left = (ahead ? 1.0 : -1.0) * (newest.normal.dot(at) - newest.offset);
  return turned_ * to_left < 0.0;
}

bool ArrivingSweep::wall_pauses(double length) const {
  return !thinned_.sweep.heads.empty() && thinned_.growth.pauses(thinned_.sweep.heads.size() - 1, length);
}

ArrivingSweep::View ArrivingSweep::view() {
  const SwingOfHead swing = swing_of_head(planes_, head_);
  if (!swing.reason.empty()) return {swing.reason, whole_, thinned_.sweep, {}};
  const bool stands = swing.stands();
  if (!stands || swung_) place_heads(whole_, planes_, head_, swing);
  swung_ = !stands;
  if (!stands) swung_thinned_ = thin(whole_, stride_);
  Thinned& thinned = stands ? thinned_ : swung_thinned_;
  whole_.swing_rate = thinned.sweep.swing_rate = swing.rate;
  thinned.sweep.step = static_cast<double>(stride_) * whole_.step;
  return {{}, whole_, thinned.sweep, thinned.growth.regions(thinned.sweep)};
}

}  // namespace berm::app
