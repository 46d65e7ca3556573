#include "validate/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/shell_word.hpp"
#include "run/contract_text.hpp"
#include "run/svg.hpp"

namespace berm::validate {

namespace {

using nlohmann::ordered_json;

struct Totals {
  int misses = 0, needless = 0, hidden = 0, governed = 0, stopped = 0, arrived = 0, nominal_hits = 0, held_off = 0;
  double closest_m = 1e9, time_lost_p95 = 0.0;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::ceil(share * last))];
}

bool nominal_hit(const TrialResult& r) { return r.nominal.contact; }

Totals totals_of(const std::vector<TrialResult>& results) {
  Totals t;
  std::vector<double> lost;
  for (const TrialResult& r : results) {
    t.misses += r.outcome == Outcome::miss;
    t.needless += r.outcome == Outcome::needless_stop;
    t.hidden += r.past_hidden;
    const bool governed = r.kernel.governed && !r.kernel.stopped && r.kernel.arrived;
    t.governed += governed;
    t.stopped += r.kernel.stopped;
    t.arrived += r.kernel.arrived;
    t.nominal_hits += nominal_hit(r);
    t.held_off += nominal_hit(r) && !r.kernel.contact;
    t.closest_m = std::min(t.closest_m, r.kernel.closest_m);
    if (governed) lost.push_back(r.time_lost_s);
  }
  t.time_lost_p95 = quantile(lost, 0.95);
  return t;
}

std::string command(const Sweep& sweep, const Trial& trial) {
  return fmt::format("./berm validate --machine {} --seed {} --only {}", config::shell_word(sweep.machine), trial.seed, trial.run);
}

std::vector<TrialResult> of_place(const Sweep& sweep, Place place) {
  std::vector<TrialResult> some;
  for (const auto& r : sweep.results)
    if (r.trial.place == place) some.push_back(r);
  return some;
}

}  // namespace

ordered_json flat_json(const Sweep& sweep) {
  const Totals t = totals_of(sweep.results);
  ordered_json failures = ordered_json::array();
  for (const auto& r : sweep.results)
    if (r.outcome != Outcome::right)
      failures.push_back({{"run", r.trial.run}, {"kind", r.outcome == Outcome::miss ? "miss" : "needless stop"}, {"why", r.why}, {"scenario", describe(r.trial)}, {"command", command(sweep, r.trial)}});
  return {{"machine", sweep.machine}, {"seed", sweep.seed}, {"asked", sweep.asked}, {"runs", sweep.results.size()}, {"misses", t.misses}, {"needless_stops", t.needless}, {"needless_past_hidden_space", t.hidden}, {"governed_runs", t.governed},
          {"time_lost_s_p95", t.time_lost_p95}, {"closest_approach_m", t.closest_m}, {"stopped_runs", t.stopped}, {"nominal_contacts", t.nominal_hits},
          {"wall_seconds", sweep.wall_seconds}, {"failures", failures}};
}

