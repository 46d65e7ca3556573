// A base that stands still is not called slipped, whatever moves around it; and where nothing can be seen nothing is claimed.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include "watch.hpp"

namespace berm::registration_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Two people who walk up and away, a truck that leaves and one that parks some decimetres from where it stood, heaps and pits beside the machine.
class Traffic {
 public:
  explicit Traffic(Site& site) : site_(site) {
    site.things.assign(3, {});
    site.things[0] = {-0.7, 6.75, 0.0, 7.4, 2.6, 0.3};
    for (int i = 1; i < 3; ++i) site.things[static_cast<std::size_t>(i)] = {100, 100, 0, 0.5, 0.5, 1.8};
  }

  void operator()(double now_s) {
    truck(now_s);
    for (std::size_t i = 1; i < 3; ++i) {
      const double walked = 1.4 * (now_s - 8.0 * static_cast<double>(i)), way = std::fmod(std::max(walked, 0.0), 30.0), heading = static_cast<double>(i) * 1.9;
      const double away = std::fabs(way - 15.0) + 4.0;  // in from 19 m to 4 m, and out
      site_.things[i].x = away * std::cos(heading);
      site_.things[i].y = away * std::sin(heading);
    }
    if (now_s < next_heap_s_) return;
    next_heap_s_ = now_s + 3.0;
    const double bearing = draw(site_, -kPi, kPi), distance = draw(site_, 4.0, 10.0);
    site_.dig(distance * std::cos(bearing), distance * std::sin(bearing), draw(site_, 0.4, 1.2), draw(site_, -0.4, 0.4));
  }

 private:
  void truck(double now_s) {
    const double phase = std::fmod(now_s, 50.0);
    Thing& truck = site_.things[0];
    if (phase < 35.0) {
      truck.x = place_;
      truck.top = 0.3 + 0.6 * phase / 35.0;  // it is loaded
    } else if (phase < 42.0) {
      truck.x = place_ - 2.5 * (phase - 35.0);
      drawn_ = false;
    } else {
      if (!drawn_) place_ = -0.7 + draw(site_, -0.5, 0.5), side_ = 6.75 + draw(site_, -0.4, 0.4);
      drawn_ = true;
      truck.y = side_;
      truck.x = place_ - 2.5 * (49.0 - std::min(phase, 49.0));
      truck.top = 0.3;
    }
  }

  Site& site_;
  double next_heap_s_ = 30.0, place_ = -0.7, side_ = 6.75;
  bool drawn_ = false;
};

void still(const char* what, const SiteConfig& config, std::uint64_t count, double seconds, bool confirmed) {
  const Seeds s = seeds(count);
  std::uint64_t rounds = 0, excluded = 0;  // excluded: by a terrain that is trusted to show slips
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    Watch watch(config, seed);
    Traffic traffic(watch.site);
    watch.run(seconds, traffic);
    EXPECT_LT(watch.found_s, 0) << again(seed) << ": called slipped at " << watch.found_s << " s";
    rounds += watch.registration->rounds();
    excluded += watch.registration->rounds_confirmed();
  }
  std::cout << what << ", seeds " << s.first << " to " << s.first + s.count - 1 << ", " << seconds << " s each: " << excluded << " of " << rounds << " rounds excluded every slip\n";
  if (confirmed) EXPECT_GT(2 * excluded, rounds) << "a registration that cannot say where it stands is no watch";
  else EXPECT_LT(50 * excluded, rounds) << "hardly anything can be seen here, and hardly anything may be claimed";
}

// verifies: SK-BM-20, SK-BM-23
TEST(Still, PeopleTrucksAndDiggingAreNoSlip) { still("bench of 20 mm relief", {}, 6, 120.0, true); }

// verifies: SK-BM-23, SK-BM-25
TEST(Still, LevelGroundWithoutReliefShowsNoSlipAndSaysSo) {
  SiteConfig config;
  config.relief_m = 0.0;
  config.edges = false;
  still("level ground without relief", config, 6, 120.0, false);
}

// verifies: SK-BM-23
TEST(Still, EdgesWithoutRelief) {
  SiteConfig config;
  config.relief_m = 0.0;
  const Seeds s = seeds(4);
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    Watch watch(config, seed);
    Traffic traffic(watch.site);
    watch.run(120.0, traffic);
    EXPECT_LT(watch.found_s, 0) << again(seed) << ": called slipped at " << watch.found_s << " s";
  }
}

// What its frames do not show of a tilt or a turn is no slip either: up to 0.37 degrees (SK-BM-2, SK-BM-4).
// verifies: SK-BM-23
TEST(Still, ATurnBelowItsLimitIsNoSlip) {
  const Seeds s = seeds(4);
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    Watch watch({}, seed);
    watch.run(25.0);
    watch.site.base_yaw = (seed % 2 == 0 ? 1 : -1) * 0.37 * kPi / 180;
    watch.run(60.0);
    EXPECT_LT(watch.found_s, 0) << again(seed) << ": called slipped at " << watch.found_s << " s";
  }
}

// Contradictory returns behind the 48 of a cycle change nothing.
// verifies: SK-BM-26
TEST(Still, ReturnsBeyondTheCyclesShareHaveNoVote) {
  using kernel::TerrainRegistration;
  std::vector<sk_point> place;  // one in each cell
  for (std::int32_t y = -11925; y < 12000; y += TerrainRegistration::cell_mm)
    for (std::int32_t x = -11925; x < 12000; x += TerrainRegistration::cell_mm)
      place.push_back({x, y, static_cast<std::int32_t>(std::lround(30 * std::sin(x / 310.0 + y / 770.0) + 30 * std::sin(y / 260.0 - x / 530.0)))});
  std::erase_if(place, [](const sk_point& p) { return std::hypot(p.x_mm, p.y_mm) < 3300 || std::hypot(p.x_mm, p.y_mm) > 11800 || (p.x_mm > 3200 && std::abs(p.y_mm) < 4900); });
  const auto few = std::make_unique<TerrainRegistration>(site_parameters()), many = std::make_unique<TerrainRegistration>(site_parameters());
  for (auto* registration : {few.get(), many.get()})
    for (int i = 0; i < 16; ++i)  // the reference is full
      for (const sk_point& p : place) registration->take(p);
  std::size_t next = 0;
  for (std::int64_t cycle = 0; cycle < 3000; ++cycle) {
    for (int i = 0; i < TerrainRegistration::returns_a_cycle; ++i, next = (next + 7) % place.size()) {
      few->take(place[next]);
      many->take(place[next]);
    }
    for (std::size_t i = 0; i < 200; ++i) {
      sk_point wrong = place[(next + 1 + 7 * i) % place.size()];
      wrong.z_mm += 150;
      many->take(wrong);
    }
    few->step(cycle * 10000);
    many->step(cycle * 10000);
  }
  EXPECT_GT(few->rounds_confirmed(), 20U);
  EXPECT_EQ(many->rounds_confirmed(), few->rounds_confirmed());
  EXPECT_FALSE(many->slipped());
}

}  // namespace
}  // namespace berm::registration_test
