#include "planning/skyline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace berm::app {

namespace {

constexpr double unknown_height = 0.0;   // the bench the machine stands on
constexpr double own_diagonal = 0.425;   // of a cell: of those wholly within its own body's circle and so far beyond it the kernel asks nothing of the boom
constexpr double lateral_step = 0.2;     // of the search across the implements' width; at most a terrain cell
constexpr double wall_thickness = 0.3;   // generous
constexpr double nothing = -std::numeric_limits<double>::infinity();

}  // namespace

BedPoint to_bed(const TruckBed& bed, double x, double y) {
  const double dx = x - bed.centre_x, dy = y - bed.centre_y, c = std::cos(bed.yaw), s = std::sin(bed.yaw);
  return {dx * c + dy * s, -dx * s + dy * c};
}

void from_bed(const TruckBed& bed, const BedPoint& p, double& x, double& y) {
  const double c = std::cos(bed.yaw), s = std::sin(bed.yaw);
  x = bed.centre_x + p.u * c - p.v * s;
  y = bed.centre_y + p.u * s + p.v * c;
}

namespace {

constexpr double cell = 0.3, rounding = 1e-6;  // of the kernel's map

// The kernel excepts whole cells of its map only.
template <typename Zone>
bool in_zone(const Zone& z, double x, double y) {
  const double x_low = std::floor(x / cell) * cell, y_low = std::floor(y / cell) * cell;
  return x_low > z.x_low - rounding && x_low + cell < z.x_high + rounding && y_low > z.y_low - rounding && y_low + cell < z.y_high + rounding;
}

bool meets_zone(const GroundZone& z, double x, double y) {
  const double x_low = std::floor(x / cell) * cell, y_low = std::floor(y / cell) * cell;
  return x_low + cell > z.x_low - rounding && x_low < z.x_high + rounding && y_low + cell > z.y_low - rounding && y_low < z.y_high + rounding;
}

// Soil that may be touched: what stands higher than the zone's ceiling is no soil, and what is unseen may be anything.
bool diggable(const SiteModel& site, double x, double y, double top) {
  return std::any_of(site.dig_zones.begin(), site.dig_zones.end(), [&](const DigZone& z) { return in_zone(z, x, y) && top <= z.ceiling; });
}

struct Row { double r, highest, outside; };  // distance from the axis; highest ground, and highest that must not be touched

}  // namespace

bool in_dig_zone(const SiteModel& site, double x, double y) {
  return std::any_of(site.dig_zones.begin(), site.dig_zones.end(), [&](const DigZone& z) { return in_zone(z, x, y); });
}

bool at_truck(const SiteModel& site, double x, double y) {
  constexpr double cab = 3.2, before = 0.6, behind = 1.8;  // m, with a cell of the map
  if (!site.bed) return false;
  const BedPoint p = to_bed(*site.bed, x, y), machine = to_bed(*site.bed, 0.0, 0.0);
  const double beyond = std::fabs(p.v) - 0.5 * site.bed->width;
  return std::fabs(p.u) < 0.5 * site.bed->length + cab && beyond < (p.v * machine.v > 0.0 ? before : behind);
}

double pass_over_limit(const SiteModel& site, double x, double y) {
  double limit = site.pass_over;
  for (const GroundZone& z : site.ground_zones)
    if (z.pass_over < limit && meets_zone(z, x, y)) limit = z.pass_over;
  for (const TruckZone& z : site.truck_zones)
    if ((site.bed || site.truck_admitted) && z.ceiling > limit && in_zone(z, x, y)) limit = z.ceiling;
  for (const DigZone& z : site.dig_zones)
    if (z.ceiling > limit && in_zone(z, x, y)) limit = z.ceiling;
  return limit;
}

std::size_t Skyline::slot(double bearing, int bin) {
  const int b = static_cast<int>(std::lround(degrees(wrapped(bearing)) * bearings / 360.0));
  return static_cast<std::size_t>(((b % bearings) + bearings) % bearings * LowerEdge::bins + bin);
}

Ground ground_of(const TerrainMap& terrain) {
  return [&terrain](double x, double y) { return terrain.height_or(x, y, unknown_height); };
}

