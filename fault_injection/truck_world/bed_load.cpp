#include "truck_world/bed_load.hpp"

#include <algorithm>
#include <cmath>

namespace berm::truck_world {
namespace {

constexpr double repose = 0.75;        // steepest slope of soil, tan 37 degrees
constexpr double below_floor = -0.05;  // m: where there is no soil its surface lies under the floor
constexpr int samples = 6;             // a cell's side, for the volume

struct Pile { double x, y, height, radius; };

}  // namespace

BedLoad::BedLoad(const TruckBody& body, Fill fill, Random& random) : body_(body), fill_(fill) {
  if (fill == Fill::empty) return;
  const double high = body.wall_height, x_end = body.length / 2, y_end = body.width / 2;
  double level = 0.0, heap = 0.0, tilt = 0.0;  // of the wall's height; m; of the wall's height from end to end
  int piles = 0;
  if (fill == Fill::part) level = random.uniform(0.12, 0.65), piles = 1 + static_cast<int>(below(random, 3));
  if (fill == Fill::heaped) level = random.uniform(0.80, 0.93), heap = random.uniform(0.15, 0.45);
  if (fill == Fill::uneven) {
    const double high_end = chance(random, 0.5) ? 1.0 : -1.0;
    level = random.uniform(0.30, 0.50), tilt = random.uniform(0.4, 0.8) * high_end, piles = 2;
  }
  std::vector<Pile> pile;
  for (int i = 0; i < piles; ++i)
    pile.push_back(
        {random.uniform(-0.7, 0.7) * x_end, random.uniform(-0.4, 0.4) * y_end, random.uniform(0.1, 0.35) * high, random.uniform(0.6, 1.2)});

  height_.resize(static_cast<std::size_t>((columns_ + 1) * (rows_ + 1)));
  for (int row = 0; row <= rows_; ++row) {
    for (int column = 0; column <= columns_; ++column) {
      const double x = body.length * column / columns_ - x_end, y = body.width * row / rows_ - y_end;
      double z = high * (level + tilt * x / body.length) + random.uniform(-0.03, 0.03);
      z += heap * (1.0 - x * x / (x_end * x_end)) * (1.0 - y * y / (y_end * y_end));
      for (const Pile& p : pile) z += p.height * std::max(0.0, 1.0 - std::hypot(x - p.x, y - p.y) / p.radius);
      const double from_wall = std::min({y_end - std::abs(y), x_end - x, body.tailgate == Tailgate::up ? x_end + x : x_end});
      z = std::min(z, high - rim_clear + repose * from_wall);
      if (body.tailgate != Tailgate::up) z = std::min(z, repose * (x + x_end) + below_floor);
      node(column, row) = std::max(z, body.floor_rise(y) + below_floor);
    }
  }
}

double BedLoad::height(double x, double y) const {
  if (height_.empty()) return below_floor;
  const double u = std::clamp((x / body_.length + 0.5) * columns_, 0.0, columns_ - 1e-9);
  const double v = std::clamp((y / body_.width + 0.5) * rows_, 0.0, rows_ - 1e-9);
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const double a = u - column, b = v - row;
  // The two triangles of the cell, as add_grid splits it.
  const double low = node(column, row), high = node(column + 1, row + 1);
  if (a >= b) return low + a * (node(column + 1, row) - low) + b * (high - node(column + 1, row));
  return low + b * (node(column, row + 1) - low) + a * (high - node(column, row + 1));
}

double BedLoad::volume_m3() const {
  if (height_.empty()) return 0.0;
  double sum = 0.0;
  const int along = columns_ * samples, across = rows_ * samples;
  for (int j = 0; j < across; ++j) {
    const double y = body_.width * ((j + 0.5) / across - 0.5), floor = body_.floor_rise(y);
    for (int i = 0; i < along; ++i) sum += std::max(0.0, height(body_.length * ((i + 0.5) / along - 0.5), y) - floor);
  }
  return sum * body_.length * body_.width / (along * across);
}

Mesh BedLoad::mesh() const {
  Mesh mesh;
  if (height_.empty()) return mesh;
  const auto point = [&](int column, int row) {
    const double x = body_.length * column / columns_ - body_.length / 2, y = body_.width * row / rows_ - body_.width / 2;
    return Vector3d(x, y, body_.floor_height + node(column, row));
  };
  add_grid(mesh, columns_, rows_, point, Surface::load);
  return mesh;
}

}  // namespace berm::truck_world
