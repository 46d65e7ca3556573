#include "app/slow_down.hpp"

#include <algorithm>

namespace berm::app {

namespace {

// Who keeps to what is permitted is cut only now and then, when it tries for more: such cuts are one span.
constexpr double span_gap_s = 0.3;

}  // namespace

void SlowDown::step(const Observation& o, const ArmController& arm, double cycle_s, const char* phase, const ProgressLog& log) {
  const Joints share = arm.shares();
  std::size_t most_cut = joints;
  for (std::size_t j = 0; j < joints; ++j)
    if (arm.cut(j) && (most_cut == joints || share[j] < share[most_cut])) most_cut = j;
  if (open_ && (!o.running() || o.time_s - last_s_ > span_gap_s)) end(log);
  if (most_cut == joints) return;
  if (!open_) {
    open_ = true;
    ++spans_;
    from_s_ = last_s_ = o.time_s - cycle_s;
    span_least_ = 1.0;
    span_dust_ = span_learning_ = false;
    log.event("slowed", {{"time_s", from_s_}, {"joint", joint_names[most_cut]}, {"phase", phase}});
  }
  seconds_ += o.time_s - last_s_;
  last_s_ = o.time_s;
  span_dust_ = span_dust_ || o.slowed_by_dust;
  span_learning_ = span_learning_ || o.learns_ground;
  span_least_ = std::min(span_least_, share[most_cut]);
  least_share_ = std::min(least_share_, span_least_);
}

void SlowDown::end(const ProgressLog& log) {
  open_ = false;
  log.event("full_speed", {{"time_s", last_s_}, {"slowed_s", last_s_ - from_s_}, {"least_share", span_least_}, {"dust", span_dust_}, {"learning", span_learning_}});
}

}  // namespace berm::app
