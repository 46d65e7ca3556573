#include "insertion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <octomap/OcTree.h>
#pragma GCC diagnostic pop

namespace berm::bench {

namespace {

constexpr double kPi = 3.141592653589793;
constexpr std::int32_t kGenerationUs = 1000000;
constexpr std::int64_t kSweepUs = 250000;  // from one run to the next: a new sweep of a cell with every fourth

}  // namespace

std::size_t Scan::points() const {
  std::size_t n = 0;
  for (const auto& l : line) n += l.size();
  return n;
}

Scan scan_of(Scanner scanner, const std::vector<std::int32_t>& heights_mm, int cells, int cell_mm) {
  constexpr double kHeadX = 1.3, kHeadY = 1.35, kHeadZ = 3.3, kNearest = 3.0, kStepM = 0.02;
  const double cell = cell_mm * 1e-3, reach = 0.5 * cells * cell;
  // The first ground that the ray meets.
  const auto add = [&](double azimuth, double down, std::vector<sk_point>& line) {
    const double across = std::cos(down), fall = std::sin(down), c = std::cos(azimuth), s = std::sin(azimuth);
    for (double range = kNearest; range < 2.0 * reach; range += kStepM) {
      const double x = kHeadX + range * across * c, y = kHeadY + range * across * s, z = kHeadZ - range * fall;
      const int ix = static_cast<int>(std::floor((x + reach) / cell)), iy = static_cast<int>(std::floor((y + reach) / cell));
      if (ix < 0 || iy < 0 || ix >= cells || iy >= cells) return;
      if (z * 1e3 > heights_mm[iy * cells + ix]) continue;
      line.push_back({static_cast<std::int32_t>(std::lround(x * 1e3)), static_cast<std::int32_t>(std::lround(y * 1e3)), static_cast<std::int32_t>(std::ceil(z * 1e3))});
      return;
    }
  };
  Scan scan;
  const auto finish = [&](std::vector<sk_point>& line) {
    if (!line.empty()) scan.line.push_back(std::move(line));
  };
  if (scanner == Scanner::kVlp16) {
    for (int ring = 0; ring < 8; ++ring) {  // those that look down
      std::vector<sk_point> line;
      for (int i = 0; i < 1800; ++i) add(i * 0.2 * kPi / 180.0, (15.0 - 2.0 * ring) * kPi / 180.0, line);
      finish(line);
    }
  } else {
    for (double pan = -45.0; pan <= 130.0; pan += 1.5) {
      std::vector<sk_point> line;
      for (int i = 0; i < 400; ++i)
        if (i * 2.0 * kPi / 400.0 > 0.05 && i * 2.0 * kPi / 400.0 < 1.5) add(pan * kPi / 180.0, i * 2.0 * kPi / 400.0, line);
      finish(line);
    }
  }
  return scan;
}

OurInsertion::OurInsertion() : map_(new sk_height_map) { sk_map_clear(map_.get()); }

void OurInsertion::run(const Scan& scan) {
  now_us_ += kSweepUs;
  for (const auto& line : scan.line) {
    const sk_point* from = line.data();
    for (const sk_point& point : line) {
      if (sk_raster_segment(map_.get(), from, &point, now_us_, kGenerationUs) < 0) throw std::runtime_error("the core refuses a point");
      from = &point;
    }
  }
}

PlainInsertion::PlainInsertion(int cells, int cell_mm)
    : cells_(cells), per_cell_(1.0F / static_cast<float>(cell_mm)), half_(0.5F * static_cast<float>(cells)), cell_(static_cast<std::size_t>(cells) * cells, Cell{0, 0, 0, -1}) {}

float PlainInsertion::top(int iy, int ix) const {
  const Cell& c = cell_[iy * cells_ + ix];
  return std::max(c.height, c.previous);
}

inline void PlainInsertion::raise(int iy, int ix, float z) {
  if (!has(iy, ix)) return;
  Cell& c = cell_[iy * cells_ + ix];
  if (c.seen_us < 0) {
    c = {z, z, now_us_, now_us_};
    return;
  }
  if (c.began_us <= now_us_ - kGenerationUs) {
    c.previous = c.height;
    c.height = z;
    c.began_us = now_us_;
  } else if (c.height < z) {
    c.height = z;
  }
  c.seen_us = now_us_;
}

// Cell by cell along the segment (Amanatides and Woo), each to the higher of the segment's heights where it enters and leaves.
template <class Raise>
inline void PlainInsertion::segment(const sk_point& p, const sk_point& q, const Raise& raise_cell) const {
  const float px = static_cast<float>(p.x_mm) * per_cell_ + half_, py = static_cast<float>(p.y_mm) * per_cell_ + half_;
  const float qx = static_cast<float>(q.x_mm) * per_cell_ + half_, qy = static_cast<float>(q.y_mm) * per_cell_ + half_;
  int ix = static_cast<int>(px), iy = static_cast<int>(py);
  const int last_x = static_cast<int>(qx), last_y = static_cast<int>(qy);
  const float pz = static_cast<float>(p.z_mm), qz = static_cast<float>(q.z_mm);
  if (ix == last_x && iy == last_y) {
    raise_cell(iy, ix, std::max(pz, qz));
    return;
  }
  const float dx = qx - px, dy = qy - py, dz = qz - pz;
  const int step_x = dx > 0 ? 1 : -1, step_y = dy > 0 ? 1 : -1;
  const float per_x = dx != 0 ? std::fabs(1.0F / dx) : 1e9F, per_y = dy != 0 ? std::fabs(1.0F / dy) : 1e9F;
  float next_x = dx != 0 ? (static_cast<float>(dx > 0 ? ix + 1 : ix) - px) / dx : 1e9F, next_y = dy != 0 ? (static_cast<float>(dy > 0 ? iy + 1 : iy) - py) / dy : 1e9F;
  float entered = 0.0F;
  for (int left = std::abs(last_x - ix) + std::abs(last_y - iy); left >= 0; --left) {
    const float leaves = std::min(1.0F, std::min(next_x, next_y));
    raise_cell(iy, ix, std::max(pz + dz * entered, pz + dz * leaves));
    entered = leaves;
    if (next_x < next_y) {
      next_x += per_x;
      ix += step_x;
    } else {
      next_y += per_y;
      iy += step_y;
    }
  }
}

void PlainInsertion::run(const Scan& scan) {
  now_us_ += kSweepUs;
  for (const auto& line : scan.line) {
    const sk_point* from = line.data();
    for (const sk_point& point : line) {
      segment(*from, point, [this](int iy, int ix, float z) { raise(iy, ix, z); });
      from = &point;
    }
  }
}

Scan PlainInsertion::crossed(const Scan& scan) const {
  const auto middle_mm = [this](int i) { return static_cast<std::int32_t>(std::lround((static_cast<float>(i) + 0.5F - half_) / per_cell_)); };
  Scan out;
  for (const auto& line : scan.line) {
    out.line.emplace_back();
    const sk_point* from = line.data();
    for (const sk_point& point : line) {
      segment(*from, point, [&](int iy, int ix, float z) {
        if (has(iy, ix)) out.line.back().push_back({middle_mm(ix), middle_mm(iy), static_cast<std::int32_t>(std::lround(z))});
      });
      from = &point;
    }
  }
  return out;
}

struct OctoMapInsertion::Inside {
  octomap::OcTree tree;
  explicit Inside(double resolution) : tree(resolution) {}
};

OctoMapInsertion::OctoMapInsertion(int cell_mm) : in_(new Inside(cell_mm * 1e-3)) {}
OctoMapInsertion::~OctoMapInsertion() = default;

void OctoMapInsertion::run(const Scan& scan) {
  for (const auto& line : scan.line)
    for (const sk_point& p : line)
      in_->tree.updateNode(octomap::point3d(static_cast<float>(p.x_mm) * 1e-3F, static_cast<float>(p.y_mm) * 1e-3F, static_cast<float>(p.z_mm) * 1e-3F), true);
}

}  // namespace berm::bench
