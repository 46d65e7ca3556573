#include <gtest/gtest.h>

#include "bench.hpp"
#include "plant/world/bucket_load.hpp"

namespace berm::plant {
namespace {

constexpr double degree = bench::degree;

LinkFrame at(double elevation) { return LinkFrame(LinkPose{{0, 0}, elevation}); }

double drain(BucketLoad& b, double tilt, double seconds) {
  double out = 0;
  for (int i = 0; i < seconds * 100; ++i) out += b.release(tilt, 0.01, false);
  return out;
}

TEST(BucketLoad, TiltOfTheMouth) {
  EXPECT_NEAR(BucketLoad::mouth_tilt(at(-180 * degree)), 0, 1e-7) << "curled: level";
  EXPECT_NEAR(BucketLoad::mouth_tilt(at(-90 * degree)), 90 * degree, 1e-9);
  EXPECT_NEAR(BucketLoad::mouth_tilt(at(0)), 180 * degree, 1e-7) << "mouth down";
}

TEST(BucketLoad, HoldsNoMoreThanHeapedOrTheHeaviestPayload) {
  ImplementShape s = bench::machine();
  BucketLoad b(s, {});
  EXPECT_NEAR(b.take(2.0), 0.8, 1e-12);
  EXPECT_NEAR(b.volume(), 1.2, 1e-12);
  s.bucket_payload_max_kg = 670;
  BucketLoad light(s, {});
  EXPECT_NEAR(light.heaped(), 670 / 1340.0, 1e-12);
}

TEST(BucketLoad, BallastTakesItsRoom) {
  BucketLoad half(bench::machine(), {}, 0.5 * 1.2 * 1340);
  EXPECT_NEAR(half.take(2.0), 1.4, 1e-12);
  EXPECT_NEAR(half.volume(), 0.6, 1e-12);
  BucketLoad full(bench::machine(), {}, 1800);
  EXPECT_EQ(full.take(1.0), 1.0);
  EXPECT_EQ(full.volume(), 0.0);
}

TEST(BucketLoad, CapacityFallsAsTheMouthTurnsDown) {
  const BucketLoad b(bench::machine(), {});
  double last = b.capacity(0);
  EXPECT_NEAR(last, 1.2, 1e-12);
  for (double tilt = 0; tilt <= 180; tilt += 1) {
    const double now = b.capacity(tilt * degree);
    EXPECT_LE(now, last + 1e-12);
    EXPECT_GT(now, last - 0.03) << "without jumps";
    last = now;
  }
  EXPECT_EQ(last, 0);
}

TEST(BucketLoad, CarriedLevelNothingIsLostAndOpenAllOfIt) {
  BucketLoad b(bench::machine(), {});
  b.take(1.2);
  EXPECT_EQ(drain(b, 10 * degree, 10), 0);
  const double some = drain(b, 60 * degree, 3);
  EXPECT_NEAR(some, 1.2 - b.capacity(60 * degree), 1e-6);
  EXPECT_NEAR(some + drain(b, 130 * degree, 3), 1.2, 1e-12);
  EXPECT_EQ(b.volume(), 0);
}

TEST(BucketLoad, SlidesOutProgressively) {
  BucketLoad b(bench::machine(), {});
  b.take(1.2);
  const double first = drain(b, 130 * degree, 0.1);
  EXPECT_GT(first, 0.1);
  EXPECT_LT(first, 0.6);
}

TEST(BucketLoad, GroundBeforeTheMouthHoldsTheLoad) {
  BucketLoad b(bench::machine(), {});
  b.take(1.2);
  EXPECT_EQ(b.release(120 * degree, 0.01, true), 0);
}

TEST(BucketLoad, StickyShareNeedsAMoreOpenBucket) {
  SoilConfig sticky;
  sticky.stick_fraction = 0.2;
  BucketLoad b(bench::machine(), sticky);
  b.take(1.0);
  drain(b, 130 * degree, 5);
  EXPECT_NEAR(b.volume(), 0.2, 1e-9);
  drain(b, 152.5 * degree, 5);
  EXPECT_NEAR(b.volume(), 0.1, 1e-9);
  drain(b, 175 * degree, 5);
  EXPECT_EQ(b.volume(), 0);
}

}  // namespace
}  // namespace berm::plant
