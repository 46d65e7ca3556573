// People in the app's own sweeps: who is never missed, and who can be, as the page says.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "draw.hpp"
#include "mini_machine.hpp"

namespace berm::kernel::test {
namespace {

constexpr std::uint64_t kSeed = 90818;
constexpr int kSweeps = 150;

struct Person {
  const char* name;
  double broad, deep, height;  // m, an ellipse
};
constexpr Person kAdult = {"adult", 0.45, 0.25, 1.75}, kChild = {"child", 0.28, 0.16, 1.10};

Prism standing(const Person& person, Spot at, double yaw) {
  Prism body{{}, 0.0, person.height};
  constexpr int kSides = 16;
  for (int i = 0; i < kSides; ++i) {
    const double a = 2 * 3.14159265358979323846 * i / kSides, u = 0.5 * person.broad * std::cos(a), v = 0.5 * person.deep * std::sin(a);
    body.footprint.push_back({at.x + u * std::cos(yaw) - v * std::sin(yaw), at.y + u * std::sin(yaw) + v * std::cos(yaw)});
  }
  return body;
}

// In how many of kSweeps sweeps nothing of the person rises half a metre over the ground.
int missed(const Person& person, double distance, std::mt19937_64& random) {
  const berm_parameters parameters = berm::test::demo_parameters();
  const PanRates rates = pan_rates(parameters);
  int count = 0;
  for (int i = 0; i < kSweeps; ++i) {
    Placed placed = draw_thing(parameters, distance, person.broad, 0.0, person.height, random);
    placed.sweep->scene.thing[0] = standing(person, placed.sweep->at(placed.scanner, placed.pan, distance), uniform(random, -3.1, 3.1));
    placed.sweep->beam_rad = kBeamWidth;
    placed.pass(rates.app, random);
    count += highest_top(placed.sweep->map(), placed.thing().footprint) < 500 ? 1 : 0;
  }
  std::cout << person.name << " at " << distance << " m: missed in " << count << " of " << kSweeps << " sweeps at the app's rate\n";
  return count;
}

// verifies: SK-FI-1, SK-FI-8
TEST(People, InASweep) {
  std::mt19937_64 random(kSeed);
  std::cout << "seed " << kSeed << "\n";
  EXPECT_EQ(missed(kAdult, 5.0, random), 0);
  EXPECT_EQ(missed(kChild, 5.0, random), 0);
  EXPECT_EQ(missed(kAdult, 9.5, random), 0);
  // Else the page says too much: its paragraph "Not acceptable, and open".
  EXPECT_GT(missed(kChild, 10.0, random), 0);
  EXPECT_GT(missed(kAdult, 15.0, random), 0);
  EXPECT_GT(missed(kChild, 15.0, random), 0);
}

}  // namespace
}  // namespace berm::kernel::test
