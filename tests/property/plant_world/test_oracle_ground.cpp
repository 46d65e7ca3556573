// The oracle's ground gap against upright rays through the machine's parts, over rough and over smooth ground.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench.hpp"
#include "plant/oracle/oracle.hpp"
#include "plant/world/link_frames.hpp"
#include "plant/world/solids.hpp"

namespace berm::plant::oracle {
namespace {

using Random = std::mt19937_64;
double draw(Random& r, double low, double high) { return low + (high - low) * static_cast<double>(r() >> 11) * 0x1.0p-53; }

constexpr int side = 240;
constexpr double pitch = 0.025;  // of the rays

std::vector<double> rough_ground(Random& r) {
  std::vector<double> height(side * side);
  for (double& h : height) h = draw(r, -1.0, -0.6);
  for (int heap = 0; heap < 6; ++heap) {
    const size_t x = r() % 220, y = r() % 220;
    for (size_t i = 0; i < 64; ++i) height[(y + i / 8) * side + x + i % 8] += draw(r, 0, 1.5);
  }
  return height;
}

std::vector<double> smooth_ground(Random& r) {
  std::vector<double> height(side * side);
  const double u = draw(r, 0.2, 0.6), v = draw(r, 0.2, 0.6), base = draw(r, -1.5, 0);
  for (size_t i = 0; i < height.size(); ++i) height[i] = base + 0.5 * std::sin(u * 0.1 * static_cast<double>(i % side)) * std::cos(v * 0.1 * static_cast<double>(i / side));
  return height;
}

bool in_zone(const Zone& z, double x, double y) {
  return x >= z.x_low - 1e-9 && x + 0.1 <= z.x_high + 1e-9 && y >= z.y_low - 1e-9 && y + 0.1 <= z.y_high + 1e-9;
}

// Least gap that upright rays from below find.
double least_by_rays(const ImplementShape& shape, const std::array<double, 4>& q, const std::vector<double>& height, const Zone& zone) {
  const LinkFrames links = link_frames(shape, {q, {}});
  const PlanarFrame body(0, 0, 0, q[0]);
  double least = 1e9;
  for (const SolidPart& part : shape.parts) {
    std::vector<SwingPlanePoint> outline;
    for (const OutlinePoint& p : part.outline) outline.push_back(links.link[static_cast<size_t>(part.link)].out(p.x, p.z));
    const PrismSolid solid(outline, part.half_width);
    for (double r = solid.low().x; r <= solid.high().x; r += pitch) {
      for (double across = -part.half_width; across <= part.half_width; across += pitch) {
        const auto hit = solid.cast({{r, across, -50}, {0, 0, 1}}, 100);
        if (!hit) continue;
        const Vec3 p = body.out(Vec3{r, across, -50 + *hit});
        const int ix = static_cast<int>(std::floor((p.x + 12) / 0.1)), iy = static_cast<int>(std::floor((p.y + 12) / 0.1));
        if (in_zone(zone, -12 + 0.1 * ix, -12 + 0.1 * iy)) continue;
        least = std::min(least, p.z - height[static_cast<size_t>(iy * side + ix)]);
      }
    }
  }
  return least;
}

void compare(bool rough, double tolerance) {
  const ImplementShape shape = bench::machine();
  const Oracle oracle(shape);
  Random r(31337);
  int contacts = 0, clear = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const std::vector<double> height = rough ? rough_ground(r) : smooth_ground(r);
    Site site;
    site.ground = {-12, -12, 0.1, side, side, height.data()};
    site.zones = {{4, -3, 9, 3, -50}};
    const std::array<double, 4> q = {draw(r, -3, 3), draw(r, -0.5, 0.9), draw(r, -2.4, -0.8), draw(r, -2.3, 0.6)};
    const Judgement j = oracle.judge(q, site);
    const double least = least_by_rays(shape, q, height, site.zones[0]);
    ASSERT_GE(least, j.ground_gap - 1e-9) << "deeper than the oracle says";
    ASSERT_LE(least, j.ground_gap + tolerance) << "nearer than it is";
    ASSERT_EQ(j.contact, j.ground_gap <= 0);
    (j.contact ? contacts : clear)++;
  }
  EXPECT_GT(contacts, 15);
  EXPECT_GT(clear, 15);
}

// A single high column beside a part may count although no ray meets it: up to its height.
TEST(OracleGround, NothingIsDeeperThanTheGapOnRoughGround) { compare(true, 2.0); }
// Where neighbours are alike, the rectangle round a column's square adds no more than the part's slope over a cell.
TEST(OracleGround, TheGapIsTightOnSmoothGround) { compare(false, 0.2); }

}  // namespace
}  // namespace berm::plant::oracle
