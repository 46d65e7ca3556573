#include "echoes/echo_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "echoes/echo_table.hpp"
#include "plant/world/echo_receiver.hpp"
#include "run/svg.hpp"

namespace berm::echoes {
namespace {

using plant::Ranging;
using run::SvgPanel;

constexpr double left = 60.0, gap = 70.0, width = 560.0, first_top = 100.0;       // pixels
constexpr double far_m = 14.0, high_m = 4.4;                                        // of a scanline's panel
constexpr const char* truck_style = "fill:#d9d9d9;stroke:#777;stroke-width:0.8";
constexpr const char* cloud_style = "fill:#c89b5a;fill-opacity:0.22";
constexpr const char* target_colour = "#1f5fa8";
constexpr const char* wrong_colour = "#d22b2b";
constexpr const char* ground_colour = "#7a6a4f";

SvgPanel scanline_panel(const Stage& stage, Ranging ranging, double extinction, double at_left, double at_top) {
  SvgPanel panel(-0.5, -0.5, far_m, high_m, at_left, at_top, width / (far_m + 0.5));
  const Box cloud = stage.cloud_box(Place::about);
  if (extinction > 0.0) panel.rectangle(cloud.x_low, cloud.z_low, cloud.x_high - cloud.x_low, cloud.z_high - cloud.z_low, cloud_style);
  for (const Box& b : stage.truck_boxes()) panel.rectangle(b.x_low, b.z_low, b.x_high - b.x_low, b.z_high - b.z_low, truck_style);
  panel.line({{-0.5, 0.0}, {far_m, 0.0}}, "stroke:#999;stroke-width:1");
  panel.circle(0.0, stage.head_z(), 0.14, "fill:#e07000");
  const std::vector<EchoSample> samples = stage.scan(ranging, Place::about, extinction, 1);
  for (const EchoSample& s : samples) {
    if (s.echoes == 0) continue;
    const bool right = std::abs(s.range - s.truth) < met_m;
    const double x = s.range * std::cos(s.elevation), z = stage.head_z() + s.range * std::sin(s.elevation);
    panel.circle(x, z, 0.065, fmt::format("fill:{}", !right ? wrong_colour : s.truck ? target_colour : ground_colour));
  }
  const EchoRow row = row_of(samples, Place::about, extinction, ranging);
  panel.axes(2.0, "forward of the scanner, m", "height, m");
  panel.title(fmt::format("{}, {}: {:.0f} of {} beams at the rear range it", name_of(ranging),
                          extinction > 0.0 ? fmt::format("dust of {:g} /m", extinction) : "clear air", row.met * row.samples, row.samples));
  return panel;
}

constexpr double level_top = 4.2, wave_end = 10.0;

// The return of one pulse; how high is the logarithm of its level, so that 0 is the noise.
SvgPanel waveform_panel(const Stage& stage, const StageOptions& options, Place place, double extinction, double at_left, double at_top) {
  SvgPanel panel(-0.6, -0.4, wave_end, level_top, at_left, at_top, width / (wave_end + 0.6));
  const plant::PulsePath path = stage.path(place, extinction);
  plant::ReturnWaveform wave;
  wave.sample(path, options.seed);
  const plant::CloudSpan& cloud = path.clouds.front();
  panel.rectangle(cloud.from, -0.4, cloud.to - cloud.from, level_top + 0.4, cloud_style);
  panel.text(cloud.from + 0.1, 3.85, fmt::format("dust, {:g} /m", extinction));
  panel.line({{path.target->range, -0.4}, {path.target->range, level_top}}, "stroke:#555;stroke-width:1");
  panel.text(path.target->range + 0.12, 3.85, "truck's rear");
  const double threshold = std::log10(plant::EchoReceiver::threshold);
  panel.line({{-0.6, threshold}, {wave_end, threshold}}, "stroke:#2e8b57;stroke-dasharray:5 4");
  panel.text(8.9, threshold + 0.1, "threshold");
  panel.text(-0.5, std::log10(wave.lidar().window_clean + 0.02 * wave.lidar().window_opaque) + 0.12, "window");
  std::vector<run::Point2> curve;
  for (std::size_t i = 0; i < wave.level().size(); ++i)
    curve.push_back({wave.range(static_cast<double>(i)), std::log10(std::max(wave.level()[i], 0.4))});
  panel.line(curve, "stroke:#222;stroke-width:1.4");
  double y = 3.3;
  for (const Ranging ranging : {Ranging::last_pulse, Ranging::trailing_edge}) {
    const plant::Echoes e = plant::EchoReceiver(wave.lidar(), ranging, stage.scanner().range_min).receive(wave);
    if (e.count == 0) continue;
    const double range = e.range[static_cast<std::size_t>(e.count - 1)];
    const std::string colour = ranging == Ranging::last_pulse ? "#8757c4" : "#e07000";
    panel.line({{range, -0.4}, {range, y - 0.05}}, fmt::format("stroke:{};stroke-width:1.6;stroke-dasharray:2 2", colour));
    panel.circle(range, y, 0.07, "fill:" + colour);
    panel.text(std::max(range, path.target->range) + 0.15, y - 0.06, fmt::format("{}: {:.2f} m", name_of(ranging), range), "font-size:12px;fill:" + colour);
    y -= 0.4;
  }
  panel.axes(1.0, "range, m", "level, log10 of the noise");
  panel.title(place == Place::about ? "one return: truck within the cloud (as Figure 7)" : "one return: cloud before the truck (as Figure 6)");
  return panel;
}

}  // namespace

void write_echo_picture(const std::string& path, const Stage& stage, const StageOptions& options, double extinction) {
  const double right = left + width + gap;
  const SvgPanel a = scanline_panel(stage, Ranging::last_pulse, 0.0, left, first_top);
  const double second_top = first_top + a.pixel_height() + 75.0, third_top = second_top + a.pixel_height() + 75.0;
  const SvgPanel b = scanline_panel(stage, Ranging::trailing_edge, 0.0, right, first_top);
  const SvgPanel c = scanline_panel(stage, Ranging::last_pulse, extinction, left, second_top);
  const SvgPanel d = scanline_panel(stage, Ranging::trailing_edge, extinction, right, second_top);
  const SvgPanel e = waveform_panel(stage, options, Place::before, extinction, left, third_top);
  const SvgPanel f = waveform_panel(stage, options, Place::about, extinction, right, third_top);
  std::string extra = fmt::format(
      "<text x=\"{0}\" y=\"28\" style=\"font:bold 16px sans-serif\">Last pulse and trailing edge on a truck's rear (simulated; seed {1})</text>\n",
      left, options.seed);
  double x = left;
  const auto key = [&](const char* colour, const char* words) {
    extra += fmt::format("<circle cx=\"{:.0f}\" cy=\"52\" r=\"4\" fill=\"{}\"/><text x=\"{:.0f}\" y=\"56\" style=\"font:12px sans-serif\">{}</text>\n", x + 4, colour,
                         x + 14, words);
    x += 34.0 + 6.6 * static_cast<double>(std::string(words).size());
  };
  key(target_colour, "of the truck, within 0.15 m");
  key(ground_colour, "of the ground, within 0.15 m");
  key(wrong_colour, "from elsewhere");
  key("#e07000", "scanner");
  key("#e4d0b0", "cloud");
  run::write_svg(path, right + width + 30.0, third_top + e.pixel_height() + 50.0, {&a, &b, &c, &d, &e, &f}, extra);
}

}  // namespace berm::echoes
