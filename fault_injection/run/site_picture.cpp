#include "run/site_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "run/map_picture.hpp"
#include "run/trace_reader.hpp"

namespace berm::run {

namespace {

constexpr std::array<const char*, BERM_JOINTS> kLinkColours{"#888888", "#1d4ed8", "#0e7490", "#b91c1c"};
constexpr const char* kPathStyle = "stroke:#7c3aed;stroke-width:1;stroke-opacity:0.7";
// What a reader can follow and a viewer can draw, whatever the run's length: hours would be one blot of many megabytes.
constexpr double kSeen_m = 0.03;           // about a pixel; who stands adds nothing
constexpr std::size_t kMostOfTip = 6000;   // ten minutes of motion at a point each 0.1 s
constexpr std::size_t kMostOfMovers = 40000;  // together: eight hours of those who come and go, one point a second

struct Tip { double r, z; };

Tip bucket_tip(const SitePictureInput& in, const std::array<double, 4>& q) {
  const double boom = q[1], stick = boom + q[2], bucket = stick + q[3];
  return {in.arm.boom_pin_x + in.arm.boom * std::cos(boom) + in.arm.stick * std::cos(stick) + in.arm.bucket * std::cos(bucket),
          in.arm.boom_pin_z + in.arm.boom * std::sin(boom) + in.arm.stick * std::sin(stick) + in.arm.bucket * std::sin(bucket)};
}

// Of a way, from its end back: the places that differ from the next one taken by what can be seen, the latest so many. In the way's order.
template <typename Distance>
std::vector<std::size_t> latest_seen(std::size_t count, std::size_t most, Distance distance) {
  std::vector<std::size_t> taken;
  for (std::size_t i = count; i-- > 0 && taken.size() < most;)
    if (taken.empty() || distance(i, taken.back()) >= kSeen_m) taken.push_back(i);
  std::reverse(taken.begin(), taken.end());
  return taken;
}

struct TipWay {
  std::vector<Point2> above, side;
  std::string caption = "path of the bucket's tip";
};

TipWay tip_way(const SitePictureInput& in) {
  std::vector<std::array<double, 3>> place;
  for (const auto& point : in.path) {
    const auto [r, z] = bucket_tip(in, point.angle_rad);
    place.push_back({r * std::cos(point.angle_rad[0]), r * std::sin(point.angle_rad[0]), z});
  }
  const auto taken = latest_seen(place.size(), kMostOfTip, [&place](std::size_t a, std::size_t b) {
    return std::hypot(place[a][0] - place[b][0], place[a][1] - place[b][1], place[a][2] - place[b][2]);
  });
  TipWay way;
  for (const std::size_t i : taken) {
    const auto& [x, y, z] = place[i];
    way.above.emplace_back(x, y);
    way.side.emplace_back(std::hypot(x, y), z);
  }
  if (taken.size() == kMostOfTip) way.caption += fmt::format(", last {:.0f} min", (in.path.back().time_s - in.path[taken.front()].time_s) / 60);
  return way;
}

std::vector<Point2> mover_way(const MoverPath& mover, std::size_t most) {
  std::vector<Point2> way;
  const auto& all = mover.points;
  for (const std::size_t i : latest_seen(all.size(), most, [&all](std::size_t a, std::size_t b) { return std::hypot(all[a].first - all[b].first, all[a].second - all[b].second); }))
    way.push_back(all[i]);
  return way;
}

// Convex outline of a slice in a plane (Andrew's monotone chain).
std::vector<Point2> hull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto turn = [](const Point2& a, const Point2& b, const Point2& c) {
    return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
  };
  std::vector<Point2> chain;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = chain.size();
    for (const auto& point : points) {
      while (chain.size() >= base + 2 && turn(chain[chain.size() - 2], chain.back(), point) <= 0) chain.pop_back();
      chain.push_back(point);
    }
    chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

template <typename Project>
void draw_slices(SvgPanel& panel, const SliceSnapshot& swept, Project project) {
  for (const auto& slice : swept.slices) {
    std::vector<Point2> points;
    for (std::uint32_t v = 0; v < std::min<std::uint32_t>(slice.vertices, BERM_SLICE_VERTICES); ++v) points.push_back(project(slice.vertex_mm[v]));
    const std::string colour = kLinkColours[slice.link < kLinkColours.size() ? slice.link : 0];
    panel.polygon(hull(points), fmt::format("fill:{0};fill-opacity:0.06;stroke:{0};stroke-opacity:0.45;stroke-width:0.6", colour));
  }
}

std::vector<Point2> profile(const MapSnapshot& map, double bearing, double r0, double r1) {
  std::vector<Point2> line;
  for (double r = r0; r <= r1; r += map.cell_m / 2) {
    const int ix = static_cast<int>(std::floor((r * std::cos(bearing) - map.origin_m) / map.cell_m));
    const int iy = static_cast<int>(std::floor((r * std::sin(bearing) - map.origin_m) / map.cell_m));
    if (ix < 0 || iy < 0 || ix >= BERM_MAP_CELLS || iy >= BERM_MAP_CELLS) continue;
    const auto i = static_cast<std::size_t>(iy * BERM_MAP_CELLS + ix);
    if (map.status[i] == BERM_CELL_OBSERVED || map.status[i] == BERM_CELL_STALE) line.emplace_back(r, map.height_mm[i] * 1e-3);
  }
  return line;
}

void draw_from_above(SvgPanel& panel, const SitePictureInput& in, const TipWay& tip, HeightRange range) {
  draw_map(panel, in.map, range);
  for (const auto& zone : in.dig_zones) panel.polygon(zone, "fill:none;stroke:#b45309;stroke-width:2;stroke-dasharray:6 4");
  if (!in.truck_bed.empty()) panel.polygon(in.truck_bed, "fill:none;stroke:#111;stroke-width:2");
  draw_slices(panel, in.swept, [](const std::int32_t (&v)[3]) { return Point2(v[0] * 1e-3, v[1] * 1e-3); });
  panel.line(tip.above, kPathStyle);
  for (const auto& mover : in.movers) {
    if (mover.points.empty()) continue;
    const std::size_t most = kMostOfMovers / in.movers.size();
    const std::vector<Point2> way = mover_way(mover, most);
    const std::string colour = is_truck(mover.name) ? "#57534e" : "#dc2626";  // red is who may not be there
    panel.line(way, "stroke:" + colour + ";stroke-width:2;stroke-dasharray:2 3");
    panel.circle(mover.points.back().first, mover.points.back().second, 0.25, "fill:" + colour);
    panel.text(mover.points.back().first + 0.4, mover.points.back().second, mover.name + (way.size() == most ? ", latest way" : ""), "font-size:12px;fill:" + colour);
  }
  std::set<Point2> stopped;  // at one cell over and over, in a long run
  for (const auto& stop : in.stops)
    if (stop.has_place && stopped.emplace(stop.x_m, stop.y_m).second) panel.circle(stop.x_m, stop.y_m, 0.2, "fill:none;stroke:#dc2626;stroke-width:2");
  panel.circle(0, 0, 0.15, "fill:#fff");
  panel.axes(5.0, "x (m), forward", "y (m), left");
  panel.title("From above: " + in.title);
}

void draw_from_side(SvgPanel& panel, const SitePictureInput& in, const TipWay& tip) {
  draw_slices(panel, in.swept, [](const std::int32_t (&v)[3]) { return Point2(std::hypot(v[0], v[1]) * 1e-3, v[2] * 1e-3); });
  panel.line(profile(in.map, in.dig_bearing_rad, 3.0, 15.0), "stroke:#b45309;stroke-width:2");
  panel.line(profile(in.map, in.truck_bearing_rad, 3.0, 15.0), "stroke:#111;stroke-width:2");
  panel.line(tip.side, kPathStyle);
  panel.axes(2.0, "distance from the swing axis (m)", "height (m)");
  panel.title("From the side, in the swing plane: ground at the dig face (brown) and at the truck (black)");
  panel.text(9.2, 6.4, "swept volume of the fastest swing: boom", fmt::format("font-size:11px;fill:{}", kLinkColours[1]));
  panel.text(9.2, 5.95, "stick", fmt::format("font-size:11px;fill:{}", kLinkColours[2]));
  panel.text(9.2, 5.5, "bucket with its heaviest load", fmt::format("font-size:11px;fill:{}", kLinkColours[3]));
  panel.text(9.2, 5.05, tip.caption, "font-size:11px;fill:#7c3aed");
}

}  // namespace

void write_site_picture(const std::string& path, const SitePictureInput& in) {
  const auto range = height_range(in.map);
  SvgPanel above(-6.0, -8.0, 14.0, 13.0, 60, 40, 36.0);
  SvgPanel side(-1.0, -4.0, 14.0, 7.0, 60, 40 + above.pixel_height() + 110, 48.0);
  const TipWay tip = tip_way(in);
  draw_from_above(above, in, tip, range);
  draw_from_side(side, in, tip);
  write_svg(path, above.pixel_width() + 90, above.pixel_height() + side.pixel_height() + 200, {&above, &side},
            colour_bar(60, 40 + above.pixel_height() + 42, above.pixel_width(), range));
}

}  // namespace berm::run
