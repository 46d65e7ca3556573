#include "reference_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace berm::core_test {

namespace {
constexpr int kBins = 64, kEnough = 8, kWell = 255;
constexpr double kBin = 150.0, kFloor = -5100.0;

bool believed(const ReferenceHistogram::Cell& c) { return c.state != ReferenceHistogram::State::kLearning && c.observed >= kEnough; }

int bin_of(std::int64_t z) { return static_cast<int>(std::clamp(std::floor((static_cast<double>(z) - kFloor) / kBin), 0.0, kBins - 1.0)); }
}  // namespace

ReferenceHistogram::Cell& ReferenceHistogram::make(Place at) { return cells_[at]; }

ReferenceHistogram::Cell ReferenceHistogram::cell(Place at) const {
  const auto found = cells_.find(at);
  return found == cells_.end() ? Cell{} : found->second;
}

bool ReferenceHistogram::touched(Place at, double x_low, double y_low, double x_high, double y_high) {
  const double x = -15600.0 + 300.0 * at.second, y = -15600.0 + 300.0 * at.first;
  return std::max(x, x_low) <= std::min(x + 300.0, x_high) && std::max(y, y_low) <= std::min(y + 300.0, y_high);
}

bool ReferenceHistogram::departs(const ReferenceRules& r, const Cell& c, const Cell& known, bool yields, std::int64_t z) const {
  if (c.state == State::kLearning) return false;
  // Every height ever seen of a cell, one entry a point, that is less than a rise below z; what lies in z's own bin or higher always is.
  const auto as_high = [&r, z](const Cell& cell) {
    std::vector<int> heights;
    for (const auto& [bin, points] : cell.seen)
      if (kFloor + kBin * bin >= static_cast<double>(z - r.rise) || bin >= bin_of(z))
        heights.insert(heights.end(), static_cast<std::size_t>(points), bin);
    return heights.size();
  };
  const bool excused = c.observed < kWell && believed(known) && as_high(known) >= 2;
  if (c.observed >= kEnough) return as_high(c) <= 1 && !excused;
  const bool over_lines = c.votes >= 3 && z > c.line + r.rise && !(yields && excused), over_known = believed(known) && as_high(known) <= 1;
  return as_high(c) == 0 && (over_lines || over_known);
}

long ReferenceHistogram::recent_around(const ReferenceRules& r, Place at, std::int64_t now) const {
  long points = 0;
  for (const auto& [place, c] : cells_) {
    if (std::max(std::abs(place.first - at.first), std::abs(place.second - at.second)) > 1) continue;
    // Of one cell the newest two: time runs backwards for none but a test.
    for (std::size_t back = 1; back <= 2 && back <= c.departed.size(); ++back) points += now <= c.departed[c.departed.size() - back] + 2 * r.period;
  }
  return points;
}

// around: points that departed there lately.
void ReferenceHistogram::see_ground(const ReferenceRules& r, Cell& c, long around, std::int64_t now) const {
  if (c.state != State::kSomebody || around > 0) return;
  if (c.ground < 0 || c.ground > now) c.ground = now;
  else if (now >= c.ground + r.wait) c.state = State::kClear;
}

void ReferenceHistogram::pass(const ReferenceRules& r, const ReferenceHistogram& others, Place at, std::int64_t z, std::int64_t now) {
  if (!inside(at) || now < 0 || static_cast<double>(z) >= kFloor + kBin * kBins) return;
  const Cell known = others.cell(at);
  Cell& c = make(at);
  if (!departs(r, c, known, false, z)) see_ground(r, c, recent_around(r, at, now), now);
}

bool ReferenceHistogram::insert(const ReferenceRules& r, const ReferenceHistogram& others, bool yields, Place at, std::int64_t z, std::int64_t now) {
  if (!inside(at) || now < 0 || static_cast<double>(z) >= kFloor + kBin * kBins) return false;
  const Cell known = others.cell(at);
  Cell& c = make(at);
  const long around = recent_around(r, at, now);
  if (departs(r, c, known, yields, z)) {
    if (around >= 2) c.state = State::kSomebody;
    c.departed.push_back(now);
    c.ground = -1;
    return true;
  }
  const State was = c.state;
  see_ground(r, c, around, now);
  const auto as_high = [z](const Cell& cell) {
    int points = 0;
    for (const auto& entry : cell.seen) points += entry.first >= bin_of(z) ? entry.second : 0;
    return points;
  };
  const bool above_lines = c.votes >= 3 && kFloor + kBin * bin_of(z) > static_cast<double>(c.line);
  const bool above_known = believed(known) && as_high(known) < 2;
  if (c.state != State::kLearning && c.observed < kEnough && (above_lines || above_known)) return false;
  if (c.state != State::kLearning && c.observed >= kEnough && as_high(c) < 2) {
    if (was != State::kClear || (c.ground >= 0 && c.ground <= now && now <= c.ground + r.period + r.period)) return false;
    c.ground = now;
  }
  count(c, z);
  c.observed = std::min(c.observed + 1, kWell);
  return false;
}

void ReferenceHistogram::count(Cell& c, std::int64_t z) const {
  int& points = c.seen[bin_of(z)];
  if (points == 255)
    for (auto& entry : c.seen) entry.second /= 2;
  ++points;
  for (auto i = c.seen.begin(); i != c.seen.end();) i = i->second == 0 ? c.seen.erase(i) : std::next(i);
}

void ReferenceHistogram::beside(Place at, std::int64_t z) {
  if (!inside(at) || static_cast<double>(z) >= kFloor + kBin * kBins) return;
  if (make(at).state == State::kLearning) count(make(at), z);
}

void ReferenceHistogram::line(Place at, std::int64_t z) {
  if (!inside(at)) return;
  Cell& c = make(at);
  if (c.votes > 0 && std::abs(z - c.line) > 150) {
    --c.votes;
    return;
  }
  c.line = z;
  c.votes = std::min(c.votes + 1, 8);
}

void ReferenceHistogram::forget(double x_low, double y_low, double x_high, double y_high) {
  for (auto i = cells_.begin(); i != cells_.end();) i = touched(i->first, x_low, y_low, x_high, y_high) ? cells_.erase(i) : std::next(i);
}

void ReferenceHistogram::settle(double x_low, double y_low, double x_high, double y_high) {
  for (int iy = 0; iy < 104; ++iy)
    for (int ix = 0; ix < 104; ++ix)
      if (touched({iy, ix}, x_low, y_low, x_high, y_high) && make({iy, ix}).state == State::kLearning) make({iy, ix}).state = State::kClear;
}

bool ReferenceHistogram::step(const ReferenceRules& r, bool (*watched)(Place), std::int64_t now, Place& where) {
  where = {-1, -1};
  if (now < 0) return true;
  for (const auto& [place, c] : cells_)
    if (where.first < 0 && c.state == State::kSomebody && watched(place)) where = place;
  if (where.first >= 0) somebody_ = now;
  return somebody_ >= 0 && (where.first >= 0 || now < somebody_ + r.dwell);
}

}  // namespace berm::core_test
