// Joints with sound sensors, and with an angle's sensor that stands still, against the agreement. A failure prints its seed (RC_PARAMS="seed=..." repeats it).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "contract/berm_contract.h"
#include "core/joint_agreement.h"
#include "draw.hpp"
#include "reach_parameters.hpp"

namespace berm::core_test {
namespace {

constexpr int kJoint = 2;
constexpr std::int64_t kStep = 1'000;  // us of the true motion

struct State { double angle, speed; };

// A joint that speeds up within acceleration_max and may stop in an instant, as one that meets a stone; sensors of one moment, which arrive late, in order.
class Joint {
 public:
  explicit Joint(berm_parameters& p) : p_(p) {
    p.state_latency_us = static_cast<std::int32_t>(1'000 * draw(0, 40));
    p.velocity_error_urad_s[kJoint] = draw(0, 8'000);
    p.angle_error_urad[kJoint] = draw(0, 4'000);
    p.acceleration_max_urad_s2[kJoint] = draw(200'000, 5'000'000);
    past_.push_back({0.0, 0.0});
  }
  void run_to(std::int64_t now_us, double wanted) {
    const double change = p_.acceleration_max_urad_s2[kJoint] * 1e-6 * kStep;
    while (static_cast<std::int64_t>(past_.size() - 1) * kStep < now_us) {
      State s = past_.back();
      s.speed = std::abs(wanted) < std::abs(s.speed) && at_once_ ? wanted : s.speed + std::clamp(wanted - s.speed, -change, change);
      s.angle += s.speed * 1e-6 * kStep;
      past_.push_back(s);
    }
  }
  void stop_at_once(bool yes) { at_once_ = yes; }
  const State& now() const { return past_.back(); }
  sk_agreement_reading read(std::int64_t now_us, std::int64_t since_us) {
    const std::int64_t oldest = std::min<std::int64_t>(age_us_ + since_us, p_.state_latency_us);  // none overtakes another
    age_us_ = 1'000 * draw<std::int64_t>(0, oldest / 1'000);
    const State s = past_[static_cast<std::size_t>(std::max<std::int64_t>(0, now_us - age_us_) / kStep)];
    const auto error = [](double most) { return chance(20) ? (chance(50) ? most : -most) : most * draw(-1'000, 1'000) / 1'000.0; };
    return {now_us, kJoint, static_cast<std::int32_t>(s.angle + error(p_.angle_error_urad[kJoint] - 1)),
            static_cast<std::int32_t>(s.speed + error(p_.velocity_error_urad_s[kJoint] - 1)), p_.state_latency_us};
  }

 private:
  const berm_parameters& p_;
  std::vector<State> past_;
  std::int64_t age_us_ = 0;
  bool at_once_ = false;
};

// verifies: SK-MS-14
TEST(JointAgreementProperty, SoundSensorsNeverDisagree) {
  int readings = 0;
  const bool passed = rc::check([&] {
    berm_parameters p = reach_parameters();
    Joint joint(p);
    sk_agreement span;
    sk_agreement_begin(&span);
    double wanted = 0.0;
    std::int64_t change_us = 100'000, last_us = 0;
    for (std::int64_t now = 10'000; now < 6'000'000; now += 10'000) {
      joint.run_to(now, wanted);
      if (std::abs(joint.now().angle) > SK_REACH_ANGLE_MAX_URAD - 100'000) break;
      if (!chance(10)) {  // else lost
        const sk_agreement_reading r = joint.read(now, now - last_us);
        last_us = now;
        const std::int32_t result = sk_agreement_step(&span, &p, r);
        ++readings;
        if (result != BERM_STOP_NONE) RC_LOG() << "at " << now << " us: " << result << ", true speed " << joint.now().speed;
        RC_ASSERT(result == BERM_STOP_NONE);
      }
      if (now >= change_us) {
        wanted = chance(40) ? 0.0 : draw(-1'500'000, 1'500'000);
        joint.stop_at_once(chance(30));
        change_us = now + 10'000 * draw(1, 100);
      }
    }
  });
  EXPECT_TRUE(passed);
  std::cout << readings << " readings of sound sensors, no disagreement\n";
  EXPECT_GT(readings, 10'000);
}

// What may pass in a whole span at an even speed, and thus twice as much at most between the end of one and the next.
double allowed_urad(const berm_parameters& p, double speed) {
  const double latency_s = p.state_latency_us * 1e-6, error = p.velocity_error_urad_s[kJoint], span_s = 1e-6 * (SK_AGREE_SPAN_US + 10'000);
  return 2.0 * p.angle_error_urad[kJoint] + span_s * (3.0 * error + 0.25 * p.acceleration_max_urad_s2[kJoint] * (0.01 + latency_s)) +  // noise: changes of 2 e each
         2.0 * latency_s * (2.0 * speed + 2.0 * error + 2.0 * error * SK_AGREE_SPAN_US / 10'000);
}

// verifies: SK-MS-15
TEST(JointAgreementProperty, AnAngleThatStandsIsFoundBeforeTheJointHasGoneTwiceWhatErrorsAllow) {
  int found = 0;
  double farthest = 0.0, slowest = 1e9;
  const bool passed = rc::check([&] {
    berm_parameters p = reach_parameters();
    Joint joint(p);
    const double speed = draw(20'000, 1'500'000);
    const double allowed = allowed_urad(p, speed), gap = speed * 0.02;
    RC_PRE(speed * 1e-6 * SK_AGREE_SPAN_US > allowed + gap);
    sk_agreement span;
    sk_agreement_begin(&span);
    const std::int64_t stuck_us = 10'000 * draw(200, 260);  // the joint has its speed by then, and a span is anywhere
    std::int32_t stuck_urad = 0;
    double from = 0.0;
    std::int64_t now = 10'000;
    for (; now < 6'000'000; now += 10'000) {
      const double most = SK_REACH_ANGLE_MAX_URAD - 100'000;
      joint.run_to(now, now < 1'000'000 ? 0.0 : speed);
      if (std::abs(joint.now().angle) > most) break;
      sk_agreement_reading r = joint.read(now, 10'000);
      if (now < stuck_us) {
        stuck_urad = r.angle_urad;
        from = joint.now().angle;
      }
      r.angle_urad = stuck_urad;
      if (sk_agreement_step(&span, &p, r) == BERM_STOP_STATE_FRAME) break;
    }
    RC_PRE(joint.now().speed > 0.99 * speed);
    const double way = joint.now().angle - from;
    ++found;
    slowest = std::min(slowest, speed);
    farthest = std::max(farthest, way / (2.0 * allowed + gap));
    RC_ASSERT(now >= stuck_us);
    RC_ASSERT(way <= 2.0 * allowed + gap + speed * 1e-6 * p.state_latency_us);
  });
  EXPECT_TRUE(passed);
  std::cout << found << " angles that stood were found, down to " << slowest << " urad/s; at most " << farthest << " of the bound had been gone\n";
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace berm::core_test
