#include "plant/process/hand_lift.hpp"

#include <algorithm>
#include <numbers>

#include "plant/machine/kinematics.hpp"

namespace berm::plant {

namespace {

constexpr std::size_t kBoom = 1;
constexpr double kRadian = std::numbers::pi / 180;
constexpr double kLooks_s = 3.0;               // nobody near for so long before a lever is touched
constexpr double kRests_s = 1.5;               // until the boom hangs still
constexpr double kLever = 8.0 * kRadian;       // rad/s
constexpr double kAtStop = 1.0 * kRadian;

}  // namespace

HandLift::HandLift(const PlantProfile& profile) : shape_(profile.shape), boom_stop_(profile.dynamics.joint[kBoom].high) {
  height_ = std::max(shape_.scanner[0].position[2], shape_.scanner[1].position[2]);
}

void HandLift::begin(double t) {
  stage_ = Stage::looks;
  since_s_ = t;
  levers_ = {};
}

void HandLift::step(double t, const JointState& joints, bool somebody_near) {
  levers_ = {};
  if (stage_ == Stage::done) return;
  if (somebody_near && stage_ != Stage::rests) {
    stage_ = Stage::looks;
    since_s_ = t;
    return;
  }
  const bool high = bucket_underside(shape_, joints) > height_ || joints.angle[kBoom] > boom_stop_ - kAtStop;
  if (stage_ == Stage::looks && t - since_s_ >= kLooks_s) stage_ = Stage::lifts;
  if (stage_ == Stage::lifts && !high) levers_[kBoom] = kLever;
  if (stage_ == Stage::lifts && high) {
    stage_ = Stage::rests;
    since_s_ = t;
  }
  if (stage_ == Stage::rests && t - since_s_ >= kRests_s) stage_ = Stage::done;
}

}  // namespace berm::plant
