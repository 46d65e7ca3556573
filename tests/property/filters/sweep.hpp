// A panning scanner over a scene: its packets go through the kernel's own intake into a height map. The upper body stands still.
#pragma once

#include <functional>
#include <memory>
#include <random>

#include "core/height_map.h"
#include "geometry/joint_history.hpp"
#include "io/scan_intake.hpp"
#include "scene.hpp"

namespace berm::kernel::test {

double uniform(std::mt19937_64& random, double low, double high);
double degrees(double value);  // in radians

class Sweep {
 public:
  Sweep(const berm_parameters& parameters, double swing_rad);                          // the arm up and out of the way
  Sweep(const berm_parameters& parameters, const std::array<double, 4>& angle_rad);

  Scene scene;
  double beam_rad = 0.0;                     // width of the beam; 0: a line
  std::int64_t lost_from_us = 0, lost_to_us = 0;  // packets of samples taken in this time do not arrive

  // The scanner pans from one angle to the other (relative to the upper body), its mirror somewhere in its turn: phase 0..399 is the first sample's
  // place, and may be a fraction: the pan is at `from` that fraction of a sample earlier.
  void pan(int scanner, double from_rad, double to_rad, double rate_rad_s, double phase);
  // The scanner stands, and its mirror turns.
  void stare(int scanner, double pan_rad, double seconds, double phase);
  void wait(double seconds) { time_ns_ += static_cast<std::int64_t>(seconds * 1e9); }
  // Called after every packet that was taken.
  std::function<void()> watch;

  std::int64_t now_us() const { return time_ns_ / 1000; }
  sk_height_map& map() { return *map_; }
  std::uint32_t points() const { return intake_.points(); }

  Spot head(int scanner) const;                                       // base frame
  double bearing(double pan_rad) const { return pan_rad + swing_rad_; }  // base frame
  Spot at(int scanner, double pan_rad, double distance) const;        // horizontally from the head

 private:
  void run(int scanner, double from_rad, double rate_rad_s, double seconds, double phase);
  void measure(const std::array<double, 3>& from, double pan_rad, double elevation_rad, std::uint16_t (&echo)[BERM_SCAN_ECHOES]) const;
  void send(const berm_scan_packet& packet);

  const berm_parameters& parameters_;
  double swing_rad_;
  ScanIntake intake_;
  JointHistory joints_;
  std::unique_ptr<sk_height_map> map_ = std::make_unique<sk_height_map>();
  std::unique_ptr<ScanBlocks> blocks_ = std::make_unique<ScanBlocks>();
  std::int64_t time_ns_ = 1'000'000'000;
  std::uint32_t sequence_[2] = {}, line_[2] = {};
};

// The highest top of the cells that hold a part of the footprint, mm.
std::int32_t highest_top(const sk_height_map& map, const std::vector<Spot>& footprint);
// The same cells: whether each is observed, no older than this, and no higher than top_mm.
bool all_low(const sk_height_map& map, const std::vector<Spot>& footprint, std::int64_t not_before_us, std::int32_t top_mm);

struct CellRange {
  int x_low, x_high, y_low, y_high;
};
CellRange cells_of(const std::vector<Spot>& footprint);
Spot cell_low(int ix, int iy);  // corner, m
constexpr double kCell = SK_CELL_MM * 1e-3;
bool in_map(const std::vector<Spot>& footprint);

}  // namespace berm::kernel::test
