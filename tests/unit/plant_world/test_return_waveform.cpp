#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "plant/world/return_waveform.hpp"

namespace berm::plant {
namespace {

double highest(const ReturnWaveform& w, double from, double to) {
  const auto begin = w.level().begin();
  return *std::max_element(begin + static_cast<std::ptrdiff_t>(w.index(from)), begin + static_cast<std::ptrdiff_t>(std::min(w.index(to), w.level().size())));
}

double area(const ReturnWaveform& w, double from, double to) {
  const auto begin = w.level().begin();
  return std::accumulate(begin + static_cast<std::ptrdiff_t>(w.index(from)), begin + static_cast<std::ptrdiff_t>(std::min(w.index(to), w.level().size())), 0.0);
}

double target_height(double range, double reflectivity, const std::vector<CloudSpan>& clouds = {}, double window = 100.0, double cosine = 1.0) {
  ReturnWaveform w;
  w.sample({window, clouds, HardTarget{range, reflectivity, cosine}}, std::nullopt);
  return highest(w, range - 0.5, range + 1.0);
}

// A whole number of samples, so that two targets are met by samples at the same places of their pulses.
double whole(double range) {
  const double step = ReturnWaveform().step_m();
  return std::round(range / step) * step;
}

TEST(ReturnWaveform, ATargetsEchoFallsWithTheSquareOfItsRangeAndWithItsReflectivity) {
  const double near = whole(15.0), far = whole(45.0);
  EXPECT_NEAR(target_height(near, 0.3) / target_height(far, 0.3), (far * far + 1) / (near * near + 1), 1e-3);
  EXPECT_NEAR(target_height(near, 0.4) / target_height(near, 0.1), 4.0, 1e-6);
  const double at = whole(60.0);
  EXPECT_NEAR(target_height(at, 0.1), 12.0, 1.5) << "less what the receiver's pole takes off the peak";
  EXPECT_LT(target_height(at, 0.1), 12.0);
}

TEST(ReturnWaveform, DustTakesLightByBeerAndLambertThereAndBack) {
  const double at = whole(14.0), clear = target_height(at, 0.2);
  for (const double extinction : {0.05, 0.3, 1.0}) {
    EXPECT_NEAR(target_height(at, 0.2, {{5.0, 7.5, extinction}}) / clear, std::exp(-2 * 2.5 * extinction), 1e-6) << extinction;
  }
  EXPECT_NEAR(target_height(at, 0.2, {{5.0, 7.0, 0.2}, {6.0, 8.0, 0.3}}) / clear, std::exp(-2 * (0.4 + 0.6)), 1e-6) << "clouds add up";
  EXPECT_NEAR(target_height(at, 0.2, {{at + 0.1, at + 5.0, 1.0}}), clear, 1e-9) << "nothing comes back from behind the target";
}

TEST(ReturnWaveform, ThinDustSendsBackWhatItsExtinctionAndTheRatioSay) {
  const PulseLidar lidar;
  ReturnWaveform w(lidar);
  w.sample({100.0, {{20.0, 40.0, 1e-3}}, std::nullopt}, std::nullopt);
  const double metres = 0.299792458 / 2 * lidar.pulse_fwhm_ns * std::sqrt(std::numbers::pi / (4 * std::log(2.0)));  // of a Gaussian: area over peak
  for (const double at : {24.0, 30.0, 36.0}) {
    const double wanted = lidar.strength * std::numbers::pi * 1e-3 / lidar.dust_ratio_sr * metres / (at * at + 1) * std::exp(-2e-3 * (at - 20));
    EXPECT_NEAR(w.level()[w.index(at)] / wanted, 1.0, 0.02) << at;
  }
  EXPECT_LT(highest(w, 10.0, 18.5), 1e-6);
}

TEST(ReturnWaveform, AWindowTakesLightTwiceAndSendsSomeBack) {
  const double at = whole(12.0);
  EXPECT_NEAR(target_height(at, 0.3, {}, 50.0) / target_height(at, 0.3), 0.25, 1e-6);
  ReturnWaveform w;
  double before = 0.0;
  for (const double percent : {100.0, 90.0, 50.0, 0.0}) {
    w.sample({percent, {}, std::nullopt}, std::nullopt);
    const double height = highest(w, -1.0, 1.0);
    EXPECT_GT(height, before) << percent;
    EXPECT_LT(height, w.lidar().ceiling);
    before = height;
  }
}

TEST(ReturnWaveform, AnObliqueFaceMakesThePulseLongerAndNotStronger) {
  ReturnWaveform w;
  const double at = whole(45.0), cosine = std::cos(75 * std::numbers::pi / 180);
  w.sample({100.0, {}, HardTarget{at, 0.5, 1.0}}, std::nullopt);
  const double square = area(w, at - 2, at + 3), square_height = highest(w, at - 2, at + 3);
  w.sample({100.0, {}, HardTarget{at, 0.5, cosine}}, std::nullopt);
  EXPECT_NEAR(area(w, at - 2, at + 3) / square, cosine, 1e-3);
  EXPECT_LT(highest(w, at - 2, at + 3) / square_height, 0.95 * cosine);
}

TEST(ReturnWaveform, ReachesTheCeilingAndNoHigher) {
  ReturnWaveform w;
  w.sample({100.0, {}, HardTarget{2.0, 0.9, 1.0}}, 7);
  EXPECT_EQ(highest(w, 1.0, 3.0), w.lidar().ceiling);
}

TEST(ReturnWaveform, NoiseIsOneUnitAndItsSeedsOwn) {
  ReturnWaveform a, b;
  double sum = 0, sum2 = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    a.sample({100.0, {}, HardTarget{40.0, 0.1, 1.0}}, seed);
    for (std::size_t i = a.index(3.0); i < a.index(38.0); ++i, ++n) sum += a.level()[i], sum2 += a.level()[i] * a.level()[i];
  }
  EXPECT_NEAR(sum / n, 0.0, 0.02);
  EXPECT_NEAR(sum2 / n, 1.0, 0.02);
  a.sample({100.0, {}, HardTarget{20.0, 0.1, 1.0}}, 5);
  b.sample({100.0, {}, HardTarget{30.0, 0.1, 1.0}}, 5);
  EXPECT_EQ(a.level()[a.index(10.0)], b.level()[b.index(10.0)]);
  b.sample({100.0, {}, HardTarget{20.0, 0.1, 1.0}}, 6);
  EXPECT_NE(a.level()[a.index(10.0)], b.level()[b.index(10.0)]);
}

}  // namespace
}  // namespace berm::plant
