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
std::array<Corner, 4> corners(double x, double y, double yaw, double length, double width, double top) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  std::array<Corner, 4> out{};
  const std::array<std::array<double, 2>, 4> at{{{0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}, {0.5, -0.5}}};
  std::transform(at.begin(), at.end(), out.begin(), [&](const auto& k) {
    return Corner{x + k[0] * length * c - k[1] * width * s, y + k[0] * length * s + k[1] * width * c, top};
  });
  return out;
}

std::array<Corner, 4> corners_of(const json& bed) {
  return corners(bed.value("x_m", 0.0), bed.value("y_m", 0.0), bed.value("yaw_deg", 0.0) * std::numbers::pi / 180, bed.value("length_m", 0.0), bed.value("width_m", 0.0),
                 bed.value("wall_top_m", 0.0));
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
