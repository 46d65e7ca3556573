#include "recognition/bed_ground.hpp"

#include <gtest/gtest.h>

namespace berm::app {
namespace {

using Eigen::Vector3d;

// One fan from beside the bed, with returns one beside the other in a square of a metre; bed frame is base frame.
class Ground {
 public:
  Ground() { sweep_.heads = {Vector3d(0.5, -7.0, 2.5)}, sweep_.begin = {0, 0}; }
  void add(double x, double y, double z) {
    for (int k = 0; k < 64; ++k) sweep_.returns.push_back({Vector3d(x + 0.125 * (k % 8), y + 0.125 * (k / 8), z).cast<float>()});
    sweep_.begin = {0, sweep_.returns.size()};
  }
  [[nodiscard]] bool level(int cab_end) const {
    BedPose bed;
    bed.length = 5.0, bed.width = 2.4, bed.thickness = 0.1;
    return lies_in_level_ground(sweep_, bed, cab_end);
  }

 private:
  FanSweep sweep_;
};

TEST(BedGround, APitLiesInLevelGround) {
  Ground pit;
  EXPECT_FALSE(pit.level(1)) << "nothing is seen";
  pit.add(-1.0, 1.5, 0.1);  // beyond the far side
  EXPECT_TRUE(pit.level(1));
  pit.add(-1.0, 1.6, -2.5);
  EXPECT_FALSE(pit.level(1)) << "a truck's ground beside something level";
}

TEST(BedGround, BeforeTheNearSideAndWhereTheCabStandsItMayBeLevel) {
  Ground bench;
  bench.add(-1.0, -2.6, 0.1);  // a bench before the near side
  EXPECT_FALSE(bench.level(1));
  bench.add(-3.9, 0.0, 0.1);   // the far end is the rear one: the sensor stands before the front half
  EXPECT_FALSE(bench.level(-1)) << "a cab beyond the rear end";
  EXPECT_TRUE(bench.level(1)) << "level ground beyond the rear end";
}

}  // namespace
}  // namespace berm::app
