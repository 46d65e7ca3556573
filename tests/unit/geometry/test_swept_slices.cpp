#include "geometry/swept_slices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "geometry/slice_planes.hpp"
#include "machine_profile.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 9;
constexpr double urad_per_degree = 1e6 * 3.141592653589793 / 180.0;

class SweptSlicesUnit : public ::testing::Test {
protected:
  SweptSlicesUnit() : parameters(machine_profiles().front().parameters), set(std::make_unique<SliceSet>()) {
    for (int j = 0; j < 4; ++j) box.low_urad[j] = box.high_urad[j] = (parameters.joint_low_urad[j] + parameters.joint_high_urad[j]) / 2;
  }
  void swing(double low_deg, double high_deg) {
    box.low_urad[0] = static_cast<int32_t>(low_deg * urad_per_degree);
    box.high_urad[0] = static_cast<int32_t>(high_deg * urad_per_degree);
  }
  void expect_refused() {
    set->count = 7;
    EXPECT_FALSE(build_slices(parameters, box, *set));
    EXPECT_EQ(set->count, 0);
  }

  berm_parameters parameters;
  sk_reach_box box{};
  std::unique_ptr<SliceSet> set;
};

} // namespace

// verifies: SK-GE-5
TEST_F(SweptSlicesUnit, DivideTheSwingIntoAtMostFiveDegrees) {
  const struct {
    double low, high;
    int intervals;
  } cases[] = {{10, 10, 1}, {10, 10.001, 1}, {-2, 2.9, 1}, {0, 5.1, 2}, {0, 59.9, 12}, {-90, 90.1, 37}, {0, 199, 40}, {-180, 180, 40}, {-300, 300, 40}};
  for (const auto& c : cases) {
    swing(c.low, c.high);
    ASSERT_TRUE(build_slices(parameters, box, *set));
    EXPECT_EQ(set->count, c.intervals * parameters.parts) << c.low << " to " << c.high;
    for (int i = 0; i < set->count; ++i) {
      EXPECT_EQ(set->slice[i].link, parameters.part[i / c.intervals].link);
      EXPECT_EQ(set->slice[i].vertices, SK_SLICE_VERTICES);
    }
  }
}

// A swing as narrow as this leaves the outline and the part's own width, with the slack and the directions' 30 degrees between them.
// verifies: SK-GE-9
TEST_F(SweptSlicesUnit, OfAStandingPartAreAsWideAsThePart) {
  swing(0, 0);
  ASSERT_TRUE(build_slices(parameters, box, *set));
  for (int i = 0; i < set->count; ++i) {
    int32_t widest = 0;
    for (int v = 0; v < SK_SLICE_VERTICES; ++v) widest = std::max(widest, std::abs(set->slice[i].xyz_mm[1][v]));
    EXPECT_GE(widest, parameters.part[i].half_width_mm + 1);
    EXPECT_LE(widest, parameters.part[i].half_width_mm + 3);
  }
}

// verifies: SK-GE-6
TEST_F(SweptSlicesUnit, RefuseMalformedBoxesAndParameters) {
  ASSERT_TRUE(build_slices(parameters, box, *set));
  const sk_reach_box good = box;
  for (int j = 0; j < 4; ++j) {
    box.low_urad[j] = box.high_urad[j] + 1;
    expect_refused();
    box = good;
    box.low_urad[j] = INT32_MIN;
    expect_refused();
    box = good;
    box.high_urad[j] = INT32_MAX;
    expect_refused();
    box = good;
  }
  const berm_parameters fine = parameters;
  for (const int32_t parts : {0, -1, BERM_PARTS + 1}) {
    parameters.parts = parts;
    expect_refused();
  }
  parameters = fine;
  parameters.part[1].link = 4;
  expect_refused();
  parameters = fine;
  parameters.part[2].vertices = BERM_PART_VERTICES + 1;
  expect_refused();
  parameters = fine;
  parameters.part[0].vertex_mm[1][0] = 40000; // out of the coordinates' range
  expect_refused();
  parameters = fine;
  parameters.boom_pin_z_mm = 40000;
  expect_refused();
}

// verifies: SK-GE-7
TEST_F(SweptSlicesUnit, HaveCandidatePlanesWithEveryVertexStrictlyOnTheirSide) {
  std::mt19937_64 random(seed);
  for (int n = 0; n < 100; ++n) {
    box = random_box(parameters, random);
    ASSERT_TRUE(build_slices(parameters, box, *set));
    for (int i = 0; i < set->count; ++i) {
      sk_slice s = set->slice[i];
      ASSERT_EQ(s.planes, 1); // the rest when it is asked for
      PlaneCandidates candidates;
      plane_candidates_of(*set, i, candidates);
      ASSERT_GE(candidates.count, 7);
      ASSERT_LE(candidates.count, SK_SLICE_PLANES - 1);
      for (int k = 0; k < candidates.count; ++k) {
        const int32_t nx = candidates.nx[k], ny = candidates.ny[k], nz = candidates.nz[k];
        s.plane[s.planes++] = {nx, ny, nz, plane_offset(s, nx, ny, nz)};
        ASSERT_NEAR(static_cast<double>(s.plane[k + 1].d), static_cast<double>(candidates.offset[k]), 4.0 * normal_scale) << "the hint is off";
      }
      int upright = 0, slanted = 0;
      for (int k = 0; k < s.planes; ++k) {
        const sk_plane& p = s.plane[k];
        ASSERT_LE(std::max({std::abs(p.nx), std::abs(p.ny), std::abs(p.nz)}), 2 * normal_scale);
        ASSERT_GE(p.nz, 0);
        int64_t least = INT64_MAX;
        for (int v = 0; v < s.vertices; ++v)
          least = std::min(least, int64_t{p.nx} * s.xyz_mm[0][v] + int64_t{p.ny} * s.xyz_mm[1][v] + int64_t{p.nz} * s.xyz_mm[2][v]);
        ASSERT_EQ(least, p.d + 1) << "seed " << seed << " plane " << k;
        upright += p.nz == 0 ? 1 : 0;
        slanted += p.nz != 0 && (p.nx != 0 || p.ny != 0) ? 1 : 0;
      }
      ASSERT_EQ(s.plane[0].nx, 0);
      ASSERT_EQ(s.plane[0].ny, 0);
      ASSERT_EQ(s.plane[0].nz, 1);
      ASSERT_EQ(upright, 4);
      ASSERT_GE(slanted, 4);
    }
  }
}

// The same box gives the same bytes, whatever was in the set before.
// verifies: SK-GE-15
TEST_F(SweptSlicesUnit, AreAFunctionOfParametersAndBox) {
  swing(-20, 31);
  const auto other = std::make_unique<SliceSet>();
  std::memset(static_cast<void*>(other.get()), 0xA5, sizeof(SliceSet));
  ASSERT_TRUE(build_slices(parameters, box, *set));
  ASSERT_TRUE(build_slices(parameters, box, *other));
  ASSERT_EQ(set->count, other->count);
  for (int i = 0; i < set->count; ++i) {
    const sk_slice &a = set->slice[i], &b = other->slice[i];
    ASSERT_EQ(a.planes, b.planes);
    ASSERT_EQ(std::memcmp(a.xyz_mm, b.xyz_mm, sizeof a.xyz_mm), 0);
    for (int k = 0; k < a.planes; ++k) ASSERT_EQ(std::memcmp(&a.plane[k].nx, &b.plane[k].nx, 3 * sizeof(int32_t)) == 0 && a.plane[k].d == b.plane[k].d, true);
  }
}

} // namespace berm::kernel::test
