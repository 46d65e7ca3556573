// The ground of the dig zones as the app believes it to be. A cut face hides itself, and what slides down it, from a scanner above its crest: what is
// seen is taken as it is seen; what is hidden is what was there before, less what the bucket took, with loose soil slid to rest before a face that stands steeper than it.
#pragma once

#include <vector>

#include "planning/site_model.hpp"
#include "planning/terrain_map.hpp"

namespace berm::app {

class DigGround {
public:
  static constexpr double cell = TerrainMap::cell;  // m; the cells are the map's

  explicit DigGround(const SiteModel& site);
  // After the machine was moved straight back by this many metres: hidden ground of which nothing is believed yet is no higher than it was believed before.
  DigGround(const SiteModel& site, const DigGround& before, double back);

  // Takes over what was measured since the last time. A hidden cell of which nothing is believed yet falls from the seen ground nearer to the machine at the
  // slope of a cut bank, down to the seen ground beyond it, and is no higher than before a move.
  void observe(const TerrainMap& terrain);
  // The bucket passed at this height: the ground is no higher.
  void lower_to(double x, double y, double z);
  // What stands too steep slides, from cell to cell; no soil is lost.
  void settle();
  // Of the nearest cell, for places outside.
  double height(double x, double y) const;

private:
  std::size_t index(int ix, int iy) const { return static_cast<std::size_t>(iy * nx_ + ix); }
  double centre_x(int ix) const { return x_low_ + (ix + 0.5) * cell; }
  double centre_y(int iy) const { return y_low_ + (iy + 0.5) * cell; }
  double believed(double x, double y) const;  // NAN: nothing is, or outside
  double guess(const TerrainMap& terrain, double x, double y) const;

  double x_low_ = 0.0, y_low_ = 0.0;
  int nx_ = 0, ny_ = 0;
  std::vector<double> no_higher_;      // NAN: nothing is known from before
  std::vector<double> height_, bank_;  // NAN: nothing is believed yet; the firm soil under the loose
  std::vector<double> seen_s_;         // time of the measurement that was taken over last, -1 none
};

}  // namespace berm::app
