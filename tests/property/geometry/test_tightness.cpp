// How much larger the slices are than the sweep they cover: needless volume is needless stops.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "exact_hull.hpp"
#include "geometry/swept_slices.hpp"
#include "implement_sampler.hpp"

namespace berm::kernel::test {
namespace {

constexpr uint64_t seed = 77;
constexpr double voxel_mm = 100.0;
constexpr int cells = 240; // 24 m about the axis

// Cubes touched by a sampled point, of the sweep and of the slices alike.
class Voxels {
public:
  Voxels() : mark_(static_cast<size_t>(cells) * cells * cells, false) {}
  static int index(double v_mm, double origin_mm) { return static_cast<int>(std::floor((v_mm - origin_mm) / voxel_mm)); }
  static constexpr double origin_mm = -12000.0, floor_mm = -9000.0;

  void mark(int ix, int iy, int iz) {
    if (ix < 0 || iy < 0 || iz < 0 || ix >= cells || iy >= cells || iz >= cells) return;
    mark_[(static_cast<size_t>(iz) * cells + static_cast<size_t>(iy)) * cells + static_cast<size_t>(ix)] = true;
  }
  long count() const { return std::count(mark_.begin(), mark_.end(), true); }

private:
  std::vector<bool> mark_;
};

long voxels_of_slices(const SliceSet& set, std::mt19937_64& random) {
  constexpr int points_per_voxel = 12;
  Voxels voxels;
  for (int s = 0; s < set.count; ++s) {
    const ExactHull hull(set.slice[s]);
    const int low[3] = {Voxels::index(hull.low()[0], Voxels::origin_mm), Voxels::index(hull.low()[1], Voxels::origin_mm), Voxels::index(hull.low()[2], Voxels::floor_mm)};
    const int high[3] = {Voxels::index(hull.high()[0], Voxels::origin_mm), Voxels::index(hull.high()[1], Voxels::origin_mm), Voxels::index(hull.high()[2], Voxels::floor_mm)};
    for (int iz = low[2]; iz <= high[2]; ++iz)
      for (int iy = low[1]; iy <= high[1]; ++iy)
        for (int ix = low[0]; ix <= high[0]; ++ix)
          for (int i = 0; i < points_per_voxel; ++i) {
            const double x = Voxels::origin_mm + (ix + uniform(random, 0, 1)) * voxel_mm, y = Voxels::origin_mm + (iy + uniform(random, 0, 1)) * voxel_mm;
            if (!hull.contains(x, y, Voxels::floor_mm + (iz + uniform(random, 0, 1)) * voxel_mm)) continue;
            voxels.mark(ix, iy, iz);
            break;
          }
  }
  return voxels.count();
}

long voxels_of_sweep(const berm_parameters& parameters, const sk_reach_box& box, long samples, std::mt19937_64& random) {
  Voxels voxels;
  const ImplementSampler sampler(parameters, box);
  for (long i = 0; i < samples; ++i) {
    const ImplementPoint p = sampler.draw(random);
    voxels.mark(Voxels::index(p.x, Voxels::origin_mm), Voxels::index(p.y, Voxels::origin_mm), Voxels::index(p.z, Voxels::floor_mm));
  }
  return voxels.count();
}

} // namespace

// verifies: SK-GE-9
TEST(SweptSlices, AreNotMuchLargerThanTheSweep) {
  constexpr double urad_per_degree = 1e6 * 3.141592653589793 / 180.0;
  struct Case {
    const char* name;
    double middle[4], width[4], limit;
  };
  const Case cases[] = {{"standing", {45, 40, -95, -60}, {0.3, 0.3, 0.3, 0.3}, 1.3},
                        {"carrying at full speed", {45, 40, -95, -60}, {60, 8, 8, 8}, 1.5},
                        {"slow dig", {0, 10, -100, -30}, {2, 2, 4, 6}, 1.4}};
  const auto set = std::make_unique<SliceSet>();
  std::mt19937_64 random(seed);
  const long samples = sample_count(4000000);
  for (const Machine& machine : machine_profiles())
    for (const Case& c : cases) {
      sk_reach_box box{};
      for (int j = 0; j < 4; ++j) {
        box.low_urad[j] = static_cast<int32_t>((c.middle[j] - 0.5 * c.width[j]) * urad_per_degree);
        box.high_urad[j] = static_cast<int32_t>((c.middle[j] + 0.5 * c.width[j]) * urad_per_degree);
      }
      ASSERT_TRUE(build_slices(machine.parameters, box, *set));
      const double slices = static_cast<double>(voxels_of_slices(*set, random)), sweep = static_cast<double>(voxels_of_sweep(machine.parameters, box, samples, random));
      std::cout << machine.name << ", " << c.name << ": slices " << slices * 1e-3 << " m3, sampled sweep " << sweep * 1e-3 << " m3, ratio " << slices / sweep << "\n";
      EXPECT_LT(slices / sweep, c.limit);
      EXPECT_GT(slices, 0.0);
    }
}

} // namespace berm::kernel::test
