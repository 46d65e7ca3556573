// Time of the whole clearance question for the reach box of a full-speed swing. Prints; the bound is wide enough for a busy machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>

#include "geometry/separation.hpp"
#include "geometry/swept_slices.hpp"
#include "machine_profile.hpp"
#include "pass_over.hpp"

namespace berm::kernel::test {
namespace {

constexpr double urad_per_degree = 1e6 * 3.141592653589793 / 180.0;
constexpr int repeats = 300;
constexpr int64_t now_us = 100000000;

// Swing 60 degrees about 45, carrying with the bucket curled, intervals of the other joints as at full speed.
sk_reach_box full_speed_box() {
  const double middle[4] = {45, 40, -95, -60}, half[4] = {30, 4, 4, 4};
  sk_reach_box box{};
  for (int j = 0; j < 4; ++j) {
    box.low_urad[j] = static_cast<int32_t>((middle[j] - half[j]) * urad_per_degree);
    box.high_urad[j] = static_cast<int32_t>((middle[j] + half[j]) * urad_per_degree);
  }
  return box;
}

struct Scene {
  const char* name;
  std::function<int32_t(double x_mm, double y_mm)> height; // mm
  std::function<bool(double x_mm, double y_mm)> observed;
};

void fill(sk_height_map& map, const Scene& scene) {
  sk_map_clear(&map);
  for (int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
    for (int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const double x = SK_MAP_ORIGIN_MM + (ix + 0.5) * SK_CELL_MM, y = SK_MAP_ORIGIN_MM + (iy + 0.5) * SK_CELL_MM;
      if (!scene.observed(x, y)) continue;
      ASSERT_TRUE(sk_map_insert(&map, iy, ix, scene.height(x, y), now_us - 1000000, 1000000));
    }
}

} // namespace

// verifies: SK-GE-16
TEST(ClearanceTime, FullSpeedReachBox) {
  const auto everywhere = [](double, double) { return true; };
  const auto bench = [](double x, double y) { return x < 6000 && y < 3600 ? 0 : -2200; };
  const Scene scenes[] = {
      {"flat ground", [](double, double) { return 0; }, everywhere},
      {"bench and truck", [=](double x, double y) { return std::fabs(x + 700) < 2440 && std::fabs(y - 6750) < 1220 ? 300 : bench(x, y); }, everywhere},
      {"bench, a strip unseen", bench, [](double x, double y) { return std::fabs(x - y) > 400 || x < 9500; }},
      {"spoil heap under the arc", [](double x, double y) { return std::fabs(std::hypot(x, y) - 6000) < 1200 ? 1500 : 0; }, everywhere},
      {"walls on both sides of the arc", [](double x, double y) { return std::hypot(x, y) > 8600 ? 4000 : 0; }, everywhere},
      {"nothing seen", [](double, double) { return 0; }, [](double, double) { return false; }},
  };
  const auto set = std::make_unique<SliceSet>();
  const auto map = std::make_unique<sk_height_map>();
  const auto choice = std::make_unique<sk_choice>();
  const auto columns = std::make_unique<sk_columns>();
  const auto machines = machine_profiles();
  ASSERT_FALSE(machines.empty());
  const sk_reach_box box = full_speed_box();
  sk_clearance_rules rules{};
  rules.now_us = now_us;
  rules.fresh_us = 20000000;
  rules.margin_mm = 300;
  berm::test::pass_over(rules);
  for (const Machine& machine : machines) {
    rules.own_body_radius_mm = machine.parameters.own_body_radius_mm;
    for (const Scene& scene : scenes) {
      fill(*map, scene);
      std::vector<double> build, choose;
      int clear = 0;
      for (int i = 0; i < repeats; ++i) {
        const auto start = std::chrono::steady_clock::now();
        ASSERT_TRUE(build_slices(machine.parameters, box, *set));
        const auto built = std::chrono::steady_clock::now();
        clear = 0;
        ASSERT_TRUE(sk_columns_of(map.get(), &rules, columns.get()));
        for (int s = 0; s < set->count; ++s) clear += clear_slice(*map, *columns, rules, *set, s, *choice).verdict == SK_CLEAR ? 1 : 0;
        const auto end = std::chrono::steady_clock::now();
        build.push_back(std::chrono::duration<double, std::micro>(built - start).count());
        choose.push_back(std::chrono::duration<double, std::micro>(end - built).count());
      }
      std::sort(build.begin(), build.end());
      std::sort(choose.begin(), choose.end());
      std::cout << machine.name << ", " << scene.name << ": " << set->count << " slices, " << clear << " clear; build " << build[repeats / 2] << " us, columns, search and core's check "
                << choose[repeats / 2] << " us (median); 99 %: " << build[repeats * 99 / 100] << ", " << choose[repeats * 99 / 100] << "\n";
      EXPECT_LT(build.front() + choose.front(), 2000.0);
    }
  }
}

} // namespace berm::kernel::test
