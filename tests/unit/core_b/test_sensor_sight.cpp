// What a sensor can see: blocked strips, the dust level, and what the dust asks for; and all of it against a reference written otherwise.
#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <vector>

#include "core/sensor_sight.h"

namespace berm::core_test {
namespace {

constexpr std::int32_t kHalf = 500;
constexpr sk_dust_rules kRules = {100, 300, 3'000'000};

sk_eye begun() {
  sk_eye eye;
  sk_eye_begin(&eye);
  return eye;
}

void rays(sk_eye& eye, std::int32_t strip, int count, int blind, std::int32_t limit = kHalf) {
  for (int i = 0; i < count; ++i) sk_eye_ray(&eye, strip, i < blind, limit);
}

void returns(sk_eye& eye, int count, int dusty, std::int64_t now_us) {
  for (int i = 0; i < count; ++i) sk_eye_return(&eye, i < dusty, now_us);
}

// verifies: SK-SI-2
TEST(SensorSight, ARayIsBlindWithoutEchoAndWithTheFarthestOnTheWindow) {
  EXPECT_TRUE(sk_ray_blind(0));
  EXPECT_TRUE(sk_ray_blind(499));
  EXPECT_FALSE(sk_ray_blind(500));
  EXPECT_FALSE(sk_ray_blind(INT32_MAX));
  EXPECT_TRUE(sk_ray_blind(INT32_MIN));
}

// verifies: SK-SI-6
TEST(SensorSight, ARayIsDustyWithAnEchoWellBeforeTheLast) {
  EXPECT_TRUE(sk_ray_dusty(500, 1000));
  EXPECT_FALSE(sk_ray_dusty(499, 1000)) << "on the window";
  EXPECT_FALSE(sk_ray_dusty(501, 1000)) << "of the target";
  EXPECT_FALSE(sk_ray_dusty(1000, 1000));
  EXPECT_FALSE(sk_ray_dusty(0, 60000));
  EXPECT_FALSE(sk_ray_dusty(INT32_MAX, INT32_MAX)) << "nothing overflows";
  EXPECT_FALSE(sk_ray_dusty(INT32_MAX, INT32_MIN));
}

// verifies: SK-SI-3
TEST(SensorSight, AStripIsBlockedWithTheRayWithWhichItIsDue) {
  sk_eye eye = begun();
  rays(eye, 7, SK_SIGHT_RAYS - 1, SK_SIGHT_RAYS - 1);
  EXPECT_FALSE(sk_eye_blocked(&eye)) << "not judged yet";
  rays(eye, 7, 1, 1);
  EXPECT_TRUE(sk_eye_blocked(&eye));
  EXPECT_EQ(eye.strip[7].blocked, 1);
  EXPECT_EQ(eye.strip[6].blocked, 0);
}

// verifies: SK-SI-3
TEST(SensorSight, TheLimitIsReachedAtItAndNotBelow) {
  sk_eye eye = begun();
  rays(eye, 0, SK_SIGHT_RAYS, SK_SIGHT_RAYS / 2 - 1);
  EXPECT_FALSE(sk_eye_blocked(&eye));
  rays(eye, 0, SK_SIGHT_RAYS, SK_SIGHT_RAYS / 2);
  EXPECT_TRUE(sk_eye_blocked(&eye));
  eye = begun();
  rays(eye, 0, SK_SIGHT_RAYS, SK_SIGHT_RAYS - 1, 1000);
  EXPECT_FALSE(sk_eye_blocked(&eye));
  rays(eye, 0, SK_SIGHT_RAYS, SK_SIGHT_RAYS, 1000);
  EXPECT_TRUE(sk_eye_blocked(&eye)) << "all blind, at the highest limit";
}

// verifies: SK-SI-4
TEST(SensorSight, ABlockedStripStaysSoUntilItIsJudgedWell) {
  sk_eye eye = begun();
  rays(eye, 3, SK_SIGHT_RAYS, SK_SIGHT_RAYS);
  for (std::int32_t strip = 0; strip < SK_SIGHT_STRIPS; ++strip)
    if (strip != 3) rays(eye, strip, 5 * SK_SIGHT_RAYS, 0);
  EXPECT_TRUE(sk_eye_blocked(&eye)) << "others that see do not help";
  rays(eye, 3, SK_SIGHT_RAYS - 1, 0);
  EXPECT_TRUE(sk_eye_blocked(&eye));
  rays(eye, 3, 1, 0);
  EXPECT_FALSE(sk_eye_blocked(&eye));
  rays(eye, 3, SK_SIGHT_RAYS, SK_SIGHT_RAYS);
  sk_eye_begin(&eye);
  EXPECT_FALSE(sk_eye_blocked(&eye));
}

// verifies: SK-SI-4
TEST(SensorSight, ARayOfNoStripChangesNothing) {
  sk_eye eye = begun();
  for (const std::int32_t strip : {-1, SK_SIGHT_STRIPS, INT32_MIN, INT32_MAX}) rays(eye, strip, SK_SIGHT_RAYS, SK_SIGHT_RAYS);
  EXPECT_FALSE(sk_eye_blocked(&eye));
  for (const sk_strip& s : eye.strip) EXPECT_EQ(s.expected, 0);
}

// verifies: SK-SI-7
TEST(SensorSight, TheDustLevelIsOfAThousandReturnsOrASecond) {
  sk_eye eye = begun();
  returns(eye, SK_SIGHT_RETURNS - 1, 200, 5);
  EXPECT_EQ(eye.dust_permille, 0);
  returns(eye, 1, 0, 5);
  EXPECT_EQ(eye.dust_permille, 200);
  returns(eye, 150, 15, 100);
  EXPECT_EQ(eye.dust_permille, 200);
  returns(eye, 1, 0, 100 + SK_SIGHT_DUST_US);
  EXPECT_EQ(eye.dust_permille, 100) << "15 of 151, rounded up";
  returns(eye, 98, 98, 0);
  returns(eye, 1, 0, 10'000'000);
  EXPECT_EQ(eye.dust_permille, 100) << "too few to tell";
  returns(eye, 1, 1, 10'000'001);
  EXPECT_EQ(eye.dust_permille, 990);
  returns(eye, 5000, 0, -1);
  EXPECT_EQ(eye.returns, 0) << "before time 0 there is nothing";
}

std::int32_t verdict(sk_dust& dust, std::int32_t level, std::int64_t now_us) {
  sk_eye eye[2] = {begun(), begun()};
  eye[1].dust_permille = level;
  return sk_sight_verdict(&dust, eye, 2, kRules, now_us);
}

// verifies: SK-SI-8, SK-SI-9
TEST(SensorSight, DustSlowsAndStopsAndDwells) {
  sk_dust dust;
  sk_dust_begin(&dust);
  EXPECT_EQ(verdict(dust, 99, 1'000'000), SK_DUST_NONE);
  EXPECT_EQ(verdict(dust, 100, 2'000'000), SK_DUST_SLOW);
  EXPECT_EQ(verdict(dust, 300, 3'000'000), SK_DUST_STOP);
  EXPECT_EQ(verdict(dust, 299, 5'999'999), SK_DUST_STOP) << "dwells";
  EXPECT_EQ(verdict(dust, 299, 6'000'000), SK_DUST_SLOW);
  EXPECT_EQ(verdict(dust, 0, 8'999'999), SK_DUST_SLOW) << "dwells";
  EXPECT_EQ(verdict(dust, 0, 9'000'000), SK_DUST_NONE);
  EXPECT_EQ(verdict(dust, 1000, 10'000'000), SK_DUST_STOP);
  EXPECT_EQ(verdict(dust, 0, 9'000'000), SK_DUST_STOP) << "time has run backwards";
  EXPECT_EQ(sk_sight_verdict(&dust, nullptr, 0, {100, 300, 0}, 10'000'000), SK_DUST_NONE) << "no eye, no dwell";
}

// The reference keeps every ray since it was judged, and every moment at which there was dust.
struct Reference {
  std::vector<std::vector<bool>> since = std::vector<std::vector<bool>>(SK_SIGHT_STRIPS);
  std::vector<bool> blocked = std::vector<bool>(SK_SIGHT_STRIPS, false);
  std::deque<std::pair<std::int64_t, bool>> back;
  double level = 0.0;

