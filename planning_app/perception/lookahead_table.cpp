#include "perception/lookahead_table.hpp"

#include <algorithm>
#include <cmath>

#include "motion/joint_controller.hpp"
#include "motion/reach_preview.hpp"

namespace berm::app {

namespace {

constexpr double length_step = radians(5.0), most_length = radians(180.0);
constexpr int lengths = 36, speeds = 50;
constexpr double between_lengths = radians(0.5);  // what a straight line between two lengths may lie too low
constexpr double cell = 0.3;                      // m, of the kernel's map
constexpr double own_rim = 0.55;                  // m: so far off the own body's circle the kernel keeps stick and bucket
constexpr double slowest_pan = radians(1.0);      // rad/s

double side_of(std::size_t scanner) { return scanner == 0 ? 1.0 : -1.0; }

// The pan at which the scanner sees the farthest of what the implements cover once they have swung on by an angle towards its side: their edge lies ahead of
// their middle by half their width, and from a head beside the boom near ground is seen under a larger angle than from the swing axis.
double pan_over(const MachineModel& machine, std::size_t scanner, double swung, double reach_m) {
  constexpr double step_m = 0.25;
  const ScannerMount& head = machine.scanner[scanner];
  double half_width = cell;
  for (const Prism& part : machine.parts) half_width = std::max(half_width, part.half_width + cell);
  double most = 0.0;
  for (double r = std::min(machine.own_body_radius + own_rim, reach_m);; r = std::min(r + step_m, reach_m)) {
    const double at = swung + std::asin(std::min(1.0, half_width / r));
    most = std::max(most, std::atan2(r * std::sin(at) - side_of(scanner) * head.y, r * std::cos(at) - head.x));
    if (r >= reach_m) break;
  }
  return std::min(most, scanner == 0 ? head.pan_high : -head.pan_low);
}

}  // namespace

LookaheadTable::LookaheadTable(const MachineModel& machine, double empty_brake)
    : empty_brake_(empty_brake), fastest_(machine.joint[swing].velocity_max), pan_dead_time_(machine.state_latency + machine.command_latency) {
  for (std::size_t scanner = 0; scanner < rows_.size(); ++scanner)
    for (const double reach_m : machine.braking.reach) rows_[scanner].push_back(tabulated(machine, scanner, reach_m));
}

double LookaheadTable::pan_rate(const ScannerMount& mount, double direction, double swing_speed) {
  return std::min(std::max(slowest_pan, azimuth_rate - direction * swing_speed), mount.pan_rate_max);
}

LookaheadTable::Reach LookaheadTable::tabulated(const MachineModel& machine, std::size_t scanner, double reach_m) const {
  const double seen_after = machine.state_latency + 2.0 * machine.cycle;  // until what is looked at stands in the kernel's map
  Reach reach;
  reach.most_m = reach_m;
  for (int k = 0; k <= speeds; ++k) {
    const double speed = fastest_ * k / speeds;
    reach.required.push_back(pan_over(machine, scanner, stop_travel(machine, swing, reach_m, speed) + seen_after * speed, reach_m));
  }
  reach.angles = simulated(machine, scanner, reach);
  return reach;
}

// Swings of each length from a standstill, by the app's own controller and the identified response of an empty swing, which is the quickest. Only up to the
// largest speed: from then on less and less is needed of a pan that goes on.
std::vector<LookaheadTable::Angles> LookaheadTable::simulated(const MachineModel& machine, std::size_t scanner, const Reach& reach) const {
  const double side = side_of(scanner), standing = required_of(reach, 0.0);
  ControllerLimits limits = limits_of(machine, swing, reach.most_m, 0.0);
  limits.deceleration = std::max(limits.deceleration, empty_brake_);
  std::vector<Angles> angles{{standing, standing}};
  bool at_limit = false;
  for (int n = 1; n <= lengths; ++n) {
    if (at_limit) {  // longer ones are no faster
      angles.push_back(angles.back());
      continue;
    }
    const TwoWayResponse response = responses_of(machine, swing, reach.most_m, 0.0);
    JointController controller(response, machine.cycle);
    JointModel joint(response, machine.cycle);
    joint.reset(0.0, 0.0);
    Angles most{standing, standing};
    double panned = 0.0, peak = 0.0, now = 0.0;  // rad since the swing was asked for; rad/s
    for (double t = 0.0; now >= peak && t < 10.0; t += machine.cycle) {
      const double command = controller.toward(side * n * length_step, joint.angle(), joint.velocity(), limits);
      controller.sent(command);
      joint.advance(command);
      now = side * joint.velocity();
      peak = std::max(peak, now);
      if (t >= pan_dead_time_) panned += pan_rate(machine.scanner[scanner], side, joint.velocity()) * machine.cycle;
      const double needed = required_of(reach, now);
      most = {std::max(most.lookahead, needed), std::max(most.trigger, needed - panned)};
      if (now > 0.999 * limits.velocity) at_limit = true, peak = 1e9;
    }
    angles.push_back(most);
  }
  for (Angles& a : angles) a = {a.lookahead + between_lengths, a.trigger + between_lengths};
  return angles;
}

double LookaheadTable::required_of(const Reach& reach, double speed) const {
  const double at = std::clamp(std::fabs(speed) / fastest_, 0.0, 1.0) * speeds;
  const std::size_t below = std::min(static_cast<std::size_t>(at), reach.required.size() - 2);
  return std::lerp(reach.required[below], reach.required[below + 1], at - static_cast<double>(below));
}

const LookaheadTable::Reach& LookaheadTable::row(std::size_t scanner, double reach_m) const {
  const std::vector<Reach>& rows = rows_[scanner];
  const auto at = std::find_if(rows.begin(), rows.end(), [reach_m](const Reach& r) { return r.most_m >= reach_m; });
  return at == rows.end() ? rows.back() : *at;
}

double LookaheadTable::required(std::size_t scanner, double speed, double reach_m) const { return required_of(row(scanner, reach_m), speed); }

LookaheadTable::Angles LookaheadTable::of(std::size_t scanner, double length, double reach_m) const {
  const std::vector<Angles>& angles = row(scanner, reach_m).angles;
  const double at = std::clamp(length, 0.0, most_length) / length_step;
  const std::size_t below = std::min(static_cast<std::size_t>(at), angles.size() - 2);
  const double share = at - static_cast<double>(below);
  return {std::lerp(angles[below].lookahead, angles[below + 1].lookahead, share), std::lerp(angles[below].trigger, angles[below + 1].trigger, share)};
}

}  // namespace berm::app
