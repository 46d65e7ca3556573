// How far the surface that the digs left lies from what the app planned of them.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace berm::run {

struct HeightField {
  double x0 = 0, y0 = 0, cell = 0;  // the low corner, the cells' side, m
  int nx = 0, ny = 0;
  std::vector<double> height;       // at the cells' centres, row by row, x fastest
};

// A height field that the plant wrote (terrain_end.csv). Throws std::runtime_error with one line.
HeightField read_height_field(const std::string& path);

// A dig as the app told of it before it began: the shape in the plane of the swing that it was to leave, and how far inward it was followed.
struct PlannedDig {
  double bearing = 0.0;                      // swing angle, rad
  std::vector<std::array<double, 2>> shape;  // r, z of the ground, from the start of the drag inward, m
  double reached_r = 0.0;                    // the drag ended here, m
  double time_s = 0.0;                       // of its end
  double base_x = 0.0, base_y = 0.0;         // where the machine stood in the world, m
};

// From the events "dig" (bearing_deg, shape) and "dug" (r_m, time_s).
std::vector<PlannedDig> planned_digs(const std::vector<nlohmann::json>& app_events);

// Where the machine stood at each dig: truth.json's bench_moves.
void place_digs(std::vector<PlannedDig>& digs, const nlohmann::json& truth);

// Mean distance, in the plane of the swing, between the surface and the planned shape: over the cells whose centres lie within half_width of a dig's
// plane and beside that part of its drag that was followed; of several digs that passed a cell the last counts. None when there is no such cell.
std::optional<double> dig_surface_error_m(const HeightField& surface, const std::vector<PlannedDig>& digs, double half_width);

}  // namespace berm::run
