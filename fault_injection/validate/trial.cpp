#include "validate/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "in_process/draw.hpp"
#include "plant/machine/kinematics.hpp"
#include "plant/oracle/oracle.hpp"

namespace berm::validate {

namespace {

using in_process::Draw;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double least_height = 1.0, least_start_distance = 1.0;  // m
constexpr double own_rim = 1.0;  // m: a cell's diagonal, the margin and the prisms' allowance

// Where the kernel would let the implements work if there were no obstacle: high enough, stick and bucket clear of the machine's own cells.
bool workable(const plant::ImplementShape& shape, const SwingLimits& limits, const std::array<double, 4>& joints) {
  const plant::ImplementPose pose = plant::implement_pose(shape, {joints, {}});
  for (const auto& part : shape.parts) {
    for (const auto& point : part.outline) {
      const plant::SwingPlanePoint at = plant::place(plant::link_of(pose, part.link), point);
      if (at.z < least_height || (part.link > 1 && at.r < limits.own_body_radius + own_rim)) return false;
    }
  }
  return true;
}

std::array<double, 4> between(const std::array<double, 4>& a, const std::array<double, 4>& b, double share) {
  std::array<double, 4> m{};
  for (std::size_t j = 0; j < m.size(); ++j) m[j] = a[j] + share * (b[j] - a[j]);
  return m;
}

void draw_poses(Draw& draw, const plant::ImplementShape& shape, const SwingLimits& limits, Trial& trial) {
  const auto pose = [&](double swing) {
    return std::array<double, 4>{swing, draw.between(15, 60) * degree, draw.between(-135, -55) * degree, draw.between(-115, 0) * degree};
  };
  const double swing = draw.between(-60, 60) * degree, turn = draw.between(30, 140) * degree * (draw.chance(0.5) ? 1.0 : -1.0);
  const double target = std::clamp(swing + turn, -120 * degree, 120 * degree);
  const bool arm_moves = draw.chance(0.5);
  for (bool fits = false; !fits;) {
    trial.from = pose(swing);
    trial.to = arm_moves ? pose(target) : trial.from;
    trial.to[0] = target;
    fits = true;
    for (int k = 0; k <= 8; ++k) {
      std::array<double, 4> arm = between(trial.from, trial.to, k / 8.0);
      fits = fits && workable(shape, limits, arm);
      for (const std::size_t j : {1U, 2U, 3U}) {  // the joints need not arrive together
        std::array<double, 4> uneven = arm;
        uneven[j] = trial.to[j];
        fits = fits && workable(shape, limits, uneven);
      }
    }
  }
}

double distance_at(const plant::ImplementShape& shape, const std::array<double, 4>& joints, const plant::BoxConfig& box) {
  plant::oracle::Site site;
  site.blocks.push_back({box.name, box.x, box.y, box.z_low, box.yaw, {-0.5 * box.length, -0.5 * box.width, 0.0}, {0.5 * box.length, 0.5 * box.width, box.z_high - box.z_low}});
  return plant::oracle::Oracle(shape).judge(joints, site).closest;
}

// From the swing axis to the nearest point of the box, level.
double from_axis(const plant::BoxConfig& box) {
  const double c = std::cos(box.yaw), s = std::sin(box.yaw);
  const double along = std::fabs(c * box.x + s * box.y) - 0.5 * box.length, across = std::fabs(c * box.y - s * box.x) - 0.5 * box.width;
  return std::hypot(std::max(along, 0.0), std::max(across, 0.0));
}

}  // namespace

Trial draw_trial(std::uint64_t seed, int run, const plant::ImplementShape& shape, const SwingLimits& limits) {
  Draw draw(seed, run);
  Trial trial;
  trial.seed = seed;
  trial.run = run;
  draw_poses(draw, shape, limits, trial);
  trial.swing_speed = (draw.chance(0.5) ? 1.0 : draw.between(0.15, 1.0)) * limits.velocity_max;
  trial.payload_kg = draw.chance(0.5) ? limits.loaded_kg : 0.0;
  const double kind = draw.unit();
  trial.place = kind < 0.4 ? Place::in_swing : kind < 0.7 ? Place::beyond_target : Place::anywhere;
  const double side = trial.to[0] > trial.from[0] ? 1.0 : -1.0;
  plant::BoxConfig& box = trial.obstacle;
  box.name = "obstacle";
  do {
    box.length = draw.between(0.3, 3.0);
    box.width = draw.between(0.3, 3.0);
    box.yaw = draw.between(0.0, 180.0) * degree;
    box.z_low = -0.1;
    box.z_high = draw.between(0.3, 3.0);
    const double radius = draw.between(4.2, 11.0);
    double bearing = draw.between(-180, 180) * degree;
    if (trial.place == Place::in_swing) bearing = trial.from[0] + draw.unit() * (trial.to[0] - trial.from[0]);
    if (trial.place == Place::beyond_target) bearing = trial.to[0] + side * draw.between(4, 40) * degree;
    box.x = radius * std::cos(bearing);
    box.y = radius * std::sin(bearing);
  } while (from_axis(box) < limits.fence || distance_at(shape, trial.from, box) < least_start_distance);
  return trial;
}

const char* place_name(Place place) {
  switch (place) {
    case Place::in_swing: return "in the swing";
    case Place::beyond_target: return "beyond the target";
    default: return "anywhere";
  }
}

std::string describe(const Trial& t) {
  const plant::BoxConfig& b = t.obstacle;
  const auto pose = [](const std::array<double, 4>& q) { return fmt::format("({:.1f}, {:.1f}, {:.1f}, {:.1f}) deg", q[0] / degree, q[1] / degree, q[2] / degree, q[3] / degree); };
  return fmt::format("swing, boom, stick, bucket from {} to {} at {:.1f} deg/s with {:.0f} kg; obstacle {} {:.2f} x {:.2f} m, {:.2f} m high at ({:.2f}, {:.2f}) yaw {:.0f} deg", pose(t.from),
                     pose(t.to), t.swing_speed / degree, t.payload_kg, place_name(t.place), b.length, b.width, b.z_high, b.x, b.y, b.yaw / degree);
}

plant::WorldConfig world_of(const Trial& trial) {
  plant::WorldConfig world;
  world.terrain.crest_x = world.terrain.crest_y = 100.0;  // level throughout
  world.terrain.toe_x = world.terrain.toe_y = 101.0;
  world.terrain.roughness = 0.02;
  world.dig_zones.clear();
  world.boxes.push_back(trial.obstacle);
  world.scanner.range_stddev = 0.03;
  world.scanner.outlier_probability = 0.001;
  world.scanner.dropout_probability = 0.002;
  world.scanner.dust_probability = 0.0005;
  return world;
}

}  // namespace berm::validate
