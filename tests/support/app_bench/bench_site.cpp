#include "app_bench/bench_site.hpp"

#include <algorithm>
#include <cmath>

namespace berm::app_bench {

namespace {

constexpr double lower_z = -2.2;
constexpr double bed_x = -0.70, bed_y = 6.75, bed_half_length = 2.44, bed_half_width = 1.22, bed_floor = -0.92, wall = 0.10;
constexpr double cab_x_low = 2.1, cab_x_high = 4.0, cab_top = 0.75;
constexpr double loose_density = 1340.0;

double fall(double v, double crest, double toe) { return std::clamp((v - crest) / (toe - crest), 0.0, 1.0) * lower_z; }

bool in_dig_zone(double x, double y) { return x > 3.9 && x < 10.5 && y > -4.2 && y < 4.2; }

}  // namespace

int BenchSite::index(double v) { return std::clamp(static_cast<int>(std::floor((v + half_side) / cell)), 0, side - 1); }

BenchSite::BenchSite() : ground_(static_cast<std::size_t>(side * side)) {
  for (int iy = 0; iy < side; ++iy)
    for (int ix = 0; ix < side; ++ix) {
      const double x = (ix + 0.5) * cell - half_side, y = (iy + 0.5) * cell - half_side;
      ground_[static_cast<std::size_t>(iy * side + ix)] = std::min(fall(x, 6.0, 7.5), fall(y, 3.6, 4.8));
    }
}

double& BenchSite::ground(double x, double y) { return ground_[static_cast<std::size_t>(index(y + slipped_y_) * side + index(x + slipped_x_))]; }

double BenchSite::ground(double x, double y) const { return ground_[static_cast<std::size_t>(index(y + slipped_y_) * side + index(x + slipped_x_))]; }

void BenchSite::slip(double x, double y) {
  slipped_x_ += x;
  slipped_y_ += y;
}

bool BenchSite::in_bed(double x, double y) const { return std::fabs(x + slipped_x_ - bed_x) < bed_half_length && std::fabs(y + slipped_y_ - bed_y) < bed_half_width; }

bool BenchSite::on_truck(double x, double y) const {
  const double along = x + slipped_x_;
  const bool across = std::fabs(y + slipped_y_ - bed_y) < bed_half_width + wall;
  return across && ((std::fabs(along - bed_x) < bed_half_length + wall) || (along > cab_x_low && along < cab_x_high));
}

double BenchSite::height(double x, double y) const {
  if (in_bed(x, y)) {
    const int i = std::clamp(static_cast<int>((x + slipped_x_ - bed_x + bed_half_length) / (2.0 * bed_half_length / 3.0)), 0, 2);
    return bed_floor + third_[i] / loose_density / (2.0 * bed_half_width * 2.0 * bed_half_length / 3.0);
  }
  if (on_truck(x, y)) return x + slipped_x_ > cab_x_low ? cab_top : wall_top;
  return ground(x, y);
}

double BenchSite::cut(double x, double y, double bearing, double half_width, double z) {
  double volume = 0.0;
  for (double across = -half_width; across <= half_width; across += 0.5 * cell) {
    double& h = ground(x - across * std::sin(bearing), y + across * std::cos(bearing));
    if (h > z) {
      volume += (h - z) * cell * cell;
      h = z;
    }
  }
  if (volume > 0.0) {
    constexpr int about = 15;
    low_x_ = std::max(0, std::min(low_x_, index(x + slipped_x_) - about));
    high_x_ = std::min(side - 2, std::max(high_x_, index(x + slipped_x_) + about));
    low_y_ = std::max(0, std::min(low_y_, index(y + slipped_y_) - about));
    high_y_ = std::min(side - 2, std::max(high_y_, index(y + slipped_y_) + about));
  }
  return volume;
}

void BenchSite::slump() {
  constexpr double stands = 1.5 * cell, share = 0.2;  // the slope of the site's own faces
  bool moved = false;
  const auto level = [&](double& a, double& b) {
    const double excess = std::fabs(a - b) - stands;
    if (excess < 0.02) return;
    const double flow = std::copysign(share * excess, a - b);
    a -= flow;
    b += flow;
    moved = true;
  };
  for (int iy = low_y_; iy <= high_y_; ++iy)
    for (int ix = low_x_; ix <= high_x_; ++ix) {
      double& here = ground_[static_cast<std::size_t>(iy * side + ix)];
      level(here, ground_[static_cast<std::size_t>(iy * side + ix + 1)]);
      level(here, ground_[static_cast<std::size_t>((iy + 1) * side + ix)]);
    }
  if (!moved) low_x_ = low_y_ = side, high_x_ = high_y_ = -1;
}

void BenchSite::dump(double x, double y, double mass_kg) {
  if (in_dig_zone(x, y)) return;  // a bucket that keeps what the truck has no room for empties where it digs
  if (!in_bed(x, y)) {
    spilled_mass_ += mass_kg;
    return;
  }
  bed_mass_ += mass_kg;
  third_[std::clamp(static_cast<int>((x + slipped_x_ - bed_x + bed_half_length) / (2.0 * bed_half_length / 3.0)), 0, 2)] += mass_kg;
}

void BenchSite::heap_up(double x, double y, double radius, double top) {
  for (double dx = -radius; dx <= radius; dx += 0.5 * cell)
    for (double dy = -radius; dy <= radius; dy += 0.5 * cell)
      if (std::hypot(dx, dy) <= radius) ground(x + dx, y + dy) = std::max(ground(x + dx, y + dy), top);
}

void BenchSite::new_truck() {
  bed_mass_ = 0.0;
  std::fill(std::begin(third_), std::end(third_), 0.0);
}

}  // namespace berm::app_bench
