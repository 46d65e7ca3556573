// The sensor's place for each scanline, standing and swinging.
#include <gtest/gtest.h>

#include <numbers>

#include "drawn_bed.hpp"
#include "recognition/fans.hpp"

namespace berm::app {
namespace {

TEST(Fans, StandingSensorIsTheViewpoint) {
  const FanSweep sweep = make_fans(sweep_of({}), drawn_viewpoint);
  ASSERT_EQ(sweep.reason, "");
  EXPECT_EQ(sweep.heads.size(), 90U);
  for (const Eigen::Vector3d& head : sweep.heads) EXPECT_LT((head - Eigen::Vector3d(1.30, 1.35, 3.30)).norm(), 1e-3);
}

TEST(Fans, FindsTheSwingFromThePlanes) {
  DrawnBed bed;
  bed.swing_rate = 0.2;
  const FanSweep sweep = make_fans(sweep_of(bed), drawn_viewpoint);
  // Within a scanline the drawn sensor moves by 0.2 rad/s x 1.87 m x 33 ms = 1.2 cm: no plane is exact.
  ASSERT_EQ(sweep.reason, "");
  EXPECT_NEAR(sweep.swing_rate, 0.2, 0.02);
}

TEST(Fans, RefusesAnotherViewpointAndTooFewScanlines) {
  EXPECT_NE(make_fans(sweep_of({}), {40.0, -7.0, 3.0}).reason, "");
  EXPECT_NE(make_fans({}, drawn_viewpoint).reason, "");
}

TEST(Fans, AreThinnedToADegree) {
  FanSweep sweep = make_fans(sweep_of({}), drawn_viewpoint);
  EXPECT_NEAR(sweep.step, std::numbers::pi / 180.0, 1e-3);
  EXPECT_EQ(thinned(sweep).returns.size(), sweep.returns.size()) << "they lie a degree apart already";
  sweep.step /= 2.0;  // as if twice as many lay as near
  const FanSweep half = thinned(sweep);
  ASSERT_EQ(half.heads.size(), (sweep.heads.size() + 1) / 2);
  ASSERT_EQ(half.directions.size(), half.returns.size());
  for (std::size_t fan = 0; fan < half.heads.size(); ++fan) {
    ASSERT_EQ(half.of(fan).size(), sweep.of(2 * fan).size());
    EXPECT_EQ(half.heads[fan], sweep.heads[2 * fan]);
    EXPECT_EQ(half.of(fan).front().place, sweep.of(2 * fan).front().place);
  }
}

}  // namespace
}  // namespace berm::app
