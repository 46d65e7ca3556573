#include "supervised_machine.hpp"

#include <algorithm>
#include <cmath>

namespace berm::core_test {

namespace {

constexpr double kStep_s = 1e-3;
constexpr std::size_t kPast = 201;

}  // namespace

void SupervisedMachine::note() {
  past_.push_back({angle_, speed_});
  if (past_.size() > kPast) past_.pop_front();
}

// Exactly v^2 / 2a, however the steps fall.
void SupervisedMachine::slow(double to) {
  const double sign = speed_ < 0.0 ? -1.0 : 1.0;
  const double lost = std::min(std::abs(speed_) - to, make_.deceleration * kStep_s);
  const double duration = lost / make_.deceleration;
  const double after = speed_ - sign * lost;
  angle_ += 0.5 * (speed_ + after) * duration + after * (kStep_s - duration);
  speed_ = after;
}

void SupervisedMachine::move(double target) {
  if (speed_ != 0.0 && (target == 0.0 || speed_ * target < 0.0)) {
    slow(0.0);
  } else if (std::abs(speed_) > std::abs(target)) {
    slow(std::abs(target));
  } else {
    const double before = speed_;
    speed_ += std::clamp(target - speed_, -make_.acceleration * kStep_s, make_.acceleration * kStep_s);
    angle_ += 0.5 * (before + speed_) * kStep_s;
  }
}

void SupervisedMachine::run_to(std::int64_t now_us, double follow_error) {
  while (now_us_ < now_us) {
    while (!pending_.empty() && pending_.front().due_us <= now_us_) {
      obeyed_ = pending_.front().velocity;
      pending_.pop_front();
    }
    const double missed = obeyed_ == 0.0 ? 0.0 : follow_error * make_.velocity_error;
    const double target = obeyed_ + missed;
    move(target * obeyed_ > 0.0 ? target : 0.0);
    now_us_ += kStepUs;
    note();
  }
}

SupervisedMachine::State SupervisedMachine::before(std::int64_t age_us) const {
  const auto back = static_cast<std::size_t>(age_us / kStepUs);
  return past_[past_.size() - 1 - std::min(back, past_.size() - 1)];
}

}  // namespace berm::core_test
