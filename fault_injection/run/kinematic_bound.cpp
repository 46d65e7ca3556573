#include "run/kinematic_bound.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace berm::run {

using nlohmann::json;

double rest_to_rest_s(double angle, const JointLimit& limit) {
  const double way = std::abs(angle);
  if (way * limit.acceleration <= limit.velocity * limit.velocity) return 2 * std::sqrt(way / limit.acceleration);
  return way / limit.velocity + limit.velocity / limit.acceleration;
}

double through_dump_s(double start, double dump, double end, const JointLimit& limit) {
  const bool between = (dump - start) * (end - dump) >= 0;
  return between ? rest_to_rest_s(end - start, limit) : rest_to_rest_s(dump - start, limit) + rest_to_rest_s(end - dump, limit);
}

double kinematic_bound_s(const Pose& start, const Pose& dump, const Pose& end, const JointLimits& limits) {
  double longest = 0.0;
  for (std::size_t j = 0; j < limits.size(); ++j) longest = std::max(longest, through_dump_s(start[j], dump[j], end[j], limits[j]));
  return longest;
}

std::vector<PassSpan> pass_spans(const std::vector<json>& app_events) {
  std::vector<PassSpan> spans;
  enum class Seen { nothing, lift, emptied } seen = Seen::nothing;
  PassSpan now{};
  int truck = 0;
  for (const json& event : app_events) {
    if (event.value("event", "") != "phase") continue;
    const std::string phase = event.value("phase", "");
    const double time_s = event.value("time_s", 0.0);
    if (phase == "lift") {
      now.lift_s = time_s;
      truck = event.value("truck", 0);
      seen = Seen::lift;
    } else if (phase == "swing to dig" && seen != Seen::nothing) {
      now.emptied_s = time_s;
      seen = Seen::emptied;
    } else if (phase == "dig") {
      now.dig_s = time_s;
      if (seen == Seen::emptied && event.value("truck", 0) == truck) spans.push_back(now);
      seen = Seen::nothing;
    }
  }
  return spans;
}

std::vector<double> kinematic_ratios(const std::vector<json>& app_events, const std::vector<TraceRow>& rows, const JointLimits& limits) {
  std::vector<double> ratios;
  if (rows.empty()) return ratios;
  for (const PassSpan& span : pass_spans(app_events)) {
    const auto pose = [&rows](double time_s) { return row_at(rows, time_s).angle; };
    const double bound = kinematic_bound_s(pose(span.lift_s), pose(span.emptied_s), pose(span.dig_s), limits);
    if (bound > 0.0) ratios.push_back((span.dig_s - span.lift_s) / bound);
  }
  return ratios;
}

}  // namespace berm::run
