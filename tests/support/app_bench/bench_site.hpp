// A tiny site for the app's tests: bench, slope, truck with a bed, as heights on a grid; soil that is cut and dumped.
#pragma once

#include <vector>

namespace berm::app_bench {

class BenchSite {
public:
  BenchSite();

  double height(double x, double y) const;          // ground, truck and soil in the bed
  bool in_bed(double x, double y) const;
  bool on_truck(double x, double y) const;          // bed with walls, or cab
  // Takes the soil above z from a lateral strip; bank m3 taken.
  double cut(double x, double y, double bearing, double half_width, double z);
  // One step of what was cut sliding after; call it once a cycle.
  void slump();
  void dump(double x, double y, double mass_kg);
  void heap_up(double x, double y, double radius, double top);  // of the base frame; as steep as a wall, it stays
  void new_truck();
  // The base slips by so much: everything lies so much the other way from where it was.
  void slip(double x, double y);

  double bed_mass() const { return bed_mass_; }
  double spilled_mass() const { return spilled_mass_; }
  // Mass in each third of the bed along its long axis.
  double third(int i) const { return third_[i]; }

  static constexpr double wall_top = 0.30;

private:
  static constexpr double cell = 0.1, half_side = 16.0;
  static constexpr int side = 320;
  static int index(double v);
  double& ground(double x, double y);               // base frame
  double ground(double x, double y) const;

  double slipped_x_ = 0.0, slipped_y_ = 0.0;        // base in the site; everything below is in the site
  std::vector<double> ground_;
  int low_x_ = side, high_x_ = -1, low_y_ = side, high_y_ = -1;  // cells about what was cut
  double bed_mass_ = 0.0, spilled_mass_ = 0.0;
  double third_[3] = {0.0, 0.0, 0.0};
};

}  // namespace berm::app_bench
