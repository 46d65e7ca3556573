// Grazing cases with integer coordinates, so that the true distance is known exactly: touching is not clear, one lattice step apart (about a micrometre)
// is, and one millimetre apart all the more.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "geometry/separation.hpp"
#include "machine_profile.hpp"
#include "pass_over.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 31;
constexpr int64_t now_us = 1000000;
constexpr int32_t ground_mm = -6000;

// A column that stands alone, and a block with a sloping lower face over its corner. The face's normal is (a, a + 1, c) up to the signs of x and y, so
// that (-1, 1, 0), with the same signs, leads away from the column by 1 / |n| mm.
struct Case {
  int32_t n[3], corner[3], iy, ix;
};

int32_t between(std::mt19937_64& random, int32_t low, int32_t high) { return low + static_cast<int32_t>(random() % static_cast<uint64_t>(high - low + 1)); }

Case draw(std::mt19937_64& random) {
  Case c{};
  const int32_t a = between(random, 150, 600), sign_x = between(random, 0, 1) * 2 - 1, sign_y = between(random, 0, 1) * 2 - 1;
  c.n[0] = sign_x * a;
  c.n[1] = sign_y * (a + 1);
  c.n[2] = between(random, 300, 900);
  c.iy = SK_MAP_CELLS / 2 + between(random, -20, 20);
  c.ix = SK_MAP_CELLS / 2 + between(random, -20, 20);
  c.corner[0] = SK_MAP_ORIGIN_MM + (c.ix + (sign_x > 0 ? 1 : 0)) * SK_CELL_MM;
  c.corner[1] = SK_MAP_ORIGIN_MM + (c.iy + (sign_y > 0 ? 1 : 0)) * SK_CELL_MM;
  c.corner[2] = between(random, -500, 1500);
  return c;
}

class Scene {
public:
  Scene() : map_(std::make_unique<sk_height_map>()), columns_(std::make_unique<sk_columns>()), choice_(std::make_unique<sk_choice>()) {
    rules_.now_us = now_us;
    rules_.fresh_us = 1000000;
    berm::test::pass_over(rules_);
  }
  void stand(const Case& c) {
    sk_map_clear(map_.get());
    for (int32_t iy = 0; iy < SK_MAP_CELLS; ++iy)
      for (int32_t ix = 0; ix < SK_MAP_CELLS; ++ix) ASSERT_TRUE(sk_map_insert(map_.get(), iy, ix, iy == c.iy && ix == c.ix ? c.corner[2] : ground_mm, now_us, 1000000));
    ASSERT_TRUE(sk_columns_of(map_.get(), &rules_, columns_.get()));
  }
  // The block moved by so many steps away, and up.
  int32_t verdict(const Case& c, int32_t steps, int32_t up_mm) {
    const int32_t u[3] = {c.n[1], -c.n[0], 0}, v[3] = {c.n[2], 0, -c.n[0]};
    const int32_t away[3] = {c.n[0] > 0 ? -steps : steps, c.n[1] > 0 ? steps : -steps, up_mm};
    const int32_t around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    sk_slice slice{};
    slice.link = 3;
    slice.vertices = 8;
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k) slice.xyz_mm[k][i] = c.corner[k] + away[k] + around[i % 4][0] * u[k] + around[i % 4][1] * v[k] + (i < 4 ? 0 : c.n[k]);
    slice.planes = 1;
    slice.plane[0] = {0, 0, 1, *std::min_element(slice.xyz_mm[2], slice.xyz_mm[2] + 8) - 1};
    PlaneCandidates candidates{};
    candidates.count = 1;
    candidates.nx[0] = c.n[0];
    candidates.ny[0] = c.n[1];
    candidates.nz[0] = c.n[2];
    candidates.offset[0] = static_cast<float>(plane_offset(slice, c.n[0], c.n[1], c.n[2]) + 1);
    choose_planes(*map_, *columns_, rules_, candidates, slice, *choice_);
    sk_clearance_result result{};
    sk_clear_slice(map_.get(), &slice, choice_.get(), &rules_, &result);
    if (result.verdict != SK_CLEAR) {
      EXPECT_EQ(result.iy, c.iy);
      EXPECT_EQ(result.ix, c.ix);
    }
    return result.verdict;
  }

