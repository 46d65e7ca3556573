#include "plant/world/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plant/world/random.hpp"

namespace berm::plant {
namespace {

// Steps smaller than this are left standing, m: soil is not a liquid, and the queue must empty.
constexpr double rest_step = 0.002;
// The plane that volumes are counted from.
constexpr double volume_floor = -20.0;

// Smooth noise of mean 0 and standard deviation about 1: random values on a lattice, interpolated.
class Noise {
 public:
  Noise(Random& random, double x_low, double y_low, double width, double depth, double pitch)
      : x_low_(x_low), y_low_(y_low), pitch_(pitch), nx_(static_cast<int>(width / pitch) + 3), ny_(static_cast<int>(depth / pitch) + 3) {
    value_.resize(static_cast<size_t>(nx_) * static_cast<size_t>(ny_));
    for (double& v : value_) v = random.normal();
  }
  [[nodiscard]] double at(double x, double y) const {
    const double u = std::clamp((x - x_low_) / pitch_, 0.0, nx_ - 1.001), v = std::clamp((y - y_low_) / pitch_, 0.0, ny_ - 1.001);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const double fu = smooth(u - i), fv = smooth(v - j);
    const double below = get(i, j) * (1 - fu) + get(i + 1, j) * fu, above = get(i, j + 1) * (1 - fu) + get(i + 1, j + 1) * fu;
    return below * (1 - fv) + above * fv;
  }

 private:
  static double smooth(double f) { return f * f * (3 - 2 * f); }
  [[nodiscard]] double get(int i, int j) const { return value_[static_cast<size_t>(j) * static_cast<size_t>(nx_) + static_cast<size_t>(i)]; }
  double x_low_, y_low_, pitch_;
  int nx_, ny_;
  std::vector<double> value_;
};

// Distance of a point from a segment in the plane.
double to_segment(double x, double y, const MoundConfig& m) {
  const double dx = m.to[0] - m.from[0], dy = m.to[1] - m.from[1], px = x - m.from[0], py = y - m.from[1];
  const double length2 = dx * dx + dy * dy;
  const double s = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(px - s * dx, py - s * dy);
}

}  // namespace

Terrain::Terrain(const TerrainConfig& config, const SoilConfig& soil, uint64_t seed)
    : config_(config), soil_(soil),
      grid_(config.x_low, config.y_low, config.cell, config.cell, config.count_x(), config.count_y(), 0.0), shape_(grid_),
      bank_(static_cast<size_t>(grid_.count_x()) * static_cast<size_t>(grid_.count_y()), 0.0), loose_(bank_.size(), 0.0), cut_(bank_.size(), 0),
      settling_(grid_.count_x(), grid_.count_y()) {
  if (config.measured) {
    for (int iy = 0; iy < grid_.count_y(); ++iy)
      for (int ix = 0; ix < grid_.count_x(); ++ix) shape_.set(ix, iy, config.measured->height.at(index(ix, iy)));
  }
  Random random(seed);
  const double width = config.x_high - config.x_low, depth = config.y_high - config.y_low;
  const Noise coarse(random, config.x_low, config.y_low, width, depth, 1.5), fine(random, config.x_low, config.y_low, width, depth, 0.4);
  for (int iy = 0; iy < grid_.count_y(); ++iy) {
    for (int ix = 0; ix < grid_.count_x(); ++ix) {
      const double x = grid_.centre_x(ix), y = grid_.centre_y(iy);
      // Both parts together have about the standard deviation that is asked for.
      bank_[index(ix, iy)] = as_built(x, y) + config.roughness * (1.1 * coarse.at(x, y) + 0.7 * fine.at(x, y));
      grid_.set(ix, iy, height(ix, iy));
    }
  }
  grid_.refresh();
}

double Terrain::as_built(double x, double y) const {
  if (config_.measured) return shape_.contains(x, y) ? shape_.surface(x, y) : config_.measured->beyond;
  const auto fall = [this](double p, double crest, double toe) {
    return p <= crest ? 0.0 : toe > crest ? std::max(config_.lower_z, config_.lower_z * (p - crest) / (toe - crest)) : config_.lower_z;
  };
  double z = std::min(fall(x, config_.crest_x, config_.toe_x), fall(y, config_.crest_y, config_.toe_y));
  for (const MoundConfig& m : config_.mounds) z = std::max(z, m.top - m.slope * to_segment(x, y, m));
  return z;
}

std::array<double, 2> Terrain::levels_beyond() const {
  if (config_.measured) return {config_.measured->beyond, config_.measured->beyond};
  return {0.0, config_.lower_z};
}

double Terrain::height(int ix, int iy) const {
  if (!inside(ix, iy)) return std::numeric_limits<double>::infinity();
  return bank_[index(ix, iy)] + loose_[index(ix, iy)];
}

void Terrain::changed(int ix, int iy) {
  grid_.set(ix, iy, bank_[index(ix, iy)] + loose_[index(ix, iy)]);
  settling_.touch(ix, iy);
}

double Terrain::cut(int ix, int iy, double z) {
  const size_t c = index(ix, iy);
  const double drop = bank_[c] + loose_[c] - z;
  if (drop <= 0) return 0;
  const double loose = std::min(drop, loose_[c]), bank = drop - loose;
  loose_[c] -= loose;
  if (bank > 0) {
    bank_[c] -= bank;
    cut_[c] = 1;
  }
  changed(ix, iy);
  return (loose + bank * soil_.swell) * grid_.cell_area();
}

void Terrain::deposit(int ix, int iy, double loose_volume) {
  if (loose_volume <= 0) return;
  loose_[index(ix, iy)] += loose_volume / grid_.cell_area();
  changed(ix, iy);
}

double Terrain::give(int ix, int iy, int jx, int jy) {
  const size_t from = index(ix, iy), to = index(jx, jy);
  const double step = height(ix, iy) - height(jx, jy), run = distance(jx - ix, jy - iy);
  const double loose_excess = step - soil_.repose * run;
  if (loose_[from] > 0 && loose_excess > rest_step) {
    const double moved = std::min(loose_[from], loose_excess / 2);
    loose_[from] -= moved;
    loose_[to] += moved;
    grid_.set(ix, iy, height(ix, iy));
    grid_.set(jx, jy, height(jx, jy));
    return moved;
  }
  if (loose_[from] > 0) return 0;  // the loose soil on top stands, so what is below it stands
  const double bank_excess = step - (cut_[from] ? std::max(soil_.bank_slope, soil_.repose) : undisturbed_slope) * run;
  if (bank_excess <= rest_step) return 0;
  const double moved = bank_excess / (1 + soil_.swell);
  bank_[from] -= moved;
  loose_[to] += moved * soil_.swell;
  grid_.set(ix, iy, height(ix, iy));
  grid_.set(jx, jy, height(jx, jy));
  return moved;
}

void Terrain::settle(int budget) {
  settling_.run(*this, budget);
  grid_.refresh();
}

double Terrain::loose_volume() const {
  // Summed by rows, so that the rounding stays far below what a bucket moves.
  double total = 0;
  for (int iy = 0; iy < grid_.count_y(); ++iy) {
    double row = 0;
    for (int ix = 0; ix < grid_.count_x(); ++ix) row += (bank_[index(ix, iy)] - volume_floor) * soil_.swell + loose_[index(ix, iy)];
    total += row * grid_.cell_area();
  }
  return total;
}

}  // namespace berm::plant
