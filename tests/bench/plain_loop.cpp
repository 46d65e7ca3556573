#include "plain_loop.hpp"

#include <algorithm>
#include <cmath>

namespace berm::bench {

namespace {

// The first is straight up; then the four level ones; then the sloping ones.
constexpr float kDirection[17][3] = {{0, 0, 1},  {1, 0, 0},  {-1, 0, 0}, {0, 1, 0},  {0, -1, 0}, {1, 1, 0},   {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0},
                                     {1, 0, 1},  {-1, 0, 1}, {0, 1, 1},  {0, -1, 1}, {1, 1, 1},  {1, -1, 1},  {-1, 1, 1}, {-1, -1, 1}};

}  // namespace

PlainLoop::PlainLoop(const berm_parameters& parameters, int cells, int cell_mm, const std::vector<std::int32_t>& heights_mm)
    : parameters_(parameters), cells_(cells), cell_(static_cast<float>(cell_mm) * 1e-3F), origin_(-0.5F * static_cast<float>(cells) * cell_) {
  top_.reserve(heights_mm.size());
  for (const std::int32_t h : heights_mm) top_.push_back(static_cast<float>(h) * 1e-3F);
}

PlainLoop::Frame PlainLoop::frame_at(const Joints& joints) const {
  Frame f{};
  const float length[2] = {static_cast<float>(parameters_.boom_length_mm) * 1e-3F, static_cast<float>(parameters_.stick_length_mm) * 1e-3F};
  float elevation = 0.0F, r = static_cast<float>(parameters_.boom_pin_x_mm) * 1e-3F, z = static_cast<float>(parameters_.boom_pin_z_mm) * 1e-3F;
  for (int l = 0; l < 3; ++l) {
    elevation += static_cast<float>(joints.angle[l + 1]);
    f.r[l] = r;
    f.z[l] = z;
    f.c[l] = std::cos(elevation);
    f.s[l] = std::sin(elevation);
    if (l < 2) {
      r += length[l] * f.c[l];
      z += length[l] * f.s[l];
    }
  }
  f.swing_c = std::cos(static_cast<float>(joints.angle[0]));
  f.swing_s = std::sin(static_cast<float>(joints.angle[0]));
  return f;
}

void PlainLoop::bound(int part, const Frame& from, const Frame& to, Bounds& out) const {
  const berm_part& shape = parameters_.part[part];
  const int l = shape.link - 1, n = shape.vertices;
  const float half = static_cast<float>(shape.half_width_mm) * 1e-3F;
  constexpr int kMost = 4 * BERM_PART_VERTICES;
  float x[kMost], y[kMost], z[kMost];
  for (int i = 0; i < kMost; ++i) {  // beyond the last vertex it is repeated, so that every loop has one length
    const Frame& f = (i & 1) != 0 ? to : from;
    const int v = std::min(i >> 2, n - 1);
    const float side = (i & 2) != 0 ? half : -half;
    const float vx = static_cast<float>(shape.vertex_mm[v][0]) * 1e-3F, vz = static_cast<float>(shape.vertex_mm[v][1]) * 1e-3F;
    const float r = f.r[l] + vx * f.c[l] - vz * f.s[l];
    z[i] = f.z[l] + vx * f.s[l] + vz * f.c[l];
    x[i] = r * f.swing_c - side * f.swing_s;
    y[i] = r * f.swing_s + side * f.swing_c;
  }
  float least[kDirections][4];
  for (auto& four : least)
    for (float& v : four) v = 1e9F;
  const auto lower = [](float& low, float v) { low = v < low ? v : low; };
  for (int i = 0; i < kMost; i += 4)
    for (int k = 0; k < 4; ++k) {  // the 17 products are sums
      const float px = x[i + k], py = y[i + k], pz = z[i + k], sum = px + py, difference = px - py;
      lower(least[0][k], pz);
      lower(least[1][k], px);
      lower(least[2][k], -px);
      lower(least[3][k], py);
      lower(least[4][k], -py);
      lower(least[5][k], sum);
      lower(least[6][k], difference);
      lower(least[7][k], -difference);
      lower(least[8][k], -sum);
      lower(least[9][k], px + pz);
      lower(least[10][k], pz - px);
      lower(least[11][k], py + pz);
      lower(least[12][k], pz - py);
      lower(least[13][k], sum + pz);
      lower(least[14][k], difference + pz);
      lower(least[15][k], pz - difference);
      lower(least[16][k], pz - sum);
    }
  for (int d = 0; d < kDirections; ++d) out.least[d] = std::min(std::min(least[d][0], least[d][1]), std::min(least[d][2], least[d][3]));
  out.x_low = out.least[1];
  out.x_high = -out.least[2];
  out.y_low = out.least[3];
  out.y_high = -out.least[4];
}

bool PlainLoop::hits(const Bounds& b) const {
  const int ix_low = std::max(0, static_cast<int>((b.x_low - origin_) / cell_)), ix_high = std::min(cells_ - 1, static_cast<int>((b.x_high - origin_) / cell_));
  const int iy_low = std::max(0, static_cast<int>((b.y_low - origin_) / cell_)), iy_high = std::min(cells_ - 1, static_cast<int>((b.y_high - origin_) / cell_));
  for (int iy = iy_low; iy <= iy_high; ++iy) {
    const float y = origin_ + static_cast<float>(iy) * cell_;
    const float* row = &top_[iy * cells_];
    for (int ix = ix_low; ix <= ix_high; ++ix) {
      const float top = row[ix];
      if (top < b.least[0]) continue;
      const float x = origin_ + static_cast<float>(ix) * cell_;
      bool apart = false;
      for (int d = 5; d < kDirections && !apart; ++d) {
        const float* n = kDirection[d];
        apart = n[0] * (n[0] > 0 ? x + cell_ : x) + n[1] * (n[1] > 0 ? y + cell_ : y) + n[2] * top < b.least[d];
      }
      if (!apart) return true;
    }
  }
  return false;
}

void PlainLoop::run(const Joints* joints, int* hit_parts_of_step) const {
  Frame from = frame_at(joints[0]);
  for (int step = 0; step < kSteps; ++step) {
    const Frame to = frame_at(joints[step + 1]);
    hit_parts_of_step[step] = 0;
    for (int part = 0; part < parameters_.parts; ++part) {
      Bounds bounds;
      bound(part, from, to, bounds);
      if (hits(bounds)) ++hit_parts_of_step[step];
    }
    from = to;
  }
}

}  // namespace berm::bench