private:
  std::unique_ptr<sk_height_map> map_;
  std::unique_ptr<sk_columns> columns_;
  std::unique_ptr<sk_choice> choice_;
  sk_clearance_rules rules_{};
};

} // namespace

// verifies: SK-CL-6, SK-GE-10, SK-GE-28
TEST(Grazing, ASlopingFaceOverACornerIsDecidedExactly) {
  std::mt19937_64 random(seed);
  Scene scene;
  for (int i = 0; i < 200; ++i) {
    const Case c = draw(random);
    scene.stand(c);
    ASSERT_EQ(scene.verdict(c, 0, -1), SK_BLOCKED_COLLISION) << "1 mm deep; seed " << seed << " case " << i;
    ASSERT_EQ(scene.verdict(c, -1, 0), SK_BLOCKED_COLLISION) << "a step deep; seed " << seed << " case " << i;
    ASSERT_EQ(scene.verdict(c, 0, 0), SK_BLOCKED_COLLISION) << "touching; seed " << seed << " case " << i;
    ASSERT_EQ(scene.verdict(c, 1, 0), SK_CLEAR) << "a step apart; seed " << seed << " case " << i;
    ASSERT_EQ(scene.verdict(c, 0, 1), SK_CLEAR) << "1 mm apart; seed " << seed << " case " << i;
  }
}

// Real slices over ground that reaches exactly to their lowest vertex, by the check of heights alone and by the whole.
// verifies: SK-CL-6, SK-CO-3, SK-GE-28
TEST(Grazing, GroundAtTheLowestVertexTouchesASlice) {
  std::mt19937_64 random(seed + 1);
  const auto set = std::make_unique<SliceSet>();
  const auto map = std::make_unique<sk_height_map>();
  const auto columns = std::make_unique<sk_columns>();
  const auto choice = std::make_unique<sk_choice>();
  sk_clearance_rules rules{};
  rules.now_us = now_us;
  rules.fresh_us = 1000000;
  rules.margin_mm = 300;
  berm::test::pass_over(rules);
  int asked = 0;
  for (const Machine& machine : machine_profiles())
    for (int n = 0; n < 30; ++n) {
      if (!build_slices(machine.parameters, random_box(machine.parameters, random), *set)) continue;
      const int i = static_cast<int>(random() % static_cast<uint64_t>(set->count));
      sk_footprint footprint{};
      if (!sk_slice_footprint(&set->slice[i], &footprint)) continue;
      int lowest = 0;
      for (int v = 0; v < set->slice[i].vertices; ++v)
        if (set->slice[i].xyz_mm[2][v] < set->slice[i].xyz_mm[2][lowest]) lowest = v;
      const int32_t iy = sk_map_index(set->slice[i].xyz_mm[1][lowest]), ix = sk_map_index(set->slice[i].xyz_mm[0][lowest]);
      ++asked;
      for (const int32_t gap_mm : {1, 0}) { // top of the column below the lowest vertex, right over it
        sk_map_clear(map.get());
        for (int32_t y = 0; y < SK_MAP_CELLS; ++y)
          for (int32_t x = 0; x < SK_MAP_CELLS; ++x)
            ASSERT_TRUE(sk_map_insert(map.get(), y, x, y == iy && x == ix ? footprint.z_low_mm - rules.margin_mm - gap_mm : -15000, now_us, 1000000));
        ASSERT_TRUE(sk_columns_of(map.get(), &rules, columns.get()));
        ASSERT_EQ(sk_clear_level(map.get(), columns.get(), &set->slice[i], &rules), gap_mm == 1) << "seed " << seed + 1 << " box " << n;
        const sk_clearance_result result = clear_slice(*map, *columns, rules, *set, i, *choice);
        ASSERT_EQ(result.verdict, gap_mm == 1 ? SK_CLEAR : SK_BLOCKED_COLLISION) << "seed " << seed + 1 << " box " << n;
      }
    }
  EXPECT_GT(asked, 20);
}

} // namespace berm::kernel::test
