#include "identify/braking_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "run/svg.hpp"

namespace berm::identify {

namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kWidth = 430.0, kHeight = 320.0, kLeft = 60.0, kTop = 64.0, kGapX = 80.0, kGapY = 90.0;
constexpr std::array<const char*, 4> kColour{"#1b6ca8", "#2a9d8f", "#e08e1b", "#b3271e"};

// A step of 1, 2 or 5 times a power of ten that gives about five marks.
double mark_step(double span) {
  const double raw = span / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10.0 * power;
}

class Panel {
 public:
  Panel(double left, double top, double x_max, double y_max) : left_(left), top_(top), x_max_(x_max), y_max_(y_max) {}
  double x(double value) const { return left_ + value / x_max_ * kWidth; }
  double y(double value) const { return top_ + kHeight - value / y_max_ * kHeight; }

  void frame(const std::string& title) {
    text_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n", left_, top_, kWidth, kHeight);
    words(left_, top_ - 8, "bold 14px", "start", title);
    const double sx = mark_step(x_max_), sy = mark_step(y_max_);
    for (double v = 0; v <= x_max_ + 1e-9; v += sx) words(x(v), top_ + kHeight + 15, "11px", "middle", fmt::format("{:g}", v));
    for (double v = 0; v <= y_max_ + 1e-9; v += sy) {
      words(left_ - 6, y(v) + 4, "11px", "end", fmt::format("{:g}", v));
      text_ += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#e6e6e6\"/>\n", left_, left_ + kWidth, y(v), y(v));
    }
    words(left_ + kWidth / 2, top_ + kHeight + 32, "12px", "middle", "speed (deg/s)");
    words(left_ - 40, top_ + kHeight / 2, "12px", "middle", "stop angle (deg)",
          fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", left_ - 40, top_ + kHeight / 2));
  }
  // The kernel takes the angle on the chord between two entries.
  void chords(const std::vector<double>& speed, const std::vector<double>& angle, const std::string& style) {
    std::string points;
    for (std::size_t k = 0; k < speed.size(); ++k) points += fmt::format("{:.1f},{:.1f} ", x(speed[k]), y(angle[k]));
    text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", points, style);
  }
  // Where a pixel has one already, none is added.
  void dot(double speed, double angle, const char* colour) {
    if (!dotted_.insert({std::lround(x(speed)), std::lround(y(angle)), colour}).second) return;
    text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" fill=\"{}\" fill-opacity=\"0.7\"/>\n", x(speed), y(angle), colour);
  }
  void words(double px, double py, const std::string& font, const std::string& anchor, const std::string& what, const std::string& more = {}) {
    text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"font:{} sans-serif;text-anchor:{}\"{}>{}</text>\n", px, py, font, anchor, more, run::svg_escaped(what));
  }
  const std::string& text() const { return text_; }

 private:
  double left_, top_, x_max_, y_max_;
  std::set<std::tuple<long, long, std::string>> dotted_;
  std::string text_;
};

std::string joint_panel(const Result& r, const config::MachineFile& m, std::size_t j, double left, double top, const std::vector<BenchRecord>& runs) {
  const auto& rows = r.bounds.table[j];
  const std::size_t columns = rows.front().size();
  double y_max = 0.5;
  for (std::size_t row = 0; row < rows.size(); ++row) y_max = std::max({y_max, rows[row].back().angle * kDegree, m.braking.angle[j][row].back() * kDegree});
  const double x_max = m.joint[j].velocity_max * kDegree;
  Panel panel(left, top, 1.04 * x_max, 1.06 * y_max);
  panel.frame(config::kJointNames[j]);
  std::vector<double> speed(columns);
  for (std::size_t k = 0; k < columns; ++k) speed[k] = x_max * static_cast<double>(k) / static_cast<double>(columns - 1);
  const std::size_t first = j == swing ? 0 : rows.size() - 1;
  for (std::size_t row = first; row < rows.size(); ++row) {
    const char* colour = kColour[row % kColour.size()];
    std::vector<double> now, before;
    for (std::size_t k = 0; k < columns; ++k) {
      now.push_back(rows[row][k].angle * kDegree);
      before.push_back(m.braking.angle[j][row][k] * kDegree);
    }
    panel.chords(speed, before, fmt::format("stroke=\"{}\" stroke-opacity=\"0.45\" stroke-dasharray=\"4 3\"", colour));
    panel.chords(speed, now, fmt::format("stroke=\"{}\" stroke-width=\"1.6\"", colour));
    panel.words(left + 10, top + 18 + 16 * static_cast<double>(row - first), "12px", "start",
                j == swing ? fmt::format("to {:g} m reach", m.braking.reach[row]) : "every reach",
                fmt::format(" fill=\"{}\"", colour));
  }
  for (const BenchRecord& run : runs) {
    for (const StopRecord& s : run.stops) {
      if (s.plan.joint != j) continue;
      const double after = r.bounds.earliest_obeyed[j][static_cast<std::size_t>(s.plan.manner)];
      const StopBound b = stop_bound(m, s, after, s.plan.speed);
      panel.dot(s.held_speed * kDegree, b.measured_angle * kDegree, kColour[(j == swing ? s.plan.row : rows.size() - 1) % kColour.size()]);
    }
  }
  return panel.text();
}

}  // namespace

void write_braking_picture(const std::string& path, const Result& r, const config::MachineFile& m, const std::vector<BenchRecord>& runs) {
  const std::size_t count = r.joints.size(), across = std::min<std::size_t>(2, count), down = (count + 1) / 2;
  const double width = kLeft + static_cast<double>(across) * (kWidth + kGapX), height = kTop + static_cast<double>(down) * (kHeight + kGapY);
  std::string body = fmt::format("<text x=\"{:.0f}\" y=\"26\" style=\"font:bold 16px sans-serif\">Braking table of {} (simulation): points measured, "
                                 "lines the bounds, dashed before</text>\n",
                                 kLeft, run::svg_escaped(r.machine_name));
  for (std::size_t i = 0; i < count; ++i)
    body += joint_panel(r, m, r.joints[i], kLeft + static_cast<double>(i % across) * (kWidth + kGapX), kTop + static_cast<double>(i / 2) * (kHeight + kGapY), runs);
  run::write_svg(path, width, height, {}, body);
}

}  // namespace berm::identify
