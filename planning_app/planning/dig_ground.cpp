#include "planning/dig_ground.hpp"

#include <algorithm>
#include <cmath>

#include "planning/soil_slide.hpp"

namespace berm::app {

namespace {

constexpr double around = 1.0;       // m about the dig zones
constexpr double cut_slope = 1.5;    // rise over run of a face that nobody has touched yet
constexpr double bank_slope = 2.6;   // ... up to which a face that is cut stands for a while
constexpr double loose_slope = 0.65; // ... at which what slid down from it lies

}  // namespace

DigGround::DigGround(const SiteModel& site) {
  double x_high = -INFINITY, y_high = -INFINITY;
  x_low_ = y_low_ = INFINITY;
  for (const DigZone& z : site.dig_zones) {
    x_low_ = std::min(x_low_, z.x_low - around);
    y_low_ = std::min(y_low_, z.y_low - around);
    x_high = std::max(x_high, z.x_high + around);
    y_high = std::max(y_high, z.y_high + around);
  }
  x_low_ = cell * std::floor(x_low_ / cell);
  y_low_ = cell * std::floor(y_low_ / cell);
  nx_ = std::max(1, static_cast<int>(std::ceil((x_high - x_low_) / cell)));
  ny_ = std::max(1, static_cast<int>(std::ceil((y_high - y_low_) / cell)));
  height_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), NAN);
  bank_ = height_;
  no_higher_ = height_;
  seen_s_.assign(height_.size(), -1.0);
}

DigGround::DigGround(const SiteModel& site, const DigGround& before, double back) : DigGround(site) {
  for (int iy = 0; iy < ny_; ++iy)
    for (int ix = 0; ix < nx_; ++ix) no_higher_[index(ix, iy)] = before.believed(centre_x(ix) - back, centre_y(iy));
}

double DigGround::guess(const TerrainMap& terrain, double x, double y) const {
  const double r = std::hypot(x, y), c = x / r, s = y / r;
  const auto seen = [&](double at) { return terrain.height(at * c, at * s); };
  double before = 0.0, way = r, foot = -INFINITY;  // the bench, where not even its edge has been seen
  for (double at = r - 0.5 * cell; at > 0.0; at -= 0.5 * cell)
    if (const auto z = seen(at)) {
      before = *z;
      way = r - at;
      break;
    }
  for (double at = r + 0.5 * cell; at < TerrainMap::half_side; at += 0.5 * cell)
    if (const auto z = seen(at)) {
      foot = std::min(*z, before);
      break;
    }
  return std::max(before - cut_slope * way, foot);
}

void DigGround::observe(const TerrainMap& terrain) {
  for (int iy = 0; iy < ny_; ++iy)
    for (int ix = 0; ix < nx_; ++ix) {
      const double x = centre_x(ix), y = centre_y(iy), seen_s = terrain.observed_at(x, y);
      const std::size_t i = index(ix, iy);
      if (seen_s > seen_s_[i]) {
        height_[i] = terrain.height_or(x, y, height_[i]);
        seen_s_[i] = seen_s;
      } else if (std::isnan(height_[i])) {
        height_[i] = std::fmin(guess(terrain, x, y), no_higher_[i]);
      }
      if (!(bank_[i] <= height_[i])) bank_[i] = height_[i];
    }
}

double DigGround::believed(double x, double y) const {
  const int ix = static_cast<int>(std::floor((x - x_low_) / cell)), iy = static_cast<int>(std::floor((y - y_low_) / cell));
  return ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_ ? NAN : height_[index(ix, iy)];
}

void DigGround::lower_to(double x, double y, double z) {
  const int ix = static_cast<int>(std::floor((x - x_low_) / cell)), iy = static_cast<int>(std::floor((y - y_low_) / cell));
  if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) return;
  double& ground = height_[index(ix, iy)];
  if (ground > z) ground = z;
  if (double& firm = bank_[index(ix, iy)]; firm > ground) firm = ground;
}

void DigGround::settle() {
  constexpr int most_rounds = 100;
  constexpr double rest_step = 0.01;  // m
  slide_to_rest(height_, bank_, nx_, ny_, {loose_slope * cell, rest_step, most_rounds}, bank_slope * cell);
}

double DigGround::height(double x, double y) const {
  const int ix = std::clamp(static_cast<int>(std::floor((x - x_low_) / cell)), 0, nx_ - 1), iy = std::clamp(static_cast<int>(std::floor((y - y_low_) / cell)), 0, ny_ - 1);
  const double z = height_[index(ix, iy)];
  return std::isnan(z) ? 0.0 : z;
}

}  // namespace berm::app
