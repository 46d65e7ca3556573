#include "identify/programme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace berm::identify {

namespace {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

constexpr double kAboveGround_m = 0.6;
constexpr double kFromRange = radians(5.0);     // of a joint's ends that no test of it uses
constexpr double kHeldFromRange = radians(1.0); // the same for a joint that is held
constexpr double kWithinReach_m = 0.05;         // a pose is held within its tolerance, and must stay in its row
constexpr double kBoomStep = radians(1.0), kStickStep = radians(2.5), kBucketStep = radians(4.5);
constexpr double kLeastSpan = radians(15.0);
constexpr std::array<double, 3> kBucketWeight{1.0, 0.75, 0.5};  // of the bucket's and load's distance squared, the rest for the stick's

JointSpan inner(const config::MachineFile& m, std::size_t joint, double from_range) { return {m.joint[joint].low + from_range, m.joint[joint].high - from_range}; }

// From end to end in steps of about this size.
std::vector<double> steps(const JointSpan& span, double size) {
  const auto count = std::max(1L, std::lround((span.high - span.low) / size));
  std::vector<double> out;
  for (long i = 0; i <= count; ++i) out.push_back(span.low + (span.high - span.low) * static_cast<double>(i) / static_cast<double>(count));
  return out;
}

struct Candidate { Joints pose; double reach, bucket, stick; };

std::vector<Candidate> free_poses(const config::MachineFile& m) {
  std::vector<Candidate> out;
  for (const double boom_angle : steps(inner(m, boom, kHeldFromRange), kBoomStep)) {
    for (const double stick_angle : steps(inner(m, stick, kHeldFromRange), kStickStep)) {
      for (const double bucket_angle : steps(inner(m, bucket, kHeldFromRange), kBucketStep)) {
        const Joints pose{0.0, boom_angle, stick_angle, bucket_angle};
        if (lowest_m(m, pose) >= kAboveGround_m) out.push_back({pose, reach_m(m, pose), middle_m(m, pose, 3), middle_m(m, pose, 2)});
      }
    }
  }
  return out;
}

void add_swing(const config::MachineFile& m, std::vector<Station>& out) {
  const auto poses = free_poses(m);
  const JointSpan span = inner(m, swing, kFromRange);
  double last_reach = 0.0;
  bool any = false;
  for (std::size_t row = 0; row < m.braking.reach.size(); ++row) {
    std::vector<const Candidate*> chosen;
    for (const double weight : kBucketWeight) {
      const Candidate* best = nullptr;
      const auto merit = [weight](const Candidate& c) { return weight * c.bucket * c.bucket + (1.0 - weight) * c.stick * c.stick; };
      for (const Candidate& c : poses) {
        if (c.reach > m.braking.reach[row] - kWithinReach_m || c.reach <= last_reach) continue;
        if (best == nullptr || merit(c) > merit(*best)) best = &c;
      }
      if (best != nullptr && std::find(chosen.begin(), chosen.end(), best) == chosen.end()) chosen.push_back(best);
    }
    for (const Candidate* c : chosen) out.push_back({swing, row, c->pose, span, c->reach});
    any = any || !chosen.empty();
    last_reach = m.braking.reach[row] - kWithinReach_m;
  }
  if (!any) throw std::runtime_error("swing: no pose above the ground lies within the reaches of the braking table");
}

// The largest part of a joint's range, from its upper end down, over which the pose stays above the ground.
std::optional<Station> station_of(const config::MachineFile& m, std::size_t joint, Joints pose) {
  const JointSpan range = inner(m, joint, kFromRange);
  Station station{joint, m.braking.reach.size() - 1, pose, {range.high, range.high}, 0.0};
  for (double angle = range.high; angle >= range.low; angle -= radians(0.5)) {
    pose[joint] = angle;
    if (lowest_m(m, pose) < kAboveGround_m) break;
    station.span.low = angle;
    station.reach_m = std::max(station.reach_m, reach_m(m, pose));
  }
  station.pose[joint] = 0.5 * (station.span.low + station.span.high);
  if (station.span.high - station.span.low < kLeastSpan) return std::nullopt;
  return station;
}

void add_arm(const config::MachineFile& m, std::size_t joint, std::vector<Station>& out) {
  const JointSpan b = inner(m, boom, kHeldFromRange), s = inner(m, stick, kHeldFromRange), k = inner(m, bucket, kHeldFromRange);
  const double middle = 0.5 * (k.low + k.high);
  const std::size_t before = out.size();
  for (const Joints& pose : {Joints{0.0, b.high, s.high, middle}, Joints{0.0, b.high, s.low, k.low}, Joints{0.0, b.high, s.high, k.high}}) {
    if (joint == bucket && pose[bucket] == k.high) continue;  // the same as the first
    if (const auto station = station_of(m, joint, pose)) out.push_back(*station);
  }
  if (out.size() == before) throw std::runtime_error(fmt::format("{}: no pose leaves it room above the ground", config::kJointNames[joint]));
}

}  // namespace

std::vector<Station> stations(const config::MachineFile& machine, const std::vector<std::size_t>& joints) {
  std::vector<Station> out;
  for (const std::size_t joint : joints) {
    if (joint == swing) {
      add_swing(machine, out);
    } else {
      add_arm(machine, joint, out);
    }
  }
  return out;
}

}  // namespace berm::identify
