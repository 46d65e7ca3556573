// A site as its TOML file has it (CONFIG.md): base frame, metres, radians.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace berm::config {

struct DigZoneFile { double x_low, x_high, y_low, y_high, floor, ceiling; };
struct GroundZoneFile { double x_low, x_high, y_low, y_high, pass_over; };  // lower ground
struct TruckZoneFile { double x_low, x_high, y_low, y_high, ceiling; };
struct LaneFile { double x_low, x_high, y_low, y_high; };

struct TruckPlaceFile {            // where trucks park
  std::array<double, 2> centre;    // about the middle of the bed
  double yaw;                      // of the bed's long axis, either way round, from base x
  double target_kg;
};

struct GoalPartFile {              // of the shape that digs are to leave
  double x_low, x_high, y_low, y_high;
  double level;                    // z at its middle
  std::array<double, 2> slope;     // rise over run along x and y
};

struct DigFile {
  std::array<double, 2> swing;     // leftmost and rightmost dig bearing, rad
  std::array<double, 2> radius;    // of the tip at the start and at the end of the drag
  double floor;                    // z of the ground that digs leave
  double bench_height;             // a higher face is taken bench by bench
  std::vector<GoalPartFile> goal;  // where it is higher than the floor: none, or rectangles; of several that meet the later one counts
};

struct SiteFile {
  std::string name;
  std::vector<DigZoneFile> dig_zone;
  double pass_over;                // z: what stands higher the implements do not pass over
  std::vector<GroundZoneFile> ground_zone;
  std::vector<TruckZoneFile> truck_zone;
  std::vector<LaneFile> truck_lane;  // where trucks come and go
  TruckPlaceFile truck;
  DigFile dig;
};

// Throws ConfigError (strict_table.hpp) with one line: file, field, limit.
SiteFile load_site_file(const std::string& path);

}  // namespace berm::config
