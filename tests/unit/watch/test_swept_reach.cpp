#include <gtest/gtest.h>

#include <cmath>

#include "in_process/draw.hpp"
#include "plant/machine/plant_profile.hpp"
#include "watch/footprint.hpp"
#include "watch/swept_reach.hpp"

namespace berm::watch {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

plant::ImplementShape shape() { return plant::load_plant_profile(BERM_PLANT_PROFILES "/zx200_plant.toml").shape; }

plant::oracle::Body person(double radius, double bearing, double height) {
  return plant::oracle::Body::cylinder({radius * std::cos(bearing), radius * std::sin(bearing), 0.0}, 0.25, height);
}

// Whoever is met at some pose of the box, found by dense sampling of the swing, is held by it; the other joints stand.
TEST(swept_reach, holds_whom_a_dense_sampling_of_the_swing_meets) {
  const SweptReach reach(shape());
  in_process::Draw draw(3, 0);
  int held = 0, missed = 0;
  for (int i = 0; i < 60; ++i) {
    ReachBox box;
    box.low = box.high = {draw.between(-120, 60) * degree, 25 * degree, -75 * degree, -70 * degree};
    box.high[0] = box.low[0] + draw.between(2, 70) * degree;
    const double bearing = draw.between(box.low[0] - 0.5, box.high[0] + 0.5);
    const auto body = person(draw.between(5.0, 8.0), bearing, draw.between(0.5, 2.0));
    double least = 1e9;
    for (double swing = box.low[0]; swing < box.high[0] + 0.25 * degree; swing += 0.25 * degree)
      least = std::min(least, reach.distance({std::min(swing, box.high[0]), box.low[1], box.low[2], box.low[3]}, body));
    const bool holds = reach.holds(box, body);
    if (least <= 0.0) {
      EXPECT_TRUE(holds) << i;
    }
    if (least > 0.03) {
      EXPECT_FALSE(holds) << i << ": " << least;
    }
    (holds ? held : missed)++;
  }
  EXPECT_GT(held, 8);
  EXPECT_GT(missed, 10);
}

TEST(swept_reach, looks_at_the_ends_of_the_arm_too) {
  const SweptReach reach(shape());
  ReachBox box;
  box.low = box.high = {0.0, 45 * degree, -100 * degree, -100 * degree};
  const auto under = person(5.5, 0.0, 1.8);
  EXPECT_FALSE(reach.holds(box, under));
  box.low[1] = 15 * degree;  // the boom may still come down on him
  EXPECT_TRUE(reach.holds(box, under));
}

TEST(swept_reach, whole_turns_do_not_matter) {
  const SweptReach reach(shape());
  ReachBox box;
  box.low = {170 * degree, 25 * degree, -75 * degree, -70 * degree};
  box.high = {200 * degree, 25 * degree, -75 * degree, -70 * degree};
  EXPECT_TRUE(reach.holds(box, person(6.3, -170 * degree, 1.8)));
  EXPECT_FALSE(reach.holds(box, person(6.3, 100 * degree, 1.8)));
}

}  // namespace
}  // namespace berm::watch
