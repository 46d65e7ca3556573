#include "planning/face_reserve.hpp"

#include <algorithm>
#include <cmath>

#include "planning/cut_model.hpp"
#include "planning/goal_shape.hpp"
#include "planning/skyline.hpp"

namespace berm::app {

namespace {
constexpr double sector_step = 0.05;          // rad
constexpr double radius_step = 0.1;           // m
constexpr double widened = 0.31;              // rad beyond the site's bearings: where digs are chosen when these yield too little
constexpr double nearer = 0.4;                // m, of a drag's end, likewise
constexpr double fallen = 0.6;                // m under the ground that the machine stands on: beyond the crest
constexpr double crest_beyond_end = 0.9;      // m
}  // namespace

FaceReserve face_reserve(const SiteModel& site, const DigGround& ground, double lowest, double width) {
  FaceReserve face;
  int bearings = 0;
  for (double b = site.dig_swing_right - widened; b <= site.dig_swing_left + widened; b += sector_step) {
    const SurfaceProfile surface(ground, b, width);
    const double c = std::cos(b), s = std::sin(b);
    for (double r = site.dig_radius_end - nearer; r <= site.dig_radius_start; r += radius_step)
      if (in_dig_zone(site, r * c, r * s)) face.volume += std::max(0.0, surface.at(r) - std::max(lowest, goal_part_height(site, r * c, r * s))) * r * sector_step * radius_step;
    if (b < site.dig_swing_right || b > site.dig_swing_left) continue;
    double crest = SurfaceProfile::first;
    while (crest < SurfaceProfile::last && surface.at(crest) > -fallen) crest += radius_step;
    face.crest += crest;
    ++bearings;
  }
  if (bearings > 0) face.crest /= bearings;
  return face;
}

double back_distance(const SiteModel& site, const FaceReserve& face, double step, int most) {
  const double wanted = site.dig_radius_end + crest_beyond_end - face.crest;
  return step * std::clamp(static_cast<int>(std::lround(wanted / step)), 1, most);
}

}  // namespace berm::app
