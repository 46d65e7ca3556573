#include "plant/world/height_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace berm::plant {
namespace {

// Patches along a block's side. Patch i lies between the centres of the cells i - 1 and i.
constexpr int block_side = 8;
constexpr double never = std::numeric_limits<double>::infinity();

// One of the two ways in which a ray crosses the borders of squares of a given side, in units of patches. By sums, which find in little time where the
// surface may be met; what the hit is computed from are the quotients that tell where a border is crossed to the last bit. Where the ray runs so nearly
// along the borders that the sums would round too much, there are but few, and all are quotients.
class Crossings {
 public:
  // Begins in the nearest of these squares to where the ray is at t, as if it had walked there from `entered`.
  Crossings(double origin, double direction, double inverse, double entered, double t, int side, int low, int high)
      : origin_(origin), direction_(direction), side_(side), step_(direction > 0 ? 1 : -1), along_(std::abs(direction) < 1e-4),
        each_(side * std::abs(inverse)) {
    const auto nearest = [&](double at) {
      const double square = (origin + at * direction) / side;
      return std::clamp(static_cast<int>(square) - (square < 0 ? 1 : 0), low, high);
    };
    index_ = nearest(t);
    moved_ = t > entered && index_ != nearest(entered);
    next_ = along_ ? next_exactly() : (side_ * (index_ + (step_ > 0 ? 1 : 0)) - origin_) * inverse;
  }
  [[nodiscard]] int index() const { return index_; }
  [[nodiscard]] double next() const { return next_; }
  // Of the border behind; none before the first step, wherever in its square the ray began.
  [[nodiscard]] double last() const { return !moved_ ? -never : along_ ? last_exactly() : next_ - each_; }
  [[nodiscard]] double next_exactly() const { return direction_ == 0 ? never : border(index_ + (step_ > 0 ? 1 : 0)); }
  [[nodiscard]] double last_exactly() const { return border(index_ + (step_ > 0 ? 0 : 1)); }
  void advance() {
    moved_ = true;
    index_ += step_;
    next_ = along_ ? next_exactly() : next_ + each_;
  }

 private:
  [[nodiscard]] double border(int index) const { return (index * static_cast<double>(side_) - origin_) / direction_; }
  double origin_, direction_;
  int side_, step_, index_;
  bool along_, moved_ = false;
  double each_, next_;
};

// Steps through the squares that a ray crosses.
class Walk {
 public:
  Walk(const Ray& r, const Vec3& inverse, double entered, double t, int side, int i_low, int i_high, int j_low, int j_high)
      : x_(r.origin.x, r.direction.x, inverse.x, entered, t, side, i_low, i_high), y_(r.origin.y, r.direction.y, inverse.y, entered, t, side, j_low, j_high) {}
  [[nodiscard]] int i() const { return x_.index(); }
  [[nodiscard]] int j() const { return y_.index(); }
  // About where the ray leaves the present square.
  [[nodiscard]] double leaves() const { return std::min(x_.next(), y_.next()); }
  void advance() {
    if (x_.next() <= y_.next()) x_.advance();
    else y_.advance();
  }
  // Where it enters the present square, having begun at t, and leaves it, to the last bit. Of two borders only those are computed that may be it.
  [[nodiscard]] double enter_exactly(double t) const {
    const double ex = x_.last(), ey = y_.last(), last = std::max({ex, ey, t}) - doubtful;
    if (ex >= last) t = std::max(t, x_.last_exactly());
    if (ey >= last) t = std::max(t, y_.last_exactly());
    return t;
  }
  [[nodiscard]] double leave_exactly(double entered) const {
    const double first = leaves() + doubtful;
    double t = never;
    if (x_.next() <= first) t = x_.next_exactly();
    if (y_.next() <= first) t = std::min(t, y_.next_exactly());
    return std::max(entered, t);
  }

 private:
  static constexpr double doubtful = 1e-6;  // far more than the sums' rounding
  Crossings x_, y_;
};

// Narrows [low, high] to where origin + t * direction lies in [a, b]; false when nothing is left.
bool clip(double origin, double direction, double a, double b, double& low, double& high) {
  if (direction == 0) return origin >= a && origin <= b;
  const auto inside = [a, b](double v) { return v > a + 1e-6 && v < b - 1e-6; };
  if (inside(origin + low * direction) && inside(origin + high * direction)) return true;
  const double t1 = (a - origin) / direction, t2 = (b - origin) / direction;
  low = std::max(low, std::min(t1, t2));
  high = std::min(high, std::max(t1, t2));
  return low <= high;
}

}  // namespace

inline double HeightGrid::clamped(int ix, int iy) const { return at(std::clamp(ix, 0, count_x_ - 1), std::clamp(iy, 0, count_y_ - 1)); }

inline HeightGrid::Patch HeightGrid::patch(int i, int j) const {
  if (i < 1 || j < 1 || i >= count_x_ || j >= count_y_) return {clamped(i - 1, j - 1), clamped(i, j - 1), clamped(i - 1, j), clamped(i, j)};
  const double* const corner = height_.data() + static_cast<size_t>(j - 1) * static_cast<size_t>(count_x_) + static_cast<size_t>(i - 1);
  return {corner[0], corner[1], corner[count_x_], corner[count_x_ + 1]};
}

