#include "planning/dig_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "motion/dig_path.hpp"
#include "motion/reach_preview.hpp"
#include "planning/skyline.hpp"

namespace berm::app {

namespace {

constexpr double lowest_tried = 0.4, highest_tried = 1.6, step_tried = 0.1;  // m over the zone's floor
constexpr double drag_speed = 0.5;      // m/s of the tip, inward: slower, and a dig takes longer than what it brings is worth
constexpr double trembling = 0.03;      // m, of a path that is followed
constexpr double nothing = -std::numeric_limits<double>::infinity();

// How far below the tip the reach box of a drag comes; nothing where the arm does not get to.
std::optional<double> room_under(const MachineModel& machine, const DigWaypoint& tip) {
  constexpr double further = 0.05;
  const auto here = pose_at(machine, tip), next = pose_at(machine, {tip.r - further, tip.z, tip.attitude});
  if (!here) return std::nullopt;
  Joints velocity{};
  if (next)
    for (const std::size_t j : {boom, stick, bucket}) velocity[j] = ((*next)[j] - (*here)[j]) / further * drag_speed;
  return tip.z - LowerEdge(machine, preview(machine, *here, velocity)).lowest();
}

}  // namespace

DigFloor::DigFloor(const MachineModel& machine, const SiteModel& site) : lowest_(site.dig_floor), least_(radii * attitudes, nothing) {
  double zone_floor = nothing;
  for (const DigZone& z : site.dig_zones) zone_floor = std::max(zone_floor, z.floor);
  if (std::isinf(zone_floor)) return;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < radii; ++i)
    for (int k = 0; k < attitudes; ++k) {
      double& lowest = least_[static_cast<std::size_t>(i * attitudes + k)];
      // The lower, the less a bucket can curl there.
      for (double over = lowest_tried; over < highest_tried && lowest == nothing; over += step_tried) {
        const double z = zone_floor + over;
        const auto room = room_under(machine, {r_first + i * r_step, z, radians(attitude_first + k * attitude_step)});
        const double needed = room ? zone_floor + Skyline::over_floor + *room + trembling : z;
        if (room && needed <= z) lowest = std::max(needed, z - step_tried);
      }
      if (lowest != nothing) least = std::min(least, lowest);
    }
  if (std::isfinite(least)) lowest_ = std::max(lowest_, least);
}

// The highest of the four poses about it.
double DigFloor::at(double r, double attitude) const {
  const double i = std::clamp((r - r_first) / r_step, 0.0, radii - 1.0), k = std::clamp((degrees(attitude) - attitude_first) / attitude_step, 0.0, attitudes - 1.0);
  double z = lowest_;
  for (const double row : {std::floor(i), std::ceil(i)})
    for (const double column : {std::floor(k), std::ceil(k)}) z = std::max(z, least_[static_cast<std::size_t>(row * attitudes + column)]);
  return z;
}

}  // namespace berm::app
