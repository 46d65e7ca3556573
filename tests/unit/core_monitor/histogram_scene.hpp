// A histogram of heights with rules, a time and a scene of level ground for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "core/monitor_histogram.h"
#include "monitor_scene.hpp"

namespace berm::core_test {

constexpr std::int32_t kLow = SK_MAP_ORIGIN_MM, kHigh = -SK_MAP_ORIGIN_MM;

class MonitorHistogram : public testing::Test {
 protected:
  MonitorHistogram() { sk_histogram_begin(h.get()); }
  bool see(int iy, int ix, std::int32_t z_mm, int points = 1) {
    bool departs = false;
    for (int i = 0; i < points; ++i) departs = sk_histogram_insert(h.get(), SK_NOBODY_KNOWS, false, rules.get(), iy, ix, z_mm, now_us);
    return departs;
  }
  void ground(std::int32_t z_mm = 0) {
    for (int iy = 40; iy < 60; ++iy)
      for (int ix = 40; ix < 60; ++ix) see(iy, ix, z_mm, SK_HISTOGRAM_ENOUGH);
    settle();
  }
  void settle() { sk_histogram_settle(h.get(), kLow, kLow, kHigh, kHigh); }
  bool step() { return sk_histogram_step(h.get(), rules.get(), now_us, &where); }
  bool somebody(int iy, int ix) const { return h->state[iy][ix] == SK_CELL_SOMEBODY; }

  std::unique_ptr<sk_monitor_histogram> h = std::make_unique<sk_monitor_histogram>();
  std::unique_ptr<sk_monitor_rules> rules = monitor_rules(true);
  std::int64_t now_us = 1'000'000;
  sk_monitor_cell where{};
};

}  // namespace berm::core_test
