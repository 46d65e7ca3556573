#include "identify/step_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "run/svg.hpp"

namespace berm::identify {

namespace {

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kWidth = 520.0, kHeight = 210.0, kLeft = 56.0, kTop = 78.0, kGapX = 60.0, kGapY = 58.0;
constexpr std::array<const char*, 2> kColour{"#1b6ca8", "#b3271e"};  // empty, loaded

std::string words(double x, double y, const std::string& font, const std::string& anchor, const std::string& what, const char* colour = "#000") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" style=\"font:{} sans-serif;text-anchor:{}\">{}</text>\n", x, y, colour, font, anchor, run::svg_escaped(what));
}

struct Panel {
  double left, top, seconds, speed;  // largest, s and rad/s

  double x(double s) const { return left + kWidth * s / seconds; }
  double y(double v) const { return top + kHeight * (1.0 - v / speed); }
  std::string frame(const std::string& title) const {
    std::string text = fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n", left, top, kWidth, kHeight);
    text += words(left, top - 7, "bold 14px", "start", title);
    for (int i = 0; i <= 4; ++i) {
      text += words(x(seconds * i / 4), top + kHeight + 14, "11px", "middle", fmt::format("{:.1f}", seconds * i / 4));
      text += words(left - 5, y(speed * i / 4) + 4, "11px", "end", fmt::format("{:.0f}", speed * i / 4 * kDegree));
    }
    return text + words(left + kWidth / 2, top + kHeight + 28, "12px", "middle", "s") + words(left + 4, top + 14, "12px", "start", "deg/s");
  }
  std::string curve(const StepRecord& record, const std::vector<double>& speeds, const std::string& style) const {
    std::string points;
    const double begin = record.samples.front().time_s;
    for (std::size_t i = 0; i < speeds.size(); i += 4) points += fmt::format("{:.1f},{:.1f} ", x(record.samples[i].time_s - begin), y(std::max(0.0, speeds[i])));
    return fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", points, style);
  }
};

std::string panel_text(double left, double top, const StepFit& fit, double speed_max, const std::vector<const StepRecord*>& shown, const std::string& title) {
  Panel panel{left, top, 0.1, 0.1};
  for (const StepRecord* record : shown) {
    panel.seconds = std::max(panel.seconds, record->samples.back().time_s - record->samples.front().time_s);
    for (const StepSample& s : record->samples) panel.speed = std::max(panel.speed, 1.05 * s.speed);
  }
  std::string text = panel.frame(title);
  for (const StepRecord* record : shown) {
    std::vector<double> measured;
    for (const StepSample& s : record->samples) measured.push_back(s.speed);
    text += panel.curve(*record, measured, fmt::format("stroke=\"{}\" stroke-opacity=\"0.35\" stroke-width=\"4\"", kColour[record->plan.loaded]));
    text += panel.curve(*record, fitted_speeds(fit, *record, speed_max), "stroke=\"#000\" stroke-width=\"1\"");
  }
  return text;
}

}  // namespace

void write_step_picture(const std::string& path, const StepResult& r, const config::MachineFile& machine, const std::vector<StepRun>& runs) {
  std::string body = words(kLeft, 26, "bold 16px", "start", fmt::format("Step responses of {} (simulation): broad measured, thin the fitted model", r.machine_name));
  body += words(kLeft, 46, "13px", "start", "empty (swing: at the least reach)", kColour[0]) + words(kLeft + 260, 46, "13px", "start", "heaviest payload (swing: at the farthest)", kColour[1]);
  for (std::size_t j = 0; j < r.fit.size(); ++j) {
    for (std::size_t d = 0; d < 2; ++d) {
      std::vector<const StepRecord*> shown;
      std::array<std::vector<double>, 2> have;  // each size once
      for (const StepRun& run : runs) {
        for (const StepRecord& record : run.records) {
          const StepPlan& plan = record.plan;
          auto& sizes = have[plan.loaded];
          if (plan.joint != j || (plan.direction > 0.0) != (d == 0) || (j == swing && plan.reach != (plan.loaded ? r.reach_m.size() - 1 : 0))) continue;
          if (std::find(sizes.begin(), sizes.end(), plan.speed) != sizes.end()) continue;
          sizes.push_back(plan.speed);
          shown.push_back(&record);
        }
      }
      body += panel_text(kLeft + static_cast<double>(d) * (kWidth + kGapX), kTop + static_cast<double>(j) * (kHeight + kGapY), r.fit[j][d], machine.joint[j].velocity_max,
                         shown, fmt::format("{}, {}", config::kJointNames[j], j == swing ? (d == 0 ? "left" : "right") : config::kDirectionNames[d]));
    }
  }
  run::write_svg(path, kLeft + 2.0 * (kWidth + kGapX), kTop + 4.0 * (kHeight + kGapY), {}, body);
}

}  // namespace berm::identify
