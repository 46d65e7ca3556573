// What a shift brings, drawn from a seed: trucks of all sizes, people who come into the region or walk by, dust, rain and drying, and how long the
// operator takes. Written as a scenario (scenarios/FORMAT.md), so that `berm load` can run it again.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace berm::soak {

struct DrawnTruck { double x, y, yaw_deg, length, width, height, wall_top, wait_s; };
struct DrawnVisit { double wait_s; bool enters; std::array<std::array<double, 2>, 2> way; };  // waits far off, then goes there and back
struct DrawnPerson { double height, radius, speed; std::vector<DrawnVisit> visits; };
struct DrawnDust { double at_s, for_s, probability, lost; };
struct DrawnSoil { double at_s, repose_deg, bank_slope_deg, resistance, stick_fraction; };

struct DrawnShift {
  double seconds = 0.0;
  std::uint64_t seed = 0;
  std::vector<DrawnTruck> trucks;
  std::vector<DrawnPerson> people;
  std::vector<DrawnDust> dust;
  std::vector<DrawnSoil> soil;  // changes
};

DrawnShift draw_shift(double hours, std::uint64_t seed);

// How many trucks a shift could take at most.
int trucks_enough(double hours);

std::string scenario_text(const DrawnShift& shift);

// Whether a file is such a text, or not there: one that somebody wrote himself is his.
bool may_be_overwritten(const std::string& scenario);

}  // namespace berm::soak
