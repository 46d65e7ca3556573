// Slips of drawn direction and size over drawn terrain are found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "watch.hpp"

namespace berm::registration_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSettled_s = 25.0;  // by then every shift has been excluded often enough
constexpr double kFound_s = 12.0;    // at the latest, after the slip: more than one sweep of the site's scanner

// Seconds from the slip until it was found.
double slip(const SiteConfig& config, std::uint64_t seed, double length_m) {
  Watch watch(config, seed);
  watch.run(kSettled_s);
  EXPECT_LT(watch.found_s, 0) << again(seed) << ": found before the slip";
  EXPECT_GE(watch.registration->confirmed_us(), 0) << again(seed) << ": not watched yet";
  const double heading = draw(watch.site, 0, 2 * kPi);
  watch.site.base_x = length_m * std::cos(heading);
  watch.site.base_y = length_m * std::sin(heading);
  watch.run(kSettled_s + kFound_s, {}, true);
  EXPECT_GE(watch.found_s, 0) << again(seed) << ": a slip of " << length_m << " m, heading " << heading * 180 / kPi << " degrees, is not found";
  return watch.found_s - kSettled_s;
}

void slips(const char* what, const SiteConfig& config, double low_m, double high_m) {
  const Seeds s = seeds(12);
  std::vector<double> after;
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    std::mt19937_64 random(seed * 7919);
    after.push_back(slip(config, seed, std::uniform_real_distribution<double>(low_m, high_m)(random)));
  }
  std::sort(after.begin(), after.end());
  std::cout << what << ", " << low_m << " to " << high_m << " m, seeds from " << s.first << ": found after " << after.front() << " to " << after.back() << " s, median "
            << after[after.size() / 2] << " s\n";
}

// verifies: SK-BM-20, SK-BM-22
TEST(Slips, OfThirtyCentimetresAndMoreAreFound) { slips("bench of 20 mm relief", {}, 0.30, 0.50); }

// verifies: SK-BM-20
TEST(Slips, OfUpToTheLargestShiftAreFound) { slips("bench of 20 mm relief", {}, 0.50, 1.15); }

// verifies: SK-BM-20
TEST(Slips, AreFoundByTheReliefAlone) {
  SiteConfig config;
  config.edges = false;
  slips("level ground of 20 mm relief", config, 0.30, 1.0);
}

// verifies: SK-BM-20
TEST(Slips, SettlingIsFound) {
  const Seeds s = seeds(6);
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    for (const double rise_m : {-0.15, 0.15}) {
      Watch watch({}, seed);
      watch.run(kSettled_s);
      watch.site.base_z = rise_m;
      watch.run(kSettled_s + kFound_s, {}, true);
      EXPECT_GE(watch.found_s, kSettled_s) << again(seed) << ": " << rise_m << " m";
    }
  }
}

// The reference does not follow: what is seen while a shift is leant to is not learned. A slip in small steps adds up and is found.
// verifies: SK-BM-21
TEST(Slips, CreepingAddsUp) {
  const Seeds s = seeds(4);
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    Watch watch({}, seed);
    watch.run(kSettled_s);
    const auto creep = [&](double now_s) { watch.site.base_x = 0.005 * std::floor(now_s - kSettled_s); };  // 5 mm a second
    watch.run(kSettled_s + 100.0, creep, true);
    EXPECT_GE(watch.found_s, kSettled_s) << again(seed);
    EXPECT_LT(watch.site.base_x, 0.45) << again(seed);
  }
}

// verifies: SK-BM-24
TEST(Slips, ABeginningForgetsAndLearnsAnew) {
  Watch watch({}, 3);
  watch.run(kSettled_s);
  watch.site.base_x = 0.6;
  watch.run(kSettled_s + kFound_s, {}, true);
  ASSERT_TRUE(watch.registration->slipped());
  watch.registration->begin();
  EXPECT_FALSE(watch.registration->slipped());
  EXPECT_EQ(watch.registration->confirmed_us(), -1);
  watch.found_s = -1;
  const double begun_s = watch.now_s();
  watch.run(begun_s + kSettled_s);
  EXPECT_LT(watch.found_s, 0) << "the new place is the reference";
  EXPECT_GE(watch.registration->confirmed_us(), 0);
  watch.site.base_x = 0.0;
  watch.run(begun_s + kSettled_s + kFound_s, {}, true);
  EXPECT_GE(watch.found_s, 0) << "slipping back is a slip";
}

}  // namespace
}  // namespace berm::registration_test