std::string summary_text(const Sweep& sweep) {
  const Totals t = totals_of(sweep.results);
  const auto n = static_cast<double>(std::max<std::size_t>(sweep.results.size(), 1));
  std::string text = fmt::format("\nValidation sweep ({}, seed {}; a simulation, judged by the oracle)\n", sweep.machine, sweep.seed);
  const auto row = [&text](const std::string& name, const std::string& value) { text += fmt::format("  {:<30}{}\n", name, value); };
  const bool whole = sweep.results.size() == static_cast<std::size_t>(sweep.asked);
  row("runs", whole ? fmt::format("{}", sweep.asked) : fmt::format("{} of {}: interrupted", sweep.results.size(), sweep.asked));
  row("misses (contact)", fmt::format("{}", t.misses));
  row("needless stops", fmt::format("{} ({:.2f} %)", t.needless, 100.0 * t.needless / n));
  row("  past hidden space", fmt::format("{}: the obstacle hid it until shortly before; the others {:.2f} %", t.hidden, 100.0 * (t.needless - t.hidden) / n));
  row("nominal motion touches", fmt::format("{}, of which the kernel let {} happen", t.nominal_hits, t.nominal_hits - t.held_off));
  row("stopped by the kernel", fmt::format("{}", t.stopped));
  row("slowed, not stopped", fmt::format("{}; time lost, 95th percentile {:.2f} s", t.governed, t.time_lost_p95));
  row("closest approach", fmt::format("{:.2f} m", t.closest_m));
  for (const Place place : {Place::in_swing, Place::beyond_target, Place::anywhere}) {
    const auto some = of_place(sweep, place);
    const Totals p = totals_of(some);
    row(fmt::format("  obstacle {}", place_name(place)), fmt::format("{} runs, {} arrived, {} stopped, {} slowed (95th percentile {:.2f} s), {} needless, {} misses", some.size(), p.arrived, p.stopped,
                                                                     p.governed, p.time_lost_p95, p.needless, p.misses));
  }
  row("time", fmt::format("{:.0f} s", sweep.wall_seconds));
  int listed = 0;
  for (const auto& r : sweep.results) {
    if (r.outcome == Outcome::right) continue;
    text += fmt::format("{} run {}: {}\n    {}\n    {}\n", r.outcome == Outcome::miss ? "MISS" : "needless stop", r.trial.run, r.why, describe(r.trial), command(sweep, r.trial));
    if (++listed == 20) {
      text += "  ... the rest is in --json FILE\n";
      break;
    }
  }
  return text;
}

void write_picture(const std::string& path, const Sweep& sweep) {
  run::SvgPanel panel(-13, -13, 13, 13, 50, 40, 24);
  panel.circle(0, 0, 3.0, "fill:#ddd;stroke:#888");
  const auto draw = [&](const TrialResult& r, const char* style) {
    const auto& b = r.trial.obstacle;
    std::vector<run::Point2> corners;
    for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      corners.emplace_back(b.x + u * b.length * std::cos(b.yaw) - v * b.width * std::sin(b.yaw), b.y + u * b.length * std::sin(b.yaw) + v * b.width * std::cos(b.yaw));
    panel.polygon(corners, style);
  };
  for (const auto& r : sweep.results)
    if (r.outcome == Outcome::right && !r.kernel.stopped) draw(r, r.kernel.governed ? "fill:#e0a80030;stroke:#b08000;stroke-width:0.5" : "fill:#4a904a20;stroke:#4a904a;stroke-width:0.5");
  for (const auto& r : sweep.results)
    if (r.outcome == Outcome::right && r.kernel.stopped) draw(r, "fill:#3060c030;stroke:#3060c0;stroke-width:0.5");
  for (const auto& r : sweep.results)
    if (r.outcome != Outcome::right) draw(r, r.outcome == Outcome::miss ? "fill:#d00000;stroke:#600000" : "fill:#c000c080;stroke:#c000c0");
  panel.axes(2.0, "x, m", "y, m");
  panel.title(fmt::format("{} of {} obstacles by outcome, seed {} (simulation)", sweep.results.size(), sweep.asked, sweep.seed));
  const char* legend[][2] = {{"#4a904a", "passed"}, {"#b08000", "passed, slowed"}, {"#3060c0", "stopped, rightly"}, {"#c000c0", "needless stop"}, {"#d00000", "miss"}};
  std::string extra;
  double y = 60;
  for (const auto& [colour, words] : legend) {
    extra += fmt::format("<rect x=\"700\" y=\"{}\" width=\"14\" height=\"14\" fill=\"{}\"/><text x=\"720\" y=\"{}\" font-size=\"13\">{}</text>", y, colour, y + 12, words);
    y += 22;
  }
  run::write_svg(path, 850, 730, {&panel}, extra);
}

}  // namespace berm::validate
