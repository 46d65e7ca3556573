#include "watch/monitor_picture.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "run/svg.hpp"

namespace berm::watch {

namespace {

using run::Point2;
using run::SvgPanel;

struct Colour { std::uint16_t flag; const char* fill; const char* words; };
constexpr std::array<Colour, 7> colours{{
    {SK_FLAG_EMPTY, "#f4f4f5", "EMPTY: no range data"},
    {SK_FLAG_SET, "#86b386", "SET: seen"},
    {SK_FLAG_INTERPOLATED, "#cfe3f5", "INTERPOLATED: a line passed over it"},
    {SK_FLAG_NOT_VISITED, "#3f7f5f", "NOT_VISITED: seen, nothing new since the last update"},
    {SK_FLAG_INTERPOLATED_NOT_VISITED, "#7fb0dd", "I_NOT_VISITED: the same, of a line"},
    {SK_FLAG_CHANGED, "#f2c14e", "CHANGED: rose, explained by a neighbour"},
    {SK_FLAG_OBSTACLE, "#d7263d", "OBSTACLE: something that moved"},
}};
// Of the cells where histograms are compared with.
enum Known : std::uint16_t { learning, nothing, lines, enough, somebody };
constexpr std::array<Colour, 5> histogram_colours{{
    {learning, "#e9d8f4", "LEARNING: what is seen is counted, nobody is told of"},
    {nothing, "#f4f4f5", "CLEAR, nothing known of the ground"},
    {lines, "#cfe3f5", "CLEAR, fewer than 8 points seen: the ground is what lines agree on"},
    {enough, "#86b386", "CLEAR, 8 points or more seen"},
    {somebody, "#d7263d", "SOMEBODY"},
}};
constexpr const char* no_flag_fill = "#7c3aed";  // counts as an obstacle
constexpr double cell_m = SK_CELL_MM * 1e-3, origin_m = SK_MAP_ORIGIN_MM * 1e-3, edge_m = -origin_m;
constexpr double left = 60, top = 40, scale = 18, between = 90;

Known known_of(const sk_monitor_histogram& h, int iy, int ix) {
  if (h.state[iy][ix] == SK_CELL_LEARNING) return learning;
  if (h.state[iy][ix] != SK_CELL_CLEAR) return somebody;
  if (h.observed[iy][ix] >= SK_HISTOGRAM_ENOUGH) return enough;
  return h.lines[iy][ix] >= SK_LINES_ENOUGH ? lines : nothing;
}

const char* fill_of(std::span<const Colour> from, std::uint16_t flag) {
  for (const Colour& c : from)
    if (c.flag == flag) return c.fill;
  return no_flag_fill;
}

// Runs of cells of one flag in a row become one rectangle.
template <typename FlagAt>
void draw_flags(SvgPanel& panel, std::span<const Colour> from, FlagAt flag_at) {
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy) {
    for (int ix = 0; ix < SK_MAP_CELLS;) {
      const std::uint16_t flag = flag_at(iy, ix);
      int end = ix + 1;
      while (end < SK_MAP_CELLS && flag_at(iy, end) == flag) ++end;
      panel.rectangle(origin_m + ix * cell_m, origin_m + iy * cell_m, (end - ix) * cell_m, cell_m,
                      fmt::format("fill:{};shape-rendering:crispEdges", fill_of(from, flag)));
      ix = end;
    }
  }
}

// The sides that a watched cell does not share with another.
void draw_region_edge(SvgPanel& panel, const sk_monitor_rules& rules) {
  const auto watched = [&](int iy, int ix) { return sk_is_in_map(iy, ix) && rules.watched[iy][ix] != 0; };
  const std::string style = "stroke:#111;stroke-width:1.6";
  for (int iy = 0; iy < SK_MAP_CELLS; ++iy) {
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      if (!watched(iy, ix)) continue;
      const double x = origin_m + ix * cell_m, y = origin_m + iy * cell_m;
      if (!watched(iy - 1, ix)) panel.line({{x, y}, {x + cell_m, y}}, style);
      if (!watched(iy + 1, ix)) panel.line({{x, y + cell_m}, {x + cell_m, y + cell_m}}, style);
      if (!watched(iy, ix - 1)) panel.line({{x, y}, {x, y + cell_m}}, style);
      if (!watched(iy, ix + 1)) panel.line({{x + cell_m, y}, {x + cell_m, y + cell_m}}, style);
    }
  }
}

