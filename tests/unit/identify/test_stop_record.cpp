// One stop, from its readings: when it was obeyed, how far it went, when it stood.
#include <gtest/gtest.h>

#include "ideal_stop.hpp"

namespace berm::identify::test {
namespace {

// Bounded, of both signs, the same in every run.
double wobble(int i, double size) { return size * std::sin(12.9898 * i); }

TEST(StopRecord, AnIdealStopIsSeenAsItIs) {
  for (const double dead_time : {0.0, 0.02, 0.06, 0.13}) {
    IdealStop stop;
    stop.dead_time = dead_time;
    const StopRecord r = evaluate_stop({}, stop.samples(), IdealStop::kSent, 0.005);
    EXPECT_NEAR(r.held_speed, 1.0, 1e-12);
    ASSERT_TRUE(r.obeyed_s);
    EXPECT_NEAR(*r.obeyed_s - r.sent_s, dead_time, 1e-9);
    EXPECT_NEAR(r.farthest_angle - angle_at(r, *r.obeyed_s), stop.angle(), 1e-9);
    EXPECT_GE(r.rest_s - *r.obeyed_s, stop.time());
    EXPECT_LE(r.rest_s - *r.obeyed_s, stop.time() + 0.03);
  }
}

// With errors within their bounds the angle and the time stay bounds once the errors are added.
TEST(StopRecord, NoiseNeverMakesAStopShorterThanItsErrorBounds) {
  constexpr double kAngleError = 0.0026, kSpeedError = 0.0052;
  for (int seed = 0; seed < 200; ++seed) {
    IdealStop stop;
    stop.speed = 0.05 + 0.01 * seed;
    stop.deceleration = 0.25 + 0.02 * (seed % 37);
    stop.speed_noise = [seed](int i) { return wobble(i + 1000 * seed, kSpeedError); };
    stop.angle_noise = [seed](int i) { return wobble(3 * i + 700 * seed, kAngleError); };
    const StopRecord r = evaluate_stop({}, stop.samples(), IdealStop::kSent, kSpeedError);
    const double obeyed = r.sent_s + stop.dead_time;
    EXPECT_GE(r.farthest_angle - angle_at(r, obeyed) + 2 * kAngleError, stop.angle()) << "stop " << seed;
    EXPECT_GE(r.rest_s - obeyed, stop.time()) << "stop " << seed;
    if (r.obeyed_s && stop.speed > 0.3) {
      EXPECT_NEAR(*r.obeyed_s - r.sent_s, stop.dead_time, 0.02) << "stop " << seed;
    }
  }
}

TEST(StopRecord, TooFewFallingSpeedsGiveNoMoment) {
  IdealStop stop;
  stop.deceleration = 40.0;
  EXPECT_FALSE(evaluate_stop({}, stop.samples(), IdealStop::kSent, 0.005).obeyed_s);
}

}  // namespace
}  // namespace berm::identify::test
