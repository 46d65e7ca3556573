// What is malformed is refused as such, and nothing else is.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>

#include "clearance_scene.hpp"
#include "map_cells.hpp"

namespace berm::core_test {
namespace {

constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kMin64 = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax64 = std::numeric_limits<std::int64_t>::max();
constexpr Block kBlock{310, 890, 310, 590, 1000, 1500};

class ClearanceRefusals : public testing::Test {
 protected:
  void SetUp() override {
    level(*map, 0);
    choose(*choice, 0);
    rules.fresh_us = kMax32;
  }
  sk_clearance_result check(const sk_slice& s) const {
    sk_clearance_result out{-7, -7, -7, -7};
    sk_clear_slice(map.get(), &s, choice.get(), &rules, &out);
    EXPECT_TRUE(same(out, judge(*map, s, *choice, rules))) << "the reference judges otherwise";
    return out;
  }
  // Refused as malformed for a reason that the rectangle knows, or does not know, of.
  void expect_invalid(const std::function<void(sk_slice&)>& change, bool rectangle) const {
    sk_slice s = block_slice(3, kBlock);
    change(s);
    EXPECT_TRUE(same(check(s), {SK_BLOCKED_INVALID, -1, -1, 0}));
    sk_rectangle r{-9, -9, -9, -9};
    EXPECT_EQ(sk_slice_rectangle(&s, &r), rectangle);
    EXPECT_EQ(r.ix_low == -9 && r.ix_high == -9 && r.iy_low == -9 && r.iy_high == -9, !rectangle) << "a refusal wrote its output";
  }
  void expect_valid(const std::function<void(sk_slice&)>& change) const {
    sk_slice s = block_slice(3, kBlock);
    change(s);
    EXPECT_NE(check(s).verdict, SK_BLOCKED_INVALID);
  }
  void expect_rules(bool valid, const std::function<void(sk_clearance_rules&)>& change) {
    const sk_clearance_rules was = rules;
    change(rules);
    const sk_clearance_result out = check(block_slice(3, kBlock));
    EXPECT_EQ(same(out, {SK_BLOCKED_INVALID, -1, -1, 0}), !valid);
    rules = was;
  }

  std::unique_ptr<sk_height_map> map = cleared_map();
  std::unique_ptr<sk_choice> choice = std::make_unique<sk_choice>();
  sk_clearance_rules rules = scene_rules();
};

// verifies: SK-CL-3, SK-CL-11
TEST_F(ClearanceRefusals, Counts) {
  for (const std::int32_t link : {kMin32, -1, 4, kMax32}) expect_invalid([&](sk_slice& s) { s.link = link; }, false);
  for (const std::int32_t link : {0, 1, 2, 3}) expect_valid([&](sk_slice& s) { s.link = link; });
  for (const std::int32_t count : {kMin32, -1, 0, 25, kMax32}) {
    expect_invalid([&](sk_slice& s) { s.vertices = count; }, false);
    expect_invalid([&](sk_slice& s) { s.planes = count; }, false);
  }
  for (const std::int32_t count : {1, 24}) {
    expect_valid([&](sk_slice& s) { s.vertices = count; });
    expect_valid([&](sk_slice& s) { s.planes = count; });
  }
}

// verifies: SK-CL-3, SK-CL-11
TEST_F(ClearanceRefusals, Coordinates) {
  for (int vertex = 0; vertex < 8; ++vertex)
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int32_t v : {kMin32, -32001, 32001, kMax32}) expect_invalid([&](sk_slice& s) { s.xyz_mm[axis][vertex] = v; }, false);
      for (const std::int32_t v : {-32000, 32000}) expect_valid([&](sk_slice& s) { s.xyz_mm[axis][vertex] = v; });
    }
  expect_valid([](sk_slice& s) { s.xyz_mm[0][8] = kMax32; });  // not in use
}

