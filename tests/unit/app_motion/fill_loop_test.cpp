// verifies how a dig's path is left for what the force says is in the bucket.
#include "motion/fill_loop.hpp"

#include <gtest/gtest.h>

#include "motion/angles.hpp"

namespace berm::app {
namespace {

constexpr double cycle = 0.01, far_down = -2.0;

// m over the path after so many seconds.
double lift_after(const FillSeen& seen, double seconds, double to_floor = far_down, double now = 0.0) {
  for (double t = 0.0; t < seconds - 0.5 * cycle; t += cycle) now = lift_for(seen, now, to_floor, cycle);
  return now;
}

TEST(FillLoop, GoesDeeperWhereTheFillLagsBehindThePlan) {
  EXPECT_NEAR(lift_after({0.2, 0.6}, 0.5), -0.8 * 0.5 * 0.5, 1e-9) << "half of what the force says, at 0.8 m/s for a whole bucket";
  EXPECT_NEAR(lift_after({0.0, 1.0}, 0.5), -0.25, 1e-9) << "no faster than half a metre a second";
  EXPECT_NEAR(lift_after({0.0, 1.0}, 5.0), -0.5, 1e-9) << "no deeper than half a metre";
  EXPECT_EQ(lift_after({0.0, 0.0}, 1.0), 0.0) << "not before the soil";
}

TEST(FillLoop, ComesBackToThePathWhenTheBucketFillsAndNotOverIt) {
  EXPECT_NEAR(lift_after({1.0, 0.3}, 0.5, far_down, -0.3), -0.3 + 0.8 * 0.2 * 0.5, 1e-9);
  EXPECT_EQ(lift_after({1.0, 0.1}, 5.0, far_down, -0.3), 0.0);
}

TEST(FillLoop, StaysOverTheFloorThoughThePathDoesNot) {
  EXPECT_NEAR(lift_after({0.0, 1.0}, 5.0, -0.1), -0.1, 1e-9);
  EXPECT_NEAR(lift_after({0.0, 1.0}, 5.0, 0.07), 0.07, 1e-9);
}

TEST(FillLoop, CurlsAsTheBucketFills) {
  const double on_path = radians(-100.0);
  const auto curled_to = [&](double share) {
    double now = 0.0;
    for (int k = 0; k < 300; ++k) now = curl_for({share, 0.5}, now, on_path, cycle);
    return degrees(now);
  };
  EXPECT_EQ(curled_to(0.4), 0.0) << "not before four tenths of the goal";
  EXPECT_NEAR(curled_to(0.7), -123.5, 0.1);
  EXPECT_NEAR(curled_to(1.0), -152.0, 0.1);
  EXPECT_NEAR(degrees(curl_for({1.0, 0.5}, 0.0, on_path, cycle)), -100.45, 0.01) << "from the path's attitude on, at 45 degrees a second";
}

}  // namespace
}  // namespace berm::app
