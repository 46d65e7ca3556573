#include "run/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "config/whole_file.hpp"

namespace berm::run {

std::string svg_escaped(const std::string& words) {
  std::string escaped;
  for (const char c : words) {
    if (c == '<') escaped += "&lt;";
    else if (c == '>') escaped += "&gt;";
    else if (c == '&') escaped += "&amp;";
    else escaped += c;
  }
  return escaped;
}

SvgPanel::SvgPanel(double x0, double y0, double x1, double y1, double left, double top, double scale)
    : x0_(x0), y0_(y0), x1_(x1), y1_(y1), left_(left), top_(top), scale_(scale) {}

void SvgPanel::rectangle(double x, double y, double width, double height, const std::string& style) {
  if (x >= x1_ || x + width <= x0_ || y >= y1_ || y + height <= y0_) return;
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"{}\"/>\n", px(x), py(y + height), width * scale_,
                       height * scale_, style);
}

namespace {

template <typename Px, typename Py>
std::string coordinates(const std::vector<Point2>& points, Px px, Py py) {
  std::string list;
  for (const auto& [x, y] : points) list += fmt::format("{:.1f},{:.1f} ", px(x), py(y));
  return list;
}

}  // namespace

void SvgPanel::polygon(const std::vector<Point2>& points, const std::string& style) {
  body_ += fmt::format("<polygon points=\"{}\" style=\"{}\"/>\n",
                       coordinates(points, [this](double x) { return px(x); }, [this](double y) { return py(y); }), style);
}

void SvgPanel::line(const std::vector<Point2>& points, const std::string& style) {
  body_ += fmt::format("<polyline points=\"{}\" style=\"fill:none;{}\"/>\n",
                       coordinates(points, [this](double x) { return px(x); }, [this](double y) { return py(y); }), style);
}

void SvgPanel::circle(double x, double y, double radius_m, const std::string& style) {
  body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" style=\"{}\"/>\n", px(x), py(y), radius_m * scale_, style);
}

void SvgPanel::text(double x, double y, const std::string& words, const std::string& style) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font-family:sans-serif;{}\">{}</text>\n", px(x), py(y), style, svg_escaped(words));
}

void SvgPanel::axes(double step_m, const std::string& x_name, const std::string& y_name) {
  frame_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" style=\"fill:none;stroke:#444\"/>\n", left_, top_, pixel_width(), pixel_height());
  // Adding 0 makes 0 of -0, which would be labelled so.
  for (double x = std::ceil(x0_ / step_m) * step_m + 0.0; x <= x1_ + 1e-9; x += step_m)
    frame_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:11px sans-serif;text-anchor:middle\">{:g}</text>\n", px(x), py(y0_) + 14, x);
  for (double y = std::ceil(y0_ / step_m) * step_m + 0.0; y <= y1_ + 1e-9; y += step_m)
    frame_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:11px sans-serif;text-anchor:end\">{:g}</text>\n", px(x0_) - 5, py(y) + 4, y);
  frame_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:12px sans-serif;text-anchor:middle\">{}</text>\n", px((x0_ + x1_) / 2), py(y0_) + 30, svg_escaped(x_name));
  frame_ += fmt::format("<text x=\"{0:.1f}\" y=\"{1:.1f}\" transform=\"rotate(-90 {0:.1f} {1:.1f})\" style=\"font:12px sans-serif;text-anchor:middle\">{2}</text>\n",
                       px(x0_) - 28, py((y0_ + y1_) / 2), svg_escaped(y_name));
}

void SvgPanel::title(const std::string& words) {
  frame_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:bold 14px sans-serif\">{}</text>\n", left_, top_ - 8, svg_escaped(words));
}

std::string SvgPanel::body() const {
  const std::string id = fmt::format("clip{:.0f}x{:.0f}", left_, top_);
  return fmt::format("<clipPath id=\"{0}\"><rect x=\"{1:.1f}\" y=\"{2:.1f}\" width=\"{3:.1f}\" height=\"{4:.1f}\"/></clipPath>\n<g clip-path=\"url(#{0})\">\n{5}</g>\n{6}",
                     id, left_, top_, pixel_width(), pixel_height(), body_, frame_);
}

void write_svg(const std::string& path, double width, double height, const std::vector<const SvgPanel*>& panels, const std::string& extra) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height);
  for (const auto* panel : panels) text += panel->body();
  text += extra;
  text += "</svg>\n";
  config::write_whole_file(path, text);
}

std::string height_colour(double height_m, double low_m, double high_m) {
  struct Stop { double at, r, g, b; };
  static constexpr std::array<Stop, 5> stops{{{0.0, 38, 70, 83}, {0.3, 88, 129, 87}, {0.55, 222, 184, 135}, {0.8, 200, 110, 60}, {1.0, 255, 245, 235}}};
  constexpr double kSteps = 40;  // as the colour bar: neighbours of nearly the same height become one rectangle
  const double t = std::round(kSteps * std::clamp((height_m - low_m) / std::max(high_m - low_m, 1e-6), 0.0, 1.0)) / kSteps;
  std::size_t i = 1;
  while (i + 1 < stops.size() && t > stops[i].at) ++i;
  const auto& a = stops[i - 1];
  const auto& b = stops[i];
  const double f = (t - a.at) / (b.at - a.at);
  const auto mix = [f](double p, double q) { return static_cast<int>(std::lround(p + f * (q - p))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b));
}

}  // namespace berm::run