// verifies: SK-CL-11
TEST_F(ClearanceRefusals, Planes) {
  for (int plane = 0; plane < 6; ++plane) {
    for (std::int32_t sk_plane::*n : {&sk_plane::nx, &sk_plane::ny, &sk_plane::nz}) {
      for (const std::int32_t v : {kMin32, -1048577, 1048577, kMax32}) expect_invalid([&](sk_slice& s) { s.plane[plane].*n = v; }, true);
      for (const std::int32_t v : {-1048576, 1048576}) expect_valid([&](sk_slice& s) { s.plane[plane].*n = v; });
    }
    for (const std::int64_t d : {kMin64, -9007199254740993, 9007199254740993, kMax64}) expect_invalid([&](sk_slice& s) { s.plane[plane].d = d; }, true);
    for (const std::int64_t d : {-9007199254740992, 9007199254740992}) expect_valid([&](sk_slice& s) { s.plane[plane].d = d; });
  }
  expect_valid([](sk_slice& s) { s.plane[6].nx = kMax32; });  // not in use
}

// verifies: SK-CL-11
TEST_F(ClearanceRefusals, Rules) {
  for (const std::int64_t now_us : {kMin64, std::int64_t{-1}}) expect_rules(false, [&](sk_clearance_rules& r) { r.now_us = now_us; });
  for (const std::int64_t now_us : {std::int64_t{0}, kMax64}) expect_rules(true, [&](sk_clearance_rules& r) { r.now_us = now_us; });
  for (const std::int32_t fresh_us : {kMin32, -1}) expect_rules(false, [&](sk_clearance_rules& r) { r.fresh_us = fresh_us; });
  for (const std::int32_t fresh_us : {0, kMax32}) expect_rules(true, [&](sk_clearance_rules& r) { r.fresh_us = fresh_us; });
  for (std::int32_t sk_clearance_rules::*length : {&sk_clearance_rules::margin_mm, &sk_clearance_rules::own_body_radius_mm}) {
    for (const std::int32_t v : {kMin32, -1, 32001, kMax32}) expect_rules(false, [&](sk_clearance_rules& r) { r.*length = v; });
    for (const std::int32_t v : {0, 32000}) expect_rules(true, [&](sk_clearance_rules& r) { r.*length = v; });
  }
  for (const std::int32_t zones : {kMin32, -1, 5, kMax32}) expect_rules(false, [&](sk_clearance_rules& r) { r.dig_zones = zones; });
  for (const std::int32_t zones : {0, 4}) expect_rules(true, [&](sk_clearance_rules& r) { r.dig_zones = zones; });
}

// The largest products, and dig zones with any figures whatever, do not overflow.
// verifies: SK-CL-6, SK-CL-12
TEST_F(ClearanceRefusals, LargestValues) {
  sk_slice s = block_slice(3, {-15599, 15599, -15599, 15599, 32000, 32000});
  s.planes = 24;
  for (int k = 0; k < 24; ++k) {
    const auto sign = [&](int bit) { return (k >> bit & 1) != 0 ? -1048576 : 1048576; };
    s.plane[k] = {sign(0), sign(1), k < 16 ? 1048576 : 0, (k >> 2 & 1) != 0 ? -9007199254740992 : 1048576LL * (32000 - 2 * 15599) - 1};
  }
  rules.margin_mm = 32000;
  level(*map, 20000);
  rules.dig_allowed = true;
  rules.dig_zones = 4;
  for (int i = 0; i < 4; ++i) {
    const auto end = [&](int bit) { return (i >> bit & 1) != 0 ? kMin32 : kMax32; };
    rules.dig_zone[i] = {end(0), end(1), end(1), end(0), end(0), end(1)};
  }
  for (int k = 0; k < 24; ++k) {
    choose(*choice, k);
    check(s);
    level(*map, -20000);
    check(s);
    level(*map, 20000);
  }
  rules.own_body_radius_mm = 32000;
  EXPECT_EQ(check(s).verdict, SK_BLOCKED_UNKNOWN);
  s.link = 1;
  EXPECT_TRUE(same(check(s), {SK_CLEAR, -1, -1, 104 * 104}));
  rules.own_body_radius_mm = 0;
  rules.dig_zone[3] = {kMin32, kMin32, kMax32, kMax32, kMin32, kMax32};
  EXPECT_TRUE(same(check(s), {SK_CLEAR, -1, -1, 104 * 104}));
}

}  // namespace
}  // namespace berm::core_test
