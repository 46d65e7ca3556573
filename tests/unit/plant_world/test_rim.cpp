// Measured ground ends in a step to the level beyond it: no ray that points down finds a gap there.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plant/world/movers.hpp"
#include "plant/world/scene.hpp"

namespace berm::plant {
namespace {

constexpr double low = -4.0, high = 1.0, beyond = -1.0;  // z: of the ground where x < 0, of the rest, and outside the map

TerrainConfig stepped() {
  TerrainConfig c;
  c.x_low = c.y_low = -8.0;
  c.x_high = c.y_high = 8.0;
  c.cell = 0.5;
  MeasuredGround ground;
  ground.beyond = beyond;
  for (int iy = 0; iy < c.count_y(); ++iy)
    for (int ix = 0; ix < c.count_x(); ++ix) ground.height.push_back(ix < c.count_x() / 2 ? low : high);
  c.measured = ground;
  return c;
}

TEST(Rim, EveryRayThatPointsDownMeetsGround) {
  const Terrain terrain(stepped(), SoilConfig{}, 1);
  Movers movers({});
  Scene scene;
  scene.place_site(terrain, {}, movers, {});
  const Vec3 head{0.3, 0.2, 3.3};
  int at_step = 0, past_rim = 0;
  for (int degree = 0; degree < 360; ++degree) {
    for (double depression = 4.0; depression < 80.0; depression += 0.5) {
      const double a = degree * std::numbers::pi / 180.0, d = depression * std::numbers::pi / 180.0;
      const Ray ray{head, {std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), -std::sin(d)}};
      const auto range = scene.cast(ray, ray, ray, 200.0);
      ASSERT_TRUE(range) << "towards " << degree << " degrees, " << depression << " down";
      const Vec3 p = ray.at(*range);
      const bool outside = std::abs(p.x) > 8.0 + 1e-6 || std::abs(p.y) > 8.0 + 1e-6, on_rim = !outside && (std::abs(p.x) > 8.0 - 1e-6 || std::abs(p.y) > 8.0 - 1e-6);
      if (outside) {
        ASSERT_NEAR(p.z, beyond, 1e-9) << degree << ' ' << depression;
        ++past_rim;
      } else if (on_rim && p.z > low + 1e-6 && p.x < -0.5) {
        ASSERT_LE(p.z, beyond) << degree << ' ' << depression;
        ++at_step;
      }
    }
  }
  EXPECT_GT(at_step, 500);
  EXPECT_GT(past_rim, 500);
}

}  // namespace
}  // namespace berm::plant
