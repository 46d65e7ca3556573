#include "run/recognised_truck.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace berm::run {

namespace {

using nlohmann::json;

struct Corner { double x, y, z; };

// In order round the bed, the front left first.
std::array<Corner, 4> corners_of(const json& bed) {
  const double yaw = bed.value("yaw_deg", 0.0) * std::numbers::pi / 180, c = std::cos(yaw), s = std::sin(yaw);
  const double half_length = bed.value("length_m", 0.0) / 2, half_width = bed.value("width_m", 0.0) / 2;
  const auto corner = [&](double u, double v) { return Corner{bed.value("x_m", 0.0) + u * c - v * s, bed.value("y_m", 0.0) + u * s + v * c, bed.value("wall_top_m", 0.0)}; };
  return {corner(half_length, half_width), corner(-half_length, half_width), corner(-half_length, -half_width), corner(half_length, -half_width)};
}

bool is_recognised(const json& event) { return event.value("event", "") == "recognised"; }

}  // namespace

std::vector<Point2> recognised_bed(const std::vector<json>& app_events) {
  const auto last = std::find_if(app_events.rbegin(), app_events.rend(), is_recognised);
  std::vector<Point2> outline;
  if (last == app_events.rend()) return outline;
  for (const Corner& k : corners_of(*last)) outline.push_back({k.x, k.y});
  return outline;
}

std::vector<double> recognition_errors(const std::vector<json>& app_events, const json& truth) {
  std::vector<double> errors;
  std::set<int> told;
  const auto beds = truth.find("truck_bed");
  if (beds == truth.end() || !beds->is_array()) return errors;
  for (const json& event : app_events) {
    const int truck = event.value("truck", 0);
    if (!is_recognised(event) || truck < 1 || truck > static_cast<int>(beds->size()) || !told.insert(truck).second) continue;
    const auto said = corners_of(event), is = corners_of((*beds)[static_cast<std::size_t>(truck - 1)]);
    double worst = 0.0;
    for (std::size_t k = 0; k < said.size(); ++k) worst = std::max(worst, std::hypot(said[k].x - is[k].x, said[k].y - is[k].y, said[k].z - is[k].z));
    errors.push_back(worst);
  }
  return errors;
}

}  // namespace berm::run
