#include "identify/driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace berm::identify {

namespace {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double degrees(double radians_) { return radians_ * 180.0 / std::numbers::pi; }

constexpr double kPoseGain = 0.8;            // rad/s for a radian
constexpr double kPoseTolerance = radians(0.4);
constexpr double kPoseShare = 0.6;           // of the largest speed, between tests
constexpr int kPosePatience = 6000;          // cycles
constexpr double kGuess = 1.4;               // times the way that was learned, with the square of the speed: where a test begins, when no room is left
constexpr double kUnknownShare = 0.35;       // of the span, kept for a stop of which nothing is known
constexpr std::array<double, 2> kProbe{1.0 / 7.0, 3.0 / 7.0};  // of the largest speed
constexpr double kSpare = radians(1.5);
constexpr double kEndOfRange = radians(0.5);
constexpr double kHold_s = 0.5;
constexpr double kRampShare = 1.2, kRamp_s = 0.5;  // getting to a speed takes about as much room as its stop, and some time
constexpr double kReached = 0.99;            // share of the command
constexpr double kLeastMotion = 0.2;         // share of the command below which a joint is said not to move
constexpr double kPatience_s = 30.0;         // for a speed, and for a standstill
constexpr int kRestReadings = 25;
constexpr double kCycle_s = 0.01;
constexpr double kStepRest_s = 0.1, kStepHold_s = 0.6;  // before a step, and beyond its ramp

double mean_speed(const std::vector<Sample>& s, std::size_t count, std::size_t before_last = 0) {
  double sum = 0.0;
  for (std::size_t i = s.size() - before_last - count; i < s.size() - before_last; ++i) sum += s[i].speed;
  return sum / static_cast<double>(count);
}

}  // namespace

Driver::Driver(MachineLink& link, const config::MachineFile& machine, std::function<void()> watch)
    : link_(link), machine_(machine), now_(link.first()), watch_(std::move(watch)) {}

void Driver::step(const Reading& reading) {
  now_ = reading;
  if (++steps_ % 100 == 0) watch_();
  for (std::size_t j = 0; j < 4; ++j) fastest_[j] = std::max(fastest_[j], std::abs(reading.velocity[j]));
}

void Driver::move_to(const Joints& goal, const std::array<bool, 4>& moved) {
  int there = 0;
  for (int cycle = 0; cycle < kPosePatience; ++cycle) {
    Joints velocity{};
    bool arrived = true;
    for (std::size_t j = 0; j < 4; ++j) {
      if (!moved[j]) continue;
      const double left = goal[j] - now_.angle[j];
      velocity[j] = std::copysign(std::min(kPoseShare * machine_.joint[j].velocity_max, kPoseGain * std::abs(left) + radians(0.3)), left);
      if (std::abs(left) <= kPoseTolerance) velocity[j] = 0.0;
      arrived = arrived && std::abs(left) <= kPoseTolerance && std::abs(now_.velocity[j]) <= machine_.joint[j].velocity_error;
    }
    there = arrived ? there + 1 : 0;
    if (there >= 20) return;
    step(link_.drive(velocity));
  }
  for (std::size_t j = 0; j < 4; ++j) {
    if (moved[j] && std::abs(goal[j] - now_.angle[j]) > kPoseTolerance)
      throw std::runtime_error(fmt::format("{}: does not get to {:.1f} deg; it stands at {:.1f} deg", config::kJointNames[j],
                                           degrees(goal[j]), degrees(now_.angle[j])));
  }
  throw std::runtime_error("the machine does not come to rest in a pose");
}

void Driver::go_to(std::size_t joint, double angle) {
  Joints goal = now_.angle;
  goal[joint] = angle;
  std::array<bool, 4> moved{};
  moved[joint] = true;
  move_to(goal, moved);
}

void Driver::take_pose(const Joints& pose) {
  Joints goal = pose;
  goal[boom] = machine_.joint[boom].high - 2.0 * kSpare;
  move_to(goal, {false, true, false, false});
  move_to(goal, {false, true, true, true});
  move_to(pose, {false, true, true, true});
}

