#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "identify/acceleration.hpp"

namespace berm::identify::test {
namespace {

template <class Speed>
std::vector<double> series(int count, Speed speed) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(speed(0.01 * i));
  return out;
}

TEST(Acceleration, ARampIsItsSlope) {
  const auto v = series(100, [](double t) { return std::min(0.6, t); });
  for (const std::size_t window : {5u, 12u, 30u}) EXPECT_NEAR(steepest(v, window, 0.005), 1.0, 1e-9) << window;
}

TEST(Acceleration, BrakingIsNone) {
  EXPECT_LE(steepest(series(100, [](double t) { return std::max(0.0, 0.8 - 5 * t); }), 10, 0.005), 1e-9);
  EXPECT_LE(steepest(series(100, [](double t) { return std::min(0.0, -0.8 + 5 * t); }), 10, 0.005), 1e-9) << "of a motion the other way, either";
}

// Braked at 5 rad/s2 and sent the other way at 5: the speed gained in that way counts, over the whole window.
TEST(Acceleration, AMotionThatTurnsRoundAtOnceCounts) {
  EXPECT_NEAR(steepest(series(60, [](double t) { return std::min(0.5, 5 * t - 0.5); }), 10, 0.005), 5.0, 1e-6);
}

TEST(Acceleration, AShorterWindowSeesAShorterPeak) {
  const auto v = series(100, [](double t) { return t < 0.5 ? 0.0 : 0.1; });
  EXPECT_GT(steepest(v, 5, 0.005), 1.5 * steepest(v, 10, 0.005));
  EXPECT_GT(steepest(v, 10, 0.005), 1.5 * steepest(v, 20, 0.005));
}

TEST(Acceleration, RunsAreAveragedAsFarAsTheShortestGoes) {
  const Speeds a{0.0f, 1.0f, 2.0f}, b{1.0f, 2.0f, 3.0f, 4.0f};
  EXPECT_EQ(mean_speeds({&a, &b}), (std::vector<double>{0.5, 1.5, 2.5}));
  EXPECT_TRUE(mean_speeds({}).empty());
  EXPECT_EQ(steepest({}, 10, 0.0), 0.0);
}

}  // namespace
}  // namespace berm::identify::test