HeightGrid::HeightGrid(double x_low, double y_low, double cell_x, double cell_y, int count_x, int count_y, double height)
    : x_low_(x_low), y_low_(y_low), cell_x_(cell_x), cell_y_(cell_y), count_x_(count_x), count_y_(count_y),
      blocks_x_(count_x / block_side + 1), blocks_y_(count_y / block_side + 1),
      height_(static_cast<size_t>(count_x) * static_cast<size_t>(count_y), height),
      block_max_(static_cast<size_t>(blocks_x_) * static_cast<size_t>(blocks_y_), height), stale_(block_max_.size(), 0), highest_(height) {}

int HeightGrid::index_x(double x) const { return std::clamp(static_cast<int>(std::floor((x - x_low_) / cell_x_)), 0, count_x_ - 1); }
int HeightGrid::index_y(double y) const { return std::clamp(static_cast<int>(std::floor((y - y_low_) / cell_y_)), 0, count_y_ - 1); }

bool HeightGrid::contains(double x, double y) const {
  return x >= x_low_ && y >= y_low_ && x < x_low_ + count_x_ * cell_x_ && y < y_low_ + count_y_ * cell_y_;
}

void HeightGrid::set(int ix, int iy, double height) {
  height_[static_cast<size_t>(iy) * static_cast<size_t>(count_x_) + static_cast<size_t>(ix)] = height;
  // The cell is a corner of the patches ix and ix + 1, which may lie in two blocks.
  for (int bj = iy / block_side; bj <= (iy + 1) / block_side; ++bj) {
    for (int bi = ix / block_side; bi <= (ix + 1) / block_side; ++bi) {
      const auto b = static_cast<size_t>(bj * blocks_x_ + bi);
      if (!stale_[b]) {
        stale_[b] = 1;
        stale_list_.push_back(static_cast<int>(b));
      }
    }
  }
}

void HeightGrid::refresh() {
  if (stale_list_.empty()) return;
  int bi_low = blocks_x_, bi_high = -1, bj_low = blocks_y_, bj_high = -1;
  for (const int b : stale_list_) {
    const int bi = b % blocks_x_, bj = b / blocks_x_;
    bi_low = std::min(bi_low, bi), bi_high = std::max(bi_high, bi), bj_low = std::min(bj_low, bj), bj_high = std::max(bj_high, bj);
    double top = -never;
    for (int iy = bj * block_side - 1; iy < (bj + 1) * block_side; ++iy) {
      for (int ix = bi * block_side - 1; ix < (bi + 1) * block_side; ++ix) top = std::max(top, clamped(ix, iy));
    }
    block_max_[static_cast<size_t>(b)] = top;
    stale_[static_cast<size_t>(b)] = 0;
  }
  stale_list_.clear();
  const double highest = *std::max_element(block_max_.begin(), block_max_.end());
  // A block's patches lie between the centres of the cells from the one before its first to its last; the rim's reach out by half a cell.
  change_ = {change_.number + 1, centre_x(bi_low * block_side - 1), centre_y(bj_low * block_side - 1), centre_x((bi_high + 1) * block_side),
             centre_y((bj_high + 1) * block_side), highest != highest_};
  highest_ = highest;
}

double HeightGrid::surface(double x, double y) const {
  const double u = std::clamp((x - x_low_) / cell_x_ + 0.5, 0.5, count_x_ + 0.5);
  const double v = std::clamp((y - y_low_) / cell_y_ + 0.5, 0.5, count_y_ + 0.5);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const double fu = u - i, fv = v - j;
  const double h00 = clamped(i - 1, j - 1), h10 = clamped(i, j - 1), h01 = clamped(i - 1, j), h11 = clamped(i, j);
  if (fu + fv <= 1) return h00 + (h10 - h00) * fu + (h01 - h00) * fv;
  return h11 + (h01 - h11) * (1 - fu) + (h10 - h11) * (1 - fv);
}

std::optional<double> HeightGrid::cast_patch(const Patch& patch, int i, int j, const Ray& r, double t_in, double t_out) {
  const auto [h00, h10, h01, h11] = patch;
  const double z_in = r.origin.z + t_in * r.direction.z, z_out = r.origin.z + t_out * r.direction.z;
  if (std::min(z_in, z_out) > std::max({h00, h10, h01, h11})) return std::nullopt;
  // Height over the surface at t, which is linear on either side of the patch's diagonal.
  const auto over = [&](double t) {
    const double fu = r.origin.x + t * r.direction.x - i, fv = r.origin.y + t * r.direction.y - j;
    const double h = fu + fv <= 1 ? h00 + (h10 - h00) * fu + (h01 - h00) * fv : h11 + (h01 - h11) * (1 - fu) + (h10 - h11) * (1 - fv);
    return r.origin.z + t * r.direction.z - h;
  };
  std::array<double, 3> stop = {t_in, t_out, t_out};
  const double slope = r.direction.x + r.direction.y;
  if (slope != 0) {
    const double t = (i + j + 1 - r.origin.x - r.origin.y) / slope;
    if (t > t_in && t < t_out) stop[1] = t;
  }
  double before = over(stop[0]);
  if (before <= 0) return t_in;
  for (size_t k = 1; k < 3; ++k) {
    const double after = over(stop[k]);
    if (after <= 0) return stop[k - 1] + (stop[k] - stop[k - 1]) * before / (before - after);
    before = after;
  }
  return std::nullopt;
}

