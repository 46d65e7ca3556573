#include "watch/intrusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "in_process/draw.hpp"

namespace berm::watch {

namespace {

using in_process::Draw;
using plant::WaypointConfig;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double longest_wait_s = 20.0;    // more than a whole pass
constexpr double first_while_learning_s = 4.0, last_while_learning_s = 34.0;  // from the start: free space is learned for 3 s, heights for 45
constexpr double rim = 0.5;                // m, to the terrain's edge
constexpr double beside_sweep = 25 * degree, beyond_reach = 1.5;  // nobody begins where the implements may be within a step
constexpr double last_step = 0.6;          // m, how near to the machine's own circle a way ends
constexpr double beside_face = 2.5;        // m: some come up beside what is dug
constexpr double clear_of_truck = 0.1;     // m
constexpr double least_gap = 0.1, most_gap = 0.3;  // m, beside the truck's side
constexpr double beside_truck_s = 20.0;    // there: more than a whole pass, so that what is measured is the detection and not where the scanners look

struct Point { double x, y; };

Point at(double radius, double bearing) { return {radius * std::cos(bearing), radius * std::sin(bearing)}; }

// Outline of the truck with its cab in the bed's frame: x along the bed to the cab.
struct TruckOutline { double x_low, x_high, half_width; };
TruckOutline outline_of(const plant::TruckConfig& t) {
  const double end = 0.5 * t.length + t.wall_thickness;
  return {-end, end + (t.cab_length > 0.0 ? t.cab_gap + t.cab_length : 0.0), 0.5 * t.width + t.wall_thickness};
}

Point out_of(const plant::TruckConfig& t, double along, double across) {
  return {t.x + along * std::cos(t.yaw) - across * std::sin(t.yaw), t.y + along * std::sin(t.yaw) + across * std::cos(t.yaw)};
}

double half_size(const plant::MoverConfig& m) { return m.vehicle ? 0.5 * std::hypot(m.length, m.width) : m.radius; }

bool in_extent(const IntrusionSite& s, const Point& p) { return std::fabs(p.x) < s.extent[0] - rim && std::fabs(p.y) < s.extent[1] - rim; }

// Where nobody may begin: what the implements sweep, and a bit round it.
bool in_sweep(const IntrusionSite& s, const Point& p, double half) {
  const double middle = 0.5 * (s.swing_low + s.swing_high);
  const double off = std::fabs(std::remainder(std::atan2(p.y, p.x) - middle, 2.0 * std::numbers::pi));
  return off < 0.5 * (s.swing_high - s.swing_low) + beside_sweep && std::hypot(p.x, p.y) < s.implements_reach + beyond_reach + half;
}

bool is_free(const IntrusionSite& s, const plant::MoverConfig& m) {
  constexpr double step = 0.2;
  for (std::size_t i = 0; i + 1 < m.waypoints.size(); ++i) {
    const WaypointConfig &a = m.waypoints[i], &b = m.waypoints[i + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    for (double along = 0.0; along <= length; along += step) {
      const double f = length > 0.0 ? along / length : 0.0, x = a.x + f * (b.x - a.x), y = a.y + f * (b.y - a.y);
      if (distance_from_truck(s.truck, x, y) < half_size(m) + clear_of_truck || std::hypot(x, y) < s.own_radius + half_size(m)) return false;
    }
  }
  return true;
}

bool may_begin(const IntrusionSite& s, const plant::MoverConfig& m) {
  const Point p{m.waypoints.front().x, m.waypoints.front().y};
  return in_extent(s, p) && !in_sweep(s, p, half_size(m));
}

void draw_who(Draw& draw, Intrusion& in) {
  const double kind = draw.unit();
  const bool on_foot = in.way == Way::dig_face || in.way == Way::truck_side;
  in.who = kind < 0.5 ? Who::adult : kind < 0.88 || on_foot ? Who::child : Who::vehicle;
  in.running = draw.chance(0.35);
  plant::MoverConfig& m = in.mover;
  m.name = name_of(in.who);
  m.vehicle = in.who == Who::vehicle;
  m.height = in.who == Who::adult ? 1.8 : in.who == Who::child ? 1.1 : 1.5;
  if (m.vehicle) {
    m.length = 4.0;
    m.width = 1.8;
  } else {
    m.radius = in.who == Who::adult ? 0.25 : 0.15;
  }
  m.speed = in.running ? draw.between(2.0, 4.0) : draw.between(1.0, 1.6);
}

void draw_dig_face(Draw& draw, const IntrusionSite& s, Intrusion& in) {
  const double half = s.half_face + beside_face;
  const Point from{draw.between(s.region_radius + 0.3, s.extent[0] - rim - 0.1), draw.between(-half, half)};
  const Point to{draw.between(s.crest_x - 1.5, s.crest_x - 0.5), draw.between(-half, half)};
  in.mover.waypoints = {{from.x, from.y, 0.0}, {to.x, to.y, 0.0}};
}

// Beside the truck from the first: from near the end that lies farther from the sweep, along the side that faces the machine, to somewhere there, and
// later on towards the machine.
void draw_truck_side(Draw& draw, const IntrusionSite& s, Intrusion& in) {
  const TruckOutline o = outline_of(s.truck);
  const double c = std::cos(s.truck.yaw), sn = std::sin(s.truck.yaw);
  const double side = -sn * -s.truck.x + c * -s.truck.y > 0.0 ? 1.0 : -1.0;
  in.side_gap_m = draw.between(least_gap, most_gap);
  const double across = side * (o.half_width + in.side_gap_m + half_size(in.mover));
  const auto off_sweep = [&](double along) {
    const Point p = out_of(s.truck, along, across);
    return std::fabs(std::remainder(std::atan2(p.y, p.x) - 0.5 * (s.swing_low + s.swing_high), 2.0 * std::numbers::pi));
  };
  const bool from_cab = off_sweep(o.x_high) > off_sweep(o.x_low);
  const double begin = from_cab ? o.x_high - draw.between(0.0, 1.0) : o.x_low + draw.between(0.0, 1.0), turn = draw.between(o.x_low, o.x_high);
  const Point from = out_of(s.truck, begin, across), corner = out_of(s.truck, turn, across);
  const Point to = at(s.own_radius + last_step, std::atan2(corner.y, corner.x));
  in.mover.waypoints = {{from.x, from.y, 0.0}, {corner.x, corner.y, beside_truck_s}, {to.x, to.y, 0.0}};
}

void draw_towards(Draw& draw, const IntrusionSite& s, Intrusion& in) {
  const double bearing = draw.between(-180.0, 180.0) * degree;
  const Point from = at(draw.between(5.0, 20.0), bearing);
  const Point to = at(s.own_radius + last_step + half_size(in.mover), bearing + draw.between(-30.0, 30.0) * degree);
  in.mover.waypoints = {{from.x, from.y, 0.0}, {to.x, to.y, 0.0}};
}

void draw_crossing(Draw& draw, const IntrusionSite& s, Intrusion& in) {
  const double bearing = draw.between(-180.0, 180.0) * degree, nearest = draw.between(s.own_radius + last_step, s.region_radius - 2.5);
  const double half = std::sqrt(std::pow(s.region_radius + 1.0, 2) - nearest * nearest), way = draw.chance(0.5) ? 1.0 : -1.0;
  const Point foot = at(nearest, bearing), along{-way * std::sin(bearing), way * std::cos(bearing)};
  in.mover.waypoints = {{foot.x - half * along.x, foot.y - half * along.y, 0.0}, {foot.x + half * along.x, foot.y + half * along.y, 0.0}};
}

}  // namespace

const char* name_of(Way way) {
  switch (way) {
    case Way::dig_face: return "dig_face";
    case Way::truck_side: return "truck_side";
    case Way::towards: return "towards";
    default: return "crossing";
  }
}

const char* name_of(Who who) { return who == Who::adult ? "adult" : who == Who::child ? "child" : "vehicle"; }

double distance_from_truck(const plant::TruckConfig& t, double x, double y) {
  const TruckOutline o = outline_of(t);
  const double c = std::cos(t.yaw), s = std::sin(t.yaw), dx = x - t.x, dy = y - t.y;
  const double along = c * dx + s * dy, across = std::fabs(c * dy - s * dx) - o.half_width;
  return std::hypot(std::max({along - o.x_high, o.x_low - along, 0.0}), std::max(across, 0.0));
}

Intrusion draw_intrusion(std::uint64_t seed, int run, const IntrusionSite& site, When when) {
  Draw draw(seed, run);
  Intrusion in;
  in.seed = seed;
  in.run = run;
  in.follows = draw.chance(0.5);
  const double way = draw.unit();
  in.way = way < 0.2 ? Way::dig_face : way < 0.4 ? Way::truck_side : way < 0.75 ? Way::towards : Way::crossing;
  draw_who(draw, in);
  in.when = when;
  in.waits_s = when == When::learned ? draw.between(0.0, longest_wait_s) : draw.between(first_while_learning_s, last_while_learning_s);
  do {
    switch (in.way) {
      case Way::dig_face: draw_dig_face(draw, site, in); break;
      case Way::truck_side: draw_truck_side(draw, site, in); break;
      case Way::towards: draw_towards(draw, site, in); break;
      case Way::crossing: draw_crossing(draw, site, in); break;
    }
  } while (!may_begin(site, in.mover) || !is_free(site, in.mover));
  return in;
}

double way_time(const plant::MoverConfig& mover) {
  double length = 0.0, waits_s = 0.0;
  for (const WaypointConfig& w : mover.waypoints) waits_s += w.wait_s;
  for (std::size_t i = 0; i + 1 < mover.waypoints.size(); ++i)
    length += std::hypot(mover.waypoints[i + 1].x - mover.waypoints[i].x, mover.waypoints[i + 1].y - mover.waypoints[i].y);
  return length / mover.speed + waits_s;
}

std::string describe(const Intrusion& in) {
  std::string text = fmt::format("{} {} at {:.2f} m/s, way {}", in.who == Who::adult ? "an adult" : in.who == Who::child ? "a child" : "a vehicle",
                                 in.running ? "running" : "walking", in.mover.speed, name_of(in.way));
  if (in.way == Way::truck_side) text += fmt::format(" ({:.2f} m from it)", in.side_gap_m);
  for (const auto& w : in.mover.waypoints) text += fmt::format("{} ({:.2f}, {:.2f})", &w == in.mover.waypoints.data() ? " from" : " to", w.x, w.y);
  return text + (in.follows ? ", MergeCell of Figure 7" : ", MergeCell of Figure 8");
}

}  // namespace berm::watch