Skyline::Skyline(const MachineModel& machine, const SiteModel& site, const GroundRow& ground, OverHigh over_high, Rows)
    : machine_(&machine), all_(static_cast<std::size_t>(bearings * LowerEdge::bins), nothing), outside_dig_zone_(all_) {
  floor_ = nothing;
  for (const DigZone& z : site.dig_zones) floor_ = std::max(floor_, z.floor);
  double half_width = 0.0;
  for (const Prism& part : machine.parts) half_width = std::max(half_width, part.half_width);
  half_width_ = half_width;
  half_width += cell;  // of the kernel's map
  const double bed_c = site.bed ? std::cos(site.bed->yaw) : 1.0, bed_s = site.bed ? std::sin(site.bed->yaw) : 0.0;
  const auto top = [&](double x, double y, double z) {
    if (!site.bed || z >= site.bed->wall_top) return z;
    const TruckBed& bed = *site.bed;
    const double dx = x - bed.centre_x, dy = y - bed.centre_y;
    const BedPoint p{dx * bed_c + dy * bed_s, -dx * bed_s + dy * bed_c};  // to_bed, without its cosine and sine for each of 300,000 points
    if (std::fabs(p.u) < 0.5 * bed.length + wall_thickness && std::fabs(p.v) < 0.5 * bed.width + wall_thickness) z = std::max(z, bed.wall_top);
    return z;
  };
  std::vector<double> across;
  for (double a = -half_width; a <= half_width + 1e-9; a += lateral_step) across.push_back(a);
  std::vector<double> xs(across.size()), ys(across.size()), zs(across.size());
  for (int b = 0; b < bearings; ++b) {
    const double bearing = 2.0 * std::numbers::pi * b / bearings;
    const double c = std::cos(bearing), s = std::sin(bearing);
    // Over the implements' width at a distance. The bins on either side want it too: kept where the distance is the same to the last bit.
    std::array<Row, 4> kept;
    kept.fill({-1.0, nothing, nothing});
    std::size_t oldest = 0;
    const auto row = [&](double r) -> const Row& {
      for (const Row& known : kept)
        if (known.r == r) return known;
      Row& fresh = kept[oldest++ % kept.size()];
      fresh = {r, nothing, nothing};
      for (std::size_t i = 0; i < across.size(); ++i) xs[i] = r * c - across[i] * s, ys[i] = r * s + across[i] * c;
      ground(xs.data(), ys.data(), zs.data(), across.size());
      for (std::size_t i = 0; i < across.size(); ++i) {
        const double z = top(xs[i], ys[i], zs[i]);
        fresh.highest = std::max(fresh.highest, z);
        if (z > fresh.outside && !diggable(site, xs[i], ys[i], z)) fresh.outside = z;
      }
      return fresh;
    };
    for (int bin = 0; bin < LowerEdge::bins; ++bin) {
      double highest = nothing, highest_outside = nothing;
      for (int radial = -1; radial <= 1; ++radial) {
        const Row& at = row((bin + 0.5) * LowerEdge::bin_m + radial * LowerEdge::bin_m);
        highest = std::max(highest, at.highest);
        highest_outside = std::max(highest_outside, at.outside);
      }
      const std::size_t i = static_cast<std::size_t>(b * LowerEdge::bins + bin);
      all_[i] = highest;
      outside_dig_zone_[i] = highest_outside;
    }
  }
  if (over_high == OverHigh::ignored) return;
  too_high_.assign(static_cast<std::size_t>(cells_side * cells_side), 0);
  for (int iy = 0; iy < cells_side; ++iy)
    for (int ix = 0; ix < cells_side; ++ix) {
      const double x = (ix - cells_side / 2 + 0.5) * cell, y = (iy - cells_side / 2 + 0.5) * cell;
      double z = 0.0;
      ground(&x, &y, &z, 1);
      // Exactly unknown_height: never observed, and whoever asks for it so takes it for free.
      const bool own = std::hypot(std::fabs(x) + 0.5 * cell, std::fabs(y) + 0.5 * cell) <= machine.own_body_radius + own_diagonal;
      if (!own && z != unknown_height && z > pass_over_limit(site, x, y)) too_high_[static_cast<std::size_t>(iy * cells_side + ix)] = 1;
    }
  no_passing_.assign(static_cast<std::size_t>(over_bearings * LowerEdge::bins), 0);
  for (int b = 0; b < over_bearings; ++b)
    for (int bin = static_cast<int>(machine.own_body_radius / LowerEdge::bin_m); bin < LowerEdge::bins; ++bin)
      no_passing_[static_cast<std::size_t>(b * LowerEdge::bins + bin)] = may_pass(2.0 * std::numbers::pi * b / over_bearings, bin) ? 0 : 1;
}