  void ray(std::size_t strip, bool blind, int limit) {
    since[strip].push_back(blind);
    if (since[strip].size() < SK_SIGHT_RAYS) return;
    double share = 0.0;
    for (const bool b : since[strip]) share += b ? 1000.0 / SK_SIGHT_RAYS : 0.0;
    blocked[strip] = share > limit - 1e-6;
    since[strip].clear();
  }
  void come(bool dusty, std::int64_t now_us) {
    back.emplace_back(now_us, dusty);
    const bool second = back.size() >= SK_SIGHT_RETURNS_LEAST && now_us - back.front().first >= SK_SIGHT_DUST_US;
    if (back.size() < SK_SIGHT_RETURNS && !second) return;
    double count = 0.0;
    for (const auto& one : back) count += one.second ? 1.0 : 0.0;
    level = 1000.0 * count / static_cast<double>(back.size());
    back.clear();
  }
};

// verifies: SK-SI-3, SK-SI-4, SK-SI-7, SK-SI-8, SK-SI-9
TEST(SensorSight, AgreesWithAReferenceOverRandomSequences) {
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64 random(seed);
  SCOPED_TRACE("seed " + std::to_string(seed));
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int blocked_seen = 0, verdicts[3] = {};
  for (int run = 0; run < 40; ++run) {
    sk_eye eye = begun();
    Reference reference;
    sk_dust dust;
    sk_dust_begin(&dust);
    const int limit = 50 + below(951), blind_percent = std::min(100, limit / 10 + below(30) - 15);
    std::vector<std::pair<std::int64_t, double>> levels;
    int dust_percent = below(40);
    std::int64_t now_us = 0;
    for (int step = 0; step < 6000; ++step) {
      now_us += below(run % 2 == 0 ? 3'000 : 30'000);
      if (step % 1500 == 0) dust_percent = below(45);
      const auto strip = static_cast<std::size_t>(below(SK_SIGHT_STRIPS));
      const bool blind = below(100) < blind_percent, dusty = below(100) < dust_percent;
      sk_eye_ray(&eye, static_cast<std::int32_t>(strip), blind, limit);
      reference.ray(strip, blind, limit);
      sk_eye_return(&eye, dusty, now_us);
      reference.come(dusty, now_us);
      bool any = false;
      for (std::size_t k = 0; k < SK_SIGHT_STRIPS; ++k) {
        ASSERT_EQ(eye.strip[k].blocked == 1, reference.blocked[k]) << "strip " << k << " step " << step;
        any = any || reference.blocked[k];
      }
      ASSERT_EQ(sk_eye_blocked(&eye), any);
      blocked_seen += any ? 1 : 0;
      ASSERT_GE(eye.dust_permille, reference.level - 1e-6);
      ASSERT_LT(eye.dust_permille, reference.level + 1.0);
      const std::int32_t is = sk_sight_verdict(&dust, &eye, 1, kRules, now_us);
      levels.emplace_back(now_us, eye.dust_permille);
      std::int32_t ought = SK_DUST_NONE;
      for (const auto& [then_us, level] : levels) {
        if (then_us != now_us && then_us + kRules.dwell_us <= now_us) continue;
        if (level >= kRules.stop_permille) ought = SK_DUST_STOP;
        else if (level >= kRules.slow_permille && ought == SK_DUST_NONE) ought = SK_DUST_SLOW;
      }
      ASSERT_EQ(is, ought) << "step " << step;
      ++verdicts[is];
      while (levels.front().first + kRules.dwell_us < now_us) levels.erase(levels.begin());
    }
  }
  EXPECT_GT(blocked_seen, 1000);
  for (const int count : verdicts) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace berm::core_test
