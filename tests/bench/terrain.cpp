#include "terrain.hpp"

#include <algorithm>
#include <cmath>

#include "motion.hpp"

namespace berm::bench {

namespace {

constexpr double kSpacing = 0.05;  // m, of the samples over a part
constexpr int kSubSteps = 4;
constexpr double kNothing = 1e9;
constexpr double kNearM = 0.60;     // what near motion passes over, or beside
constexpr double kDeepM = 0.40;     // how deep a colliding motion digs in

// The lowest sampled point of the implements over each cell over the whole motion.
class Envelope {
 public:
  Envelope(const berm_parameters& parameters, int cells, int cell_mm) : cells_(cells), cell_(cell_mm * 1e-3), lowest_(cells * cells, kNothing) {
    for (int i = 0; i <= kSteps * kSubSteps; ++i) {
      const Joints joints = joints_at(static_cast<double>(i) / kSubSteps);
      for (int p = 0; p < parameters.parts; ++p) add(parameters, parameters.part[p], joints);
    }
  }
  double at(int iy, int ix) const { return lowest_[iy * cells_ + ix]; }

 private:
  // The lower side of a part is its outline; the samples go along it, across the width.
  void add(const berm_parameters& parameters, const berm_part& part, const Joints& joints) {
    const double half = part.half_width_mm * 1e-3;
    for (int i = 0; i < part.vertices; ++i) {
      const std::int32_t* a = part.vertex_mm[i];
      const std::int32_t* b = part.vertex_mm[(i + 1) % part.vertices];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]) * 1e-3;
      const int pieces = std::max(1, static_cast<int>(length / kSpacing));
      for (int k = 0; k <= pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        const double x = (a[0] + t * (b[0] - a[0])) * 1e-3, z = (a[1] + t * (b[1] - a[1])) * 1e-3;
        for (double y = -half; y <= half + 1e-9; y += half / 6.0) put(part_point(parameters, part, joints, x, z, y));
      }
    }
  }
  void put(const Vec3& p) {
    const int ix = index(p.x), iy = index(p.y);
    if (ix < 0 || iy < 0 || ix >= cells_ || iy >= cells_) return;
    double& lowest = lowest_[iy * cells_ + ix];
    lowest = std::min(lowest, p.z);
  }
  int index(double v) const { return static_cast<int>(std::floor(v / cell_ + cells_ * 0.5)); }

  int cells_;
  double cell_;
  std::vector<double> lowest_;
};

double rolling(double x, double y) { return 0.15 * std::sin(0.7 * x) + 0.12 * std::sin(0.9 * y + 0.4) - 0.3; }

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kFree: return "free";
    case Kind::kNear: return "near";
    case Kind::kGrazing: return "grazing";
    case Kind::kMiddle: return "middle";
    case Kind::kAll: return "all";
  }
  return "";
}

std::vector<std::int32_t> terrain(Kind kind, const berm_parameters& parameters, int cells, int cell_mm) {
  const Envelope envelope(parameters, cells, cell_mm);
  std::vector<std::int32_t> heights(cells * cells);
  for (int iy = 0; iy < cells; ++iy)
    for (int ix = 0; ix < cells; ++ix) {
      const double x = ((ix + 0.5) - cells * 0.5) * cell_mm * 1e-3, y = ((iy + 0.5) - cells * 0.5) * cell_mm * 1e-3;
      const double ground = rolling(x, y), lowest = envelope.at(iy, ix), radius = std::hypot(x, y);
      const bool under = lowest < kNothing && radius > 3.5;  // where the bucket and the stick go
      double height = ground;
      switch (kind) {
        case Kind::kFree: break;
        case Kind::kNear:
          if (under) height = std::max(ground, lowest - kNearM);
          else if (radius > 7.8) height = 4.0;  // a wall all along the outside
          break;
        case Kind::kGrazing:  // from 4 mm below to 3 mm above the lowest sample, cell by cell
          if (under) height = std::max(ground, lowest + ((ix * 5 + iy * 3) % 8 - 4) * 1e-3);
          break;
        case Kind::kMiddle:
          if (under && std::fabs(std::atan2(y, x)) < 0.15) height = std::max(ground, lowest + kDeepM);
          break;
        case Kind::kAll:
          if (under) height = std::max(ground, lowest + kDeepM);
          break;
      }
      heights[iy * cells + ix] = static_cast<std::int32_t>(std::ceil(height * 1e3));
    }
  return heights;
}

}  // namespace berm::bench
