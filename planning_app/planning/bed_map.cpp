#include "planning/bed_map.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app {

BedMap::BedMap(const TruckBed& bed)
    : bed_(bed), columns_(static_cast<int>(std::ceil(bed.length / cell))), rows_(static_cast<int>(std::ceil(bed.width / cell))),
      height_(static_cast<std::size_t>(columns_ * rows_), 0.0), time_(height_.size(), -1.0) {}

void BedMap::insert(double x, double y, double z, double time_s) {
  constexpr double hand = 0.15;
  const BedPoint p = to_bed(bed_, x, y);
  if (std::fabs(p.u) > 0.5 * bed_.length - hand || std::fabs(p.v) > 0.5 * bed_.width - hand) return;
  const double above_floor = z - (bed_.wall_top - bed_.height);
  if (above_floor > bed_.height + 1.0) return;  // no heap stands so high: the implements, or someone in the bed
  const int column = std::min(columns_ - 1, static_cast<int>((p.u + 0.5 * bed_.length) / cell));
  const int row = std::min(rows_ - 1, static_cast<int>((p.v + 0.5 * bed_.width) / cell));
  const std::size_t i = static_cast<std::size_t>(row * columns_ + column);
  height_[i] = std::max(0.0, above_floor);
  time_[i] = time_s;
}

void BedMap::note_dump(double u, double mass_kg) { dumps_.push_back({u, mass_kg}); }

double BedMap::seen_share(double since_s) const {
  const auto seen = std::count_if(time_.begin(), time_.end(), [&](double t) { return t >= 0.0 && t >= since_s; });
  return static_cast<double>(seen) / static_cast<double>(time_.size());
}

double BedMap::mean_height(double u_low, double u_high, double since_s) const {
  double sum = 0.0, sum_all = 0.0;
  int seen = 0, seen_all = 0, cells = 0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const std::size_t i = static_cast<std::size_t>(row * columns_ + column);
      const double u = (column + 0.5) * cell - 0.5 * bed_.length;
      const bool inside = u >= u_low && u < u_high;
      cells += inside ? 1 : 0;
      if (time_[i] < 0.0 || time_[i] < since_s) continue;
      sum_all += height_[i];
      ++seen_all;
      if (inside) { sum += height_[i]; ++seen; }
    }
  if (seen_all == 0 || cells == 0) return 0.0;
  const double everywhere = sum_all / seen_all;
  return (sum + everywhere * (cells - seen)) / cells;
}

double BedMap::noted_mass(double u_low, double u_high) const {
  double mass = 0.0;
  for (const Dump& d : dumps_) {
    const double overlap = std::min(u_high, d.u + 0.5 * dump_spread) - std::max(u_low, d.u - 0.5 * dump_spread);
    if (overlap > 0.0) mass += d.mass * overlap / dump_spread;
  }
  return mass;
}

}  // namespace berm::app