void Driver::learn(const StopRecord& stop) {
  ways_.push_back({stop.held_speed, stop.farthest_angle - angle_at(stop, stop.sent_s), stop.rest_s - stop.sent_s});
}

double Driver::stop_room(double speed, const JointSpan& span) const {
  if (ways_.empty()) return kUnknownShare * (span.high - span.low);
  const auto fastest = std::max_element(ways_.begin(), ways_.end(), [](const Way& a, const Way& b) { return a.speed < b.speed; });
  double longest = 0.0;
  for (const Way& way : ways_) {
    if (way.speed < 0.9 * fastest->speed) continue;
    const double ratio = std::max(1.0, speed / way.speed);
    longest = std::max(longest, way.angle * ratio * ratio);
  }
  return kGuess * longest + kSpare;
}

double Driver::longest_stop_s(double speed) const {
  double longest = 0.0;
  for (const Way& way : ways_) longest = std::max(longest, way.seconds * std::max(1.0, speed / way.speed));
  return longest;
}

double Driver::test_room(double speed, const JointSpan& span) const {
  const double stop = stop_room(speed, span);
  return kRampShare * stop + speed * (kRamp_s + kHold_s) + stop + kSpare;
}

void Driver::reach_speed(std::size_t joint, double velocity, const JointSpan& span, double hold_s, std::vector<Sample>& samples) {
  const double direction = velocity < 0.0 ? -1.0 : 1.0, speed = std::abs(velocity);
  const auto add = [&] { samples.push_back({now_.time_s, direction * now_.angle[joint], direction * now_.velocity[joint]}); };
  Joints command{};
  command[joint] = velocity;
  add();
  const double begin = now_.time_s;
  double reached_at = -1.0;
  for (;;) {
    step(link_.drive(command));
    add();
    if (samples.size() < 41) continue;
    const double mean = mean_speed(samples, 5), left = direction > 0.0 ? span.high - now_.angle[joint] : now_.angle[joint] - span.low;
    const bool steady = mean > 0.9 * speed && mean_speed(samples, 20) - mean_speed(samples, 20, 20) < 0.004 * speed;
    if (reached_at < 0.0 && (mean >= kReached * speed || steady)) reached_at = now_.time_s;
    if (reached_at >= 0.0 && now_.time_s - reached_at >= hold_s) return;
    if (left <= stop_room(std::max(mean, 0.0), span)) return;  // no more room: stopped at the speed that it has
    if (now_.time_s - begin > kPatience_s)
      throw std::runtime_error(fmt::format("{}: reaches only {:.1f} deg/s of {:.1f} deg/s within {} s", config::kJointNames[joint],
                                           degrees(mean), degrees(speed), kPatience_s));
  }
}

void Driver::wait_for_rest(std::size_t joint, StopManner manner, double direction, std::vector<Sample>& samples) {
  int rest = 0;
  const double begin = now_.time_s;
  while (rest < kRestReadings) {
    step(link_.stop(manner));
    samples.push_back({now_.time_s, direction * now_.angle[joint], direction * now_.velocity[joint]});
    rest = std::abs(now_.velocity[joint]) <= machine_.joint[joint].velocity_error ? rest + 1 : 0;
    if (now_.time_s - begin > kPatience_s)
      throw std::runtime_error(fmt::format("{}: does not stand still within {} s of {}", config::kJointNames[joint], kPatience_s,
                                           kMannerNames[static_cast<std::size_t>(manner)]));
  }
  const auto& range = machine_.joint[joint];
  if (now_.angle[joint] < range.low + kEndOfRange || now_.angle[joint] > range.high - kEndOfRange)
    throw std::runtime_error(fmt::format("{}: ran to the end of its range ({:.1f} deg): its stop is {} times longer than slower ones let expect",
                                         config::kJointNames[joint],
                                         degrees(now_.angle[joint]), kGuess));
}