// The part of the ray in [t_in, t_out] that lies in the block, which it enters at t_in, and in which nothing is higher than top. As long as a falling ray
// is higher, it need not be looked at; from a little before, far more than is lost in rounding.
std::optional<double> HeightGrid::cast_block(int bi, int bj, double top, const Ray& r, const Vec3& inverse, double t_in, double t_out) const {
  constexpr double falls = -1e-4, before = 1e-3;
  const int i_low = bi * block_side, i_high = i_low + block_side - 1, j_low = bj * block_side, j_high = j_low + block_side - 1;
  double t = r.direction.z < falls ? std::max(t_in, (top - r.origin.z) * inverse.z - before) : t_in, z = r.origin.z + t * r.direction.z;
  for (Walk walk(r, inverse, t_in, t, 1, i_low, i_high, j_low, j_high);
       t < t_out && walk.i() >= i_low && walk.i() <= i_high && walk.j() >= j_low && walk.j() <= j_high; walk.advance()) {
    t = std::min(walk.leaves(), t_out);
    const double z_out = r.origin.z + t * r.direction.z;
    const Patch here = patch(walk.i(), walk.j());
    if (std::min(z, z_out) <= std::max(std::max(here.h00, here.h10), std::max(here.h01, here.h11)) + rounding) {
      const double enters = std::min(walk.enter_exactly(t_in), t_out), leaves = std::min(walk.leave_exactly(enters), t_out);
      if (enters < leaves)
        if (const auto hit = cast_patch(here, walk.i(), walk.j(), r, enters, leaves)) return hit;
    }
    z = z_out;
  }
  return std::nullopt;
}

// Whether the ray has left the rectangle for good before t: by a margin, so that what is doubtful is clipped.
bool HeightGrid::leaves_before(const Ray& ray, double t) const {
  constexpr double margin = 1e-6;
  const auto beyond = [t](double origin, double direction, double low, double high) {
    const double at = origin + t * direction;
    return (direction <= 0 && at < low - margin) || (direction >= 0 && at > high + margin);
  };
  return beyond(ray.origin.x, ray.direction.x, x_low_, x_low_ + count_x_ * cell_x_) || beyond(ray.origin.y, ray.direction.y, y_low_, y_low_ + count_y_ * cell_y_);
}

std::optional<double> HeightGrid::cast_low(const Ray& ray, double range_max) const {
  double t_in = 0, t_out = range_max;
  const double highest = highest_ + rounding;
  if (ray.direction.z < 0) {
    t_in = std::max(t_in, (highest - ray.origin.z) / ray.direction.z);
    if (t_in > t_out || leaves_before(ray, t_in)) return std::nullopt;
  } else if (!clip(ray.origin.z, ray.direction.z, -never, highest, t_in, t_out)) {
    return std::nullopt;
  }
  // In units of patches, so that the walk's squares have integer corners; the parameter stays the range.
  const Ray r{{(ray.origin.x - x_low_) / cell_x_ + 0.5, (ray.origin.y - y_low_) / cell_y_ + 0.5, ray.origin.z},
              {ray.direction.x / cell_x_, ray.direction.y / cell_y_, ray.direction.z}};
  if (!clip(r.origin.x, r.direction.x, 0.5, count_x_ + 0.5, t_in, t_out)) return std::nullopt;
  if (!clip(r.origin.y, r.direction.y, 0.5, count_y_ + 0.5, t_in, t_out)) return std::nullopt;
  const auto inverted = [](double v) { return v == 0 ? 0 : 1 / v; };
  const Vec3 inverse{inverted(r.direction.x), inverted(r.direction.y), inverted(r.direction.z)};
  double t = t_in, z = r.origin.z + t_in * r.direction.z;
  for (Walk walk(r, inverse, t_in, t_in, block_side, 0, blocks_x_ - 1, 0, blocks_y_ - 1);
       t < t_out && walk.i() >= 0 && walk.j() >= 0 && walk.i() < blocks_x_ && walk.j() < blocks_y_; walk.advance()) {
    t = std::min(walk.leaves(), t_out);
    const double z_out = r.origin.z + t * r.direction.z, top = block_max_[static_cast<size_t>(walk.j() * blocks_x_ + walk.i())];
    if (std::min(z, z_out) <= top + rounding)
      if (const auto hit = cast_block(walk.i(), walk.j(), top, r, inverse, std::min(walk.enter_exactly(t_in), t_out), t_out)) return hit;
    z = z_out;
  }
  return std::nullopt;
}

}  // namespace berm::plant
