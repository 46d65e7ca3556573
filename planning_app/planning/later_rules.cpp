#include "planning/later_rules.hpp"

#include <algorithm>
#include <array>

namespace berm::app {

namespace {

// No later than PassSearch's own last candidates: what waits for a crossing must come before the swing stands.
constexpr double least_extend = radians(3.0), least_open = radians(2.0), least_hover = radians(2.0);
constexpr double lowers_after = 0.8;  // at most, of where the arm reaches out over the dig
constexpr double short_of_carry = radians(1.5);
constexpr double least_change = radians(0.3);
constexpr std::array<double, 5> shares{0.85, 0.7, 0.5, 0.25, 0.0};  // of what is left of the offset over its least

double side_of(const PassTask& task) { return task.truck_bearing >= task.next_bearing ? 1.0 : -1.0; }

// How far the swing still is from where the next dig is.
double before_dig(const PassTask& task, double swing_angle) { return side_of(task) * (swing_angle - task.next_bearing); }

}  // namespace

const char* name_of(PassPart part) {
  switch (part) {
    case PassPart::to_truck: return "to truck";
    case PassPart::over_bed: return "over bed";
    case PassPart::to_dig: return "to dig";
    case PassPart::over_dig: return "over dig";
  }
  return "?";
}

PassPart part_of(const Script& script, const PassTask& task, const PassThresholds& thresholds, double swing_angle) {
  if (script.of(swing).reached(RuleMark::returns)) return before_dig(task, swing_angle) < thresholds.hover_offset ? PassPart::over_dig : PassPart::to_dig;
  return script.of(stick).reached(RuleMark::extends) ? PassPart::over_bed : PassPart::to_truck;
}

void later_rules(const Script& running, const PassTask& task, const PassThresholds& now, const Joints& angle, PassPart blocked, double carry_boom, std::vector<LaterRules>& out) {
  out.clear();
  const bool returns = running.of(swing).reached(RuleMark::returns);
  // offset: in the candidate's thresholds, of a rule that has not fired; keep: what must not come before it.
  const auto shortened = [&](const char* what, double PassThresholds::*offset, double least, auto keep) {
    for (const double share : shares) {
      LaterRules later{what, offset, now};
      later.thresholds.*offset = least + share * (now.*offset - least);
      if (now.*offset - later.thresholds.*offset < least_change) continue;
      keep(later.thresholds);
      out.push_back(later);
    }
  };
  const auto alone = [](PassThresholds&) {};
  if (blocked == PassPart::to_truck && !running.of(swing).reached(RuleMark::leaves)) {
    // Measured from where the boom is: below that the swing would begin at once.
    const double from = std::max(now.swing_start_boom, angle[boom]), highest = carry_boom - short_of_carry;
    for (const double share : shares) {
      LaterRules later{"swing start", &PassThresholds::swing_start_boom, now};
      later.thresholds.swing_start_boom = highest + share * (from - highest);
      if (later.thresholds.swing_start_boom - now.swing_start_boom >= least_change && highest > from) out.push_back(later);
    }
  }
  if (blocked == PassPart::over_bed && !returns) {
    if (!running.of(stick).reached(RuleMark::extends))
      shortened("reach out over bed", &PassThresholds::extend_offset, least_extend, [](PassThresholds& t) { t.open_offset = std::min(t.open_offset, t.extend_offset); });
    if (!running.of(bucket).reached(RuleMark::opens)) shortened("open over bed", &PassThresholds::open_offset, least_open, alone);
  }
  if (blocked == PassPart::over_dig) {
    const double left = returns ? before_dig(task, angle[swing]) : 1e9;
    if (left > now.lower_offset) shortened("lower over dig", &PassThresholds::lower_offset, lowers_after * least_hover, alone);
    if (left > now.hover_offset)
      shortened("reach out over dig", &PassThresholds::hover_offset, least_hover, [](PassThresholds& t) { t.lower_offset = std::min(t.lower_offset, lowers_after * t.hover_offset); });
  }
}

}  // namespace berm::app
