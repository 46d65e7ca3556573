#include "io/own_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berm::kernel {

namespace {

// The cells of one axis that a line passes, one after the other.
class Steps {
 public:
  Steps(std::int32_t from_mm, double per_mm) : index(sk_map_index(from_mm)), step_(per_mm < 0.0 ? -1 : 1) {
    const double border_mm = SK_MAP_ORIGIN_MM + static_cast<double>(index + (step_ > 0 ? 1 : 0)) * SK_CELL_MM;
    const bool across = std::fabs(per_mm) > 1e-9;
    next_mm = across ? (border_mm - from_mm) / per_mm : std::numeric_limits<double>::infinity();
    each_mm_ = across ? SK_CELL_MM / std::fabs(per_mm) : 0.0;
  }
  void advance() {
    index += step_;
    next_mm += each_mm_;
  }
  bool in_map() const { return index >= 0 && index < SK_MAP_CELLS; }

  std::int32_t index;
  double next_mm;  // along the line, to the next border

 private:
  std::int32_t step_;
  double each_mm_;
};

}  // namespace

void OwnShadow::note_view(int scanner, const sk_point& point, std::int64_t now_us) {
  const std::int32_t iy = sk_map_index(point.y_mm), ix = sk_map_index(point.x_mm);
  if (iy < 0 || iy >= SK_MAP_CELLS || ix < 0 || ix >= SK_MAP_CELLS) return;
  View& view = view_[scanner][iy][ix];
  view.low_mm = now_us - view.seen_us > generation_us_ ? point.z_mm : std::min(view.low_mm, point.z_mm);
  view.seen_us = now_us;
}

// Seen within a generation and not hidden within two: the last sweep over it met no implement.
bool OwnShadow::clear(const View& view, std::int64_t now_us) const {
  return now_us - view.seen_us < generation_us_ && now_us - view.hidden_us > 2LL * generation_us_;
}

// high_mm: the beam's in the cell. Below the ground that was seen there it hides nothing, there and beyond.
bool OwnShadow::buried(const View& view, double high_mm, std::int64_t now_us) const {
  return now_us - view.seen_us < 2LL * generation_us_ && high_mm < view.low_mm - kGroundMm;
}

void OwnShadow::keep(int scanner, const sk_point& head, const sk_point& own, std::int64_t now_us, sk_height_map& map) {
  const double dx = own.x_mm - head.x_mm, dy = own.y_mm - head.y_mm, ground_mm = std::hypot(dx, dy);
  if (ground_mm < 1.0) return;
  const double slope = (own.z_mm - head.z_mm) / ground_mm;
  Steps x(own.x_mm, dx / ground_mm), y(own.y_mm, dy / ground_mm);
  double enters_mm = own.z_mm;
  while (x.in_map() && y.in_map() && enters_mm >= kLowestMm) {
    const double leaves_mm = own.z_mm + slope * std::fmin(x.next_mm, y.next_mm);
    View& view = view_[scanner][y.index][x.index];
    if (buried(view, std::fmax(enters_mm, leaves_mm), now_us)) return;
    if (std::fmin(enters_mm, leaves_mm) <= sk_map_top(&map, y.index, x.index)) {
      view.hidden_us = now_us;
      bool seen = false;
      for (int other = 0; other < kViewers; ++other) seen = seen || (other != scanner && clear(view_[other][y.index][x.index], now_us));
      if (!seen) static_cast<void>(sk_map_keep(&map, y.index, x.index));
    }
    if (x.next_mm <= y.next_mm) x.advance();
    else y.advance();
    enters_mm = leaves_mm;
  }
}

}  // namespace berm::kernel