std::vector<Point2> outline(const Footprint& f) {
  std::vector<Point2> points;
  for (const auto& [u, v] : {Point2{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    const double along = u * f.length, across = v * f.width;
    points.emplace_back(f.x + along * std::cos(f.yaw) - across * std::sin(f.yaw), f.y + along * std::sin(f.yaw) + across * std::cos(f.yaw));
  }
  return points;
}

void draw_truth(SvgPanel& panel, const MonitorPictureInput& in) {
  for (const auto& zone : in.site.dig_zones) panel.polygon(zone, "fill:none;stroke:#b45309;stroke-width:2;stroke-dasharray:6 4");
  if (!in.site.truck_bed.empty()) panel.polygon(in.site.truck_bed, "fill:none;stroke:#111;stroke-width:1.5;stroke-dasharray:2 2");
  for (const auto& path : in.paths) {
    if (path.points.empty()) continue;
    panel.line(path.points, "stroke:#1d4ed8;stroke-width:2");
    panel.text(path.points.front().first + 0.3, path.points.front().second, path.name, "font-size:12px;fill:#1d4ed8");
  }
  for (const Footprint& f : in.now) {
    if (f.length > 0.0) panel.polygon(outline(f), "fill:#1d4ed8;stroke:#fff");
    else panel.circle(f.x, f.y, f.radius, "fill:#1d4ed8;stroke:#fff");
  }
  for (const Alarm& a : in.alarms) {
    panel.circle(a.x, a.y, 0.6, a.nearest.empty() ? "fill:none;stroke:#7c3aed;stroke-width:3" : "fill:none;stroke:#111;stroke-width:2.5");
    panel.text(a.x + 0.7, a.y - 0.9, fmt::format("{:.1f} s", a.time_s), "font-size:11px");  // under the names, which begin at the height of their ways
  }
  panel.circle(0, 0, 0.2, "fill:#fff;stroke:#111");
}

std::string legend(std::span<const Colour> from, bool histograms, double at_x, double at_y) {
  std::string text;
  const auto row = [&](const std::string& sign, const std::string& words) {
    text += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">{}<text x=\"24\" y=\"12\" style=\"font:13px sans-serif\">{}</text></g>\n", at_x,
                        at_y, sign, words);
    at_y += 21;
  };
  const auto square = [](const char* fill) { return fmt::format("<rect width=\"16\" height=\"14\" fill=\"{}\" stroke=\"#999\"/>", fill); };
  const double first = at_y;
  for (const Colour& c : from) row(square(c.fill), c.words);
  if (!histograms) row(square(no_flag_fill), "none of the seven: counts as an obstacle");
  at_x += 480, at_y = first;
  row("<path d=\"M0 7 H16\" stroke=\"#111\" stroke-width=\"2\"/>", "edge of the safety region");
  row("<path d=\"M0 7 H16\" stroke=\"#1d4ed8\" stroke-width=\"2\"/>", "true way of a person or vehicle, over the whole run");
  row("<circle cx=\"8\" cy=\"7\" r=\"5\" fill=\"#1d4ed8\"/>", "where it was at this moment");
  row("<circle cx=\"8\" cy=\"7\" r=\"6\" fill=\"none\" stroke=\"#111\" stroke-width=\"2.5\"/>", "cell of an alarm, with its time");
  row("<circle cx=\"8\" cy=\"7\" r=\"6\" fill=\"none\" stroke=\"#7c3aed\" stroke-width=\"3\"/>", "cell of a false alarm: nobody within 1 m");
  row("<path d=\"M0 7 H16\" stroke=\"#b45309\" stroke-width=\"2\" stroke-dasharray=\"6 4\"/>", "dig zone");
  row("<path d=\"M0 7 H16\" stroke=\"#111\" stroke-width=\"1.5\" stroke-dasharray=\"2 2\"/>", "truck's bed, as it was recognised");
  return text;
}

}  // namespace

void write_monitor_picture(const std::string& path, const MonitorPictureInput& in) {
  SvgPanel first(-edge_m, -edge_m, edge_m, edge_m, left, top, scale);
  SvgPanel second(-edge_m, -edge_m, edge_m, edge_m, left + first.pixel_width() + between, top, scale);
  const bool histograms = in.histogram != nullptr;
  if (histograms) {
    draw_flags(first, histogram_colours, [&](int iy, int ix) { return std::uint16_t{known_of(*in.histogram, iy, ix)}; });
  } else {
    draw_flags(first, colours, [&](int iy, int ix) { return in.monitor.accumulated_flag[iy][ix]; });
    draw_flags(second, colours, [&](int iy, int ix) { return std::uint16_t{in.monitor.temporary_flag[iy][ix]}; });
  }
  const auto panels = histograms ? std::vector<SvgPanel*>{&first} : std::vector<SvgPanel*>{&first, &second};
  for (SvgPanel* panel : panels) {
    draw_region_edge(*panel, in.rules);
    draw_truth(*panel, in);
    panel->axes(5.0, "x (m), forward", "y (m), left");
  }
  first.title((histograms ? "What the histograms hold: " : "Accumulated map: ") + in.title);
  second.title("Temporary map at the same moment");
  const double below = top + first.pixel_height() + 50, wide = histograms ? 1020.0 : left + 2 * first.pixel_width() + between + 40;
  const std::span<const Colour> used = histograms ? std::span<const Colour>(histogram_colours) : std::span<const Colour>(colours);
  run::write_svg(path, wide, below + 190, {panels.begin(), panels.end()}, legend(used, histograms, left, below));
}

}  // namespace berm::watch
