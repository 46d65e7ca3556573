// What each filter can hide, computed from the machine's parameters by formulae of the tests' own; the page's table is held against it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/parameter_block.h"

namespace berm::kernel::test {

constexpr std::array<double, 3> kDistances = {5.0, 10.0, 15.0};  // m

// Of the panning scanners (SCAN.md, the papers), the VLP-16 (its manual), and assumed.
constexpr int kSamplesPerTurn = 400;
constexpr double kSamplePeriod = 83333e-9;  // s
constexpr double kLinePeriod = kSamplesPerTurn * kSamplePeriod;
constexpr double kBeamWidth = 0.003;        // rad, assumed for the panning scanners too
constexpr double kPacketTime = 0.01;        // s that a packet spans, at most
constexpr double kLidarHeight = 1.8, kLidarTurnsPerSecond = 10.0, kLidarFiring = 55.296e-6;

struct PanRates {  // of the scanlines over the ground, rad/s
  double app, commander;  // while the swing is slow
  double full_swing;      // either, in the fastest swing: the pan is never slower than 1 deg/s
  double limit;           // the most that the kernel passes on
};
PanRates pan_rates(const berm_parameters& parameters);

// Widths and heights that can be hidden at a horizontal distance, m.
double line_gap(double distance, double azimuth_rate);                                   // SK-FI-1
double row_height(const berm_parameters& parameters, double distance, int rows);        // SK-FI-2, SK-FI-3
double own_layer(const berm_parameters& parameters, double distance);                   // SK-FI-4, in the swing plane
double implement_reach(const berm_parameters& parameters);                              // from the swing axis
double whole_cell();                                                                    // SK-FI-7, SK-FI-12: covers a cell
double beam_width(const berm_parameters& parameters, double distance);                  // SK-FI-8
double lidar_step(double distance);                                                     // SK-FI-9
double lidar_gap(double distance);                                                      // SK-FI-9
double silent_gap(const berm_parameters& parameters, double distance, double azimuth_rate);  // SK-FI-10
double cell_crossing(double distance, double azimuth_rate);                             // SK-FI-13, s

// A cell of the table: "W x H", "W x H, T s", or "none". A side without bound is "any".
struct Hidden {
  static constexpr double kAny = -1.0, kNone = 0.0;
  double width = kNone, height = kNone, seconds = kAny;  // seconds: kAny where the cell does not say
};
struct Row {
  std::string id, what;
  std::array<Hidden, 3> at;
};

std::vector<Row> computed_rows(const berm_parameters& parameters);
// The table of safety_kernel/requirements/filters.md. Throws std::runtime_error, with the line, for what is no cell.
std::vector<Row> page_rows();
// At how many degrees a second, at most, a child seen from the side is found, as the page says.
std::array<double, 3> child_rates();
// The page's figure; throws where the page has no such row.
Hidden stated(const std::string& what, std::size_t distance);

}  // namespace berm::kernel::test