void Driver::begin_station(std::size_t joint, const JointSpan& span) {
  ways_.clear();
  for (const double share : kProbe) {
    StopPlan plan;
    plan.joint = joint;
    plan.speed = share * machine_.joint[joint].velocity_max;
    for (plan.direction = 1.0; plan.direction >= -1.0; plan.direction -= 2.0) stop_test(plan, span);
  }
}

void Driver::make_room(std::size_t joint, double direction, double room, const JointSpan& span) {
  const double at = now_.angle[joint];
  const bool up = direction > 0.0;
  if (at < span.low - kSpare || at > span.high + kSpare || (up ? span.high - at : at - span.low) < room)
    go_to(joint, up ? std::max(span.low, span.high - room) : std::min(span.high, span.low + room));
}

StopRecord Driver::stop_test(const StopPlan& plan, const JointSpan& span) {
  make_room(plan.joint, plan.direction, test_room(plan.speed, span), span);
  std::vector<Sample> samples;
  reach_speed(plan.joint, plan.direction * plan.speed, span, kHold_s, samples);
  const std::size_t sent = samples.size() - 1;
  wait_for_rest(plan.joint, plan.manner, plan.direction, samples);
  StopRecord record = evaluate_stop(plan, samples, sent, machine_.joint[plan.joint].velocity_error);
  if (record.held_speed < kLeastMotion * plan.speed)
    throw std::runtime_error(fmt::format("{}: moves at {:.2f} deg/s when {:.2f} deg/s is commanded, with no room for more",
                                         config::kJointNames[plan.joint], degrees(record.held_speed), degrees(plan.speed)));
  learn(record);
  for (int i = 0; i < 5; ++i) step(link_.drive({}));  // the machine takes up a sender that was silent after two messages
  return record;
}

Speeds Driver::reversal_test(std::size_t joint, double speed, const JointSpan& span) {
  go_to(joint, span.low);
  std::vector<Sample> samples;
  reach_speed(joint, speed, span, kHold_s, samples);
  samples.clear();
  reach_speed(joint, -speed, span, kHold_s, samples);
  Speeds speeds;
  for (const Sample& s : samples) speeds.push_back(static_cast<float>(s.speed));
  wait_for_rest(joint, StopManner::zero_command, -1.0, samples);
  return speeds;
}

void Driver::step_to(const StepPlan& plan, double speed, double seconds, const JointSpan& span, StepRecord& record) {
  const double direction = plan.direction;
  Joints command{};
  command[plan.joint] = direction * speed;
  for (const double end = now_.time_s + seconds; now_.time_s < end - 0.5 * kCycle_s;) {
    const double left = direction > 0.0 ? span.high - now_.angle[plan.joint] : now_.angle[plan.joint] - span.low;
    if (speed > 0.0 && left <= stop_room(std::max(speed, direction * now_.velocity[plan.joint]), span)) return;
    record.samples.push_back({now_.time_s, speed, direction * now_.velocity[plan.joint]});
    step(link_.drive(command));
  }
}

StepRecord Driver::step_test(const StepPlan& plan, const JointSpan& span) {
  StepRecord record;
  record.plan = plan;
  const double ramp_s = kRampShare * 2.0 * longest_stop_s(plan.speed);
  make_room(plan.joint, plan.direction, test_room(plan.speed, span) + 0.5 * plan.speed * (ramp_s + kStepHold_s), span);
  for (int i = 0; i < kRestReadings; ++i) step(link_.drive({}));
  step_to(plan, 0.0, kStepRest_s, span, record);
  step_to(plan, plan.speed, ramp_s + kStepHold_s, span, record);
  step_to(plan, 0.5 * plan.speed, ramp_s + kStepHold_s, span, record);
  step_to(plan, 0.0, ramp_s + kStepHold_s, span, record);
  return record;
}

}  // namespace berm::identify
