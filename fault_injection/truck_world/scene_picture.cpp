#include "truck_world/scene_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "run/svg.hpp"

namespace berm::truck_world {
namespace {

constexpr double margin_m = 5.0;        // from above: round the swing axis and the place
constexpr double side_half = 7.5;       // m of the side view to either side of the place
constexpr double strip = 3.0;           // m: the side view takes points this far beside the place
constexpr double picture_width = 940.0, panel_width = 760.0;  // pixels

struct Colour { std::string_view name, fill; };
constexpr std::array<Colour, 9> colours{{{"ground", "#b9a88a"},
                                         {"walls", "#1f5fa8"},
                                         {"floor", "#37a3a3"},
                                         {"load", "#8a4b1d"},
                                         {"cab, canopy, chassis", "#7fa7d6"},
                                         {"look-alike", "#c2388f"},
                                         {"clutter", "#5d8a3a"},
                                         {"occluder", "#8757c4"},
                                         {"outlier", "#e02020"}}};

std::size_t colour_of(const PointTruth& p) {
  if (p.outlier) return 8;
  switch (p.surface) {
    case Surface::ground: return 0;
    case Surface::wall_front:
    case Surface::wall_rear:
    case Surface::wall_left:
    case Surface::wall_right: return 1;
    case Surface::bed_floor: return 2;
    case Surface::load: return 3;
    case Surface::truck_body: return 4;
    case Surface::look_alike: return 5;
    case Surface::clutter: return 6;
    case Surface::occluder:
    case Surface::own_arm: break;
  }
  return 7;
}

template <typename Project>
void draw_points(run::SvgPanel& panel, const Scene& scene, double size, const Project& project) {
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const app::ScanPoint& p = scene.cloud[i];
    const auto at = project(Vector3d(p.x, p.y, p.z));
    if (!at) continue;
    const std::string style = fmt::format("fill:{}", colours[colour_of(scene.point_truth[i])].fill);
    panel.rectangle(at->first - size / 2, at->second - size / 2, size, size, style);
  }
}

template <typename Project>
void draw_opening(run::SvgPanel& panel, const TruckTruth& truck, const Project& project) {
  std::vector<run::Point2> outline;
  for (const Vector3d& corner : truck.corners)
    if (const auto at = project(corner)) outline.push_back(*at);
  panel.polygon(outline, "fill:none;stroke:#111;stroke-width:1.6");
  constexpr std::array<const char*, 4> names{"1", "2", "3", "4"};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    panel.circle(outline[i].first, outline[i].second, 0.09, "fill:#ffd000;stroke:#111;stroke-width:1");
    panel.text(outline[i].first + 0.15, outline[i].second + 0.15, names[i], "font-size:13px;font-weight:bold");
  }
}

std::string words_of(const SceneTruth& t) {
  std::string words = fmt::format("scene {} of seed {}: ", t.scene, t.seed);
  if (t.truck) {
    const TruckTruth& k = t.of_truck;
    words += fmt::format("{}, {:.2f} x {:.2f} x {:.2f} m, tailgate {}, {} ({:.1f} of {:.1f} m3)", k.truck_class, k.inside_length, k.inside_width,
                         k.wall_height, k.tailgate, k.fill, k.fill_m3, k.struck_m3);
  } else {
    words += t.look_alike.empty() ? "no truck" : fmt::format("no truck, {}", t.look_alike);
  }
  return words;
}

std::string second_line(const SceneTruth& t) {
  std::string words = fmt::format("{}, {} points, {} outliers", name_of(t.sensor), t.returns, t.outliers);
  if (t.swing_rate != 0.0) words += fmt::format(", swinging at {:.2f} rad/s", t.swing_rate);
  if (!t.truck) return words;
  const TruckTruth& k = t.of_truck;
  words += fmt::format(", {} on the truck; edge without a return {:.0f} %, out of sight {:.0f} %", k.returns, 100 * k.hidden_share,
                       100 * k.occluded_share);
  if (!k.occluder.empty()) words += " (" + k.occluder + (k.wall_hidden.empty() ? "" : " before " + k.wall_hidden) + ")";
  return words;
}

}  // namespace

void write_picture(const std::string& path, const Scene& scene) {
  const SceneTruth& t = scene.truth;
  const Vector2d low = t.place.cwiseMin(0.0).array() - margin_m, high = t.place.cwiseMax(0.0).array() + margin_m;
  const double left = 60.0, scale = std::min(panel_width / (high.x() - low.x()), 620.0 / (high.y() - low.y()));
  run::SvgPanel above(low.x(), low.y(), high.x(), high.y(), left, 90.0, scale);
  using Place = std::optional<run::Point2>;
  const auto from_above = [](const Vector3d& p) { return Place({p.x(), p.y()}); };
  draw_points(above, scene, 0.07, from_above);
  above.circle(0.0, 0.0, 0.15, "fill:#111");
  above.text(0.3, 0.1, "swing axis");
  above.circle(t.viewpoint.x(), t.viewpoint.y(), 0.12, "fill:#e07000");
  above.text(t.viewpoint.x() + 0.3, t.viewpoint.y() - 0.1, "sensor");
  if (t.truck) draw_opening(above, t.of_truck, from_above);
  above.axes(2.0, "x, m (forward)", "y, m (left)");
  above.title("from above");

  // Along the bed, or across the line of sight where there is none.
  const double yaw = t.truck ? t.of_truck.yaw : std::atan2(t.place.y(), t.place.x()) + pi / 2;
  const Vector2d ahead(std::cos(yaw), std::sin(yaw)), aside(-ahead.y(), ahead.x());
  const double side_scale = panel_width / (2 * side_half), top = 90.0 + above.pixel_height() + 80.0;
  run::SvgPanel side(-side_half, -t.drop - 1.0, side_half, 4.2, left, top, side_scale);
  const auto from_side = [&](const Vector3d& p) -> Place {
    const Vector2d local = p.head<2>() - t.place;
    if (std::abs(local.dot(aside)) > strip) return std::nullopt;
    return run::Point2{local.dot(ahead), p.z()};
  };
  draw_points(side, scene, 0.05, from_side);
  if (t.truck) draw_opening(side, t.of_truck, from_side);
  side.axes(1.0, t.truck ? "along the bed, m (to the cab)" : "across the line of sight, m", "z, m");
  side.title(fmt::format("from the side: what is within {:g} m of the {}", strip, t.truck ? "bed's long axis" : "place"));

  std::string extra = fmt::format(
      "<text x=\"{0}\" y=\"26\" style=\"font:bold 15px sans-serif\">{1}</text>\n"
      "<text x=\"{0}\" y=\"48\" style=\"font:13px sans-serif\">{2}</text>\n",
      left, words_of(t), second_line(t));
  const double legend = left + std::max(above.pixel_width(), 560.0) + 20.0;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double y = 100.0 + 20.0 * static_cast<double>(i);
    extra += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"11\" height=\"11\" fill=\"{}\"/>\n", legend, y, colours[i].fill);
    extra += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" style=\"font:12px sans-serif\">{}</text>\n", legend + 16, y + 10, colours[i].name);
  }
  run::write_svg(path, std::max(picture_width, legend + 150.0), top + side.pixel_height() + 50.0, {&above, &side}, extra);
}

}  // namespace berm::truck_world
