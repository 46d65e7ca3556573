#include "perception/second_sweep.hpp"

#include <cmath>

namespace berm::app {

SecondSweep::SecondSweep() : waiting_(static_cast<std::size_t>(side * side)) {}

bool SecondSweep::confirms(const TerrainMap& terrain, double x, double y, double z, double time_s) {
  const double ix = std::floor((x + TerrainMap::half_side) / TerrainMap::cell), iy = std::floor((y + TerrainMap::half_side) / TerrainMap::cell);
  if (!(ix >= 0.0 && iy >= 0.0 && ix < side && iy < side)) return false;
  const auto earlier = [time_s](double then_s) { return then_s >= 0.0 && time_s - then_s > same_passage; };
  if (const auto known = terrain.height(x, y); known && earlier(terrain.observed_at(x, y)) && std::fabs(*known - z) <= same_height) return true;
  Waiting& w = waiting_[static_cast<std::size_t>(iy) * side + static_cast<std::size_t>(ix)];
  if (w.time_s >= 0.0 && time_s >= w.time_s && time_s - w.time_s <= same_passage) return false;
  const bool twice = earlier(w.time_s) && time_s - w.time_s <= longest_wait && std::fabs(static_cast<double>(w.z) - z) <= same_height;
  w = {static_cast<float>(z), time_s};
  return twice;
}

}  // namespace berm::app
