#include "scene.hpp"

#include <cmath>

namespace berm::kernel::test {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNever = 1e9;

// Sutherland and Hodgman: what lies on the side where nx x + ny y <= most.
std::vector<Spot> cut(const std::vector<Spot>& in, double nx, double ny, double most) {
  std::vector<Spot> out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Spot a = in[i], b = in[(i + 1) % in.size()];
    const double da = nx * a.x + ny * a.y - most, db = nx * b.x + ny * b.y - most;
    if (da <= 0.0) out.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) out.push_back({a.x + (b.x - a.x) * da / (da - db), a.y + (b.y - a.y) * da / (da - db)});
  }
  return out;
}

// Where the beam enters the prism; kNever where it misses it.
double entry(const Prism& prism, const Beam& beam) {
  double first = 0.0, last = kNever;
  const auto keep = [&](double out_of_plane, double towards) {  // out_of_plane + t towards <= 0
    if (towards == 0.0) {
      if (out_of_plane > 0.0) last = -1.0;
    } else if (towards < 0.0) {
      first = std::fmax(first, -out_of_plane / towards);
    } else {
      last = std::fmin(last, -out_of_plane / towards);
    }
  };
  keep(beam.from[2] - prism.z_high, beam.along[2]);
  keep(prism.z_low - beam.from[2], -beam.along[2]);
  for (std::size_t i = 0; i < prism.footprint.size() && first <= last; ++i) {
    const Spot a = prism.footprint[i], b = prism.footprint[(i + 1) % prism.footprint.size()];
    const double nx = b.y - a.y, ny = a.x - b.x;  // outward
    keep(nx * (beam.from[0] - a.x) + ny * (beam.from[1] - a.y), nx * beam.along[0] + ny * beam.along[1]);
  }
  return first <= last ? first : kNever;
}

}  // namespace

Prism cylinder_around(Spot centre, double diameter, double height) {
  constexpr int kSides = 24;
  const double radius = 0.5 * diameter / std::cos(kPi / kSides);
  Prism prism{{}, 0.0, height};
  for (int i = 0; i < kSides; ++i)
    prism.footprint.push_back({centre.x + radius * std::cos(2 * kPi * i / kSides), centre.y + radius * std::sin(2 * kPi * i / kSides)});
  return prism;
}

Prism box(Spot centre, double yaw, double along, double across, double z_low, double z_high) {
  Prism prism{{}, z_low, z_high};
  constexpr double kSign[4][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  for (const auto& sign : kSign) {
    const double u = 0.5 * sign[0] * along, v = 0.5 * sign[1] * across;
    prism.footprint.push_back({centre.x + u * std::cos(yaw) - v * std::sin(yaw), centre.y + u * std::sin(yaw) + v * std::cos(yaw)});
  }
  return prism;
}

std::vector<Spot> clipped(const std::vector<Spot>& footprint, Spot low, Spot high) {
  return cut(cut(cut(cut(footprint, 1, 0, high.x), -1, 0, -low.x), 0, 1, high.y), 0, -1, -low.y);
}

std::optional<double> Scene::range(const Beam& beam) const {
  double nearest = beam.along[2] < 0.0 ? (ground_z - beam.from[2]) / beam.along[2] : kNever;
  bool returns = true;
  for (const Prism& prism : thing) {
    const double here = entry(prism, beam);
    if (here >= nearest) continue;
    nearest = here;
    returns = prism.returns;
  }
  return returns && nearest < kNever ? std::optional<double>(nearest) : std::nullopt;
}

}  // namespace berm::kernel::test