bool Skyline::passable(double r, double bearing, double half_width) const {
  const double c = std::cos(bearing), s = std::sin(bearing);
  for (double across = -half_width; across <= half_width + 1e-9; across += lateral_step) {
    const int ix = static_cast<int>(std::floor((r * c - across * s) / cell)) + cells_side / 2, iy = static_cast<int>(std::floor((r * s + across * c) / cell)) + cells_side / 2;
    if (ix >= 0 && iy >= 0 && ix < cells_side && iy < cells_side && too_high_[static_cast<std::size_t>(iy * cells_side + ix)] != 0) return false;
  }
  return true;
}

// Not widened by a cell, as heights are: a parked truck's cab stands close to where a bucket is dumped.
bool Skyline::may_pass(double bearing, int bin) const { return passable((bin + 0.5) * LowerEdge::bin_m, bearing, half_width_); }

bool Skyline::stands_too_high(const Blocking& blocking) const {
  if (blocking.what != Blocking::What::ground || blocking.unseen() || too_high_.empty()) return blocking.what == Blocking::What::too_high;
  // Where blocking() has the height from.
  constexpr double step = 2.0 * std::numbers::pi / bearings;
  const double bearing = step * std::round(blocking.bearing / step);
  for (int radial = -1; radial <= 1; ++radial)
    if (!passable(blocking.distance + radial * LowerEdge::bin_m, bearing, half_width_ + cell)) return true;
  return false;
}

double Skyline::highest(double bearing_low, double bearing_high, double r_low, double r_high) const {
  constexpr double step = 2.0 * std::numbers::pi / bearings;
  double top = nothing;
  for (double bearing = bearing_low; bearing < bearing_high + 0.5 * step; bearing += step)
    for (int bin = static_cast<int>(r_low / LowerEdge::bin_m); bin <= static_cast<int>(r_high / LowerEdge::bin_m) && bin < LowerEdge::bins; ++bin)
      top = std::max(top, height(bearing, bin));
  return top;
}

const char* Skyline::Blocking::name() const {
  switch (what) {
    case What::joint_range: return "joint range";
    case What::own_body: return "own body";
    case What::ground: return unseen() ? "unseen ground" : "ground";
    case What::too_high: return unseen() ? "unseen ground" : "too high to pass over";
  }
  return "?";
}

std::optional<Skyline::Blocking> Skyline::blocking(const ReachIntervals& box, Ranges ranges, double slack) const {
  for (const std::size_t j : {boom, stick, bucket})
    if (ranges == Ranges::kept && (box.low[j] < machine_->joint[j].low || box.high[j] > machine_->joint[j].high)) return Blocking{Blocking::What::joint_range};
  const LowerEdge edge(*machine_, box);
  if (!clears_own_body(*machine_, edge)) return Blocking{Blocking::What::own_body};
  const bool contact_allowed = box.swing_speed < machine_->dig_swing_limit && edge.lowest() > floor_ + over_floor + scatter;
  const std::vector<double>& top = contact_allowed ? outside_dig_zone_ : all_;
  const double margin = machine_->margin + slack;
  constexpr double step = 2.0 * std::numbers::pi / bearings;
  for (double bearing = box.low[swing]; bearing < box.high[swing] + step; bearing += step)
    for (int bin = 0, first = static_cast<int>(slot(bearing, 0)); bin < LowerEdge::bins; ++bin)
      if (const double z = top[static_cast<std::size_t>(first + bin)]; edge.z(bin) != LowerEdge::none && edge.z(bin) < z + margin)
        return Blocking{Blocking::What::ground, bearing, (bin + 0.5) * LowerEdge::bin_m, z};
  if (no_passing_.empty()) return std::nullopt;
  const auto too_high = [&](double bearing, int bin) { return Blocking{Blocking::What::too_high, bearing, (bin + 0.5) * LowerEdge::bin_m, height(bearing, bin)}; };
  constexpr double over_step = 2.0 * std::numbers::pi / over_bearings;
  const int first = static_cast<int>(std::ceil(box.low[swing] / over_step)), last = static_cast<int>(std::floor(box.high[swing] / over_step));
  // The boom, too: from the own body's circle on to the implements' reach something is over every bin.
  const int nearest = static_cast<int>(machine_->own_body_radius / LowerEdge::bin_m);
  for (int bin = nearest; bin < LowerEdge::bins && bin * LowerEdge::bin_m < edge.reach(); ++bin) {
    for (const double end : {box.low[swing], box.high[swing]})
      if (!may_pass(end, bin)) return too_high(end, bin);
    for (int b = first; b <= last; ++b)
      if (no_passing_[static_cast<std::size_t>(((b % over_bearings) + over_bearings) % over_bearings * LowerEdge::bins + bin)] != 0) return too_high(b * over_step, bin);
  }
  return std::nullopt;
}

}  // namespace berm::app
