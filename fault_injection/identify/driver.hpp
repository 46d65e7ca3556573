// Drives the machine through the tests, one joint at a time: goes to a pose, brings a joint to a speed, holds it, stops it.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "config/machine_file.hpp"
#include "identify/machine_link.hpp"
#include "identify/step_record.hpp"
#include "identify/stop_record.hpp"

namespace berm::identify {

struct JointSpan { double low, high; };  // rad; where a test may move its joint

class Driver {
 public:
  // watch is called about once a second of the machine's time; what it throws ends the test.
  Driver(MachineLink& link, const config::MachineFile& machine, std::function<void()> watch);

  // Boom high, then stick and bucket, then the boom; the swing stays where it is. Throws std::runtime_error when the machine does not get there.
  void take_pose(const Joints& pose);
  // Before the first stop of a joint in a pose: slow stops, from which it is learned how much room the others need. (Not from the machine file's
  // table: what is measured must not depend on what was believed.)
  void begin_station(std::size_t joint, const JointSpan& span);
  // One stop within the span, where it begins as needed. Throws std::runtime_error when the joint does not move, does not stand still in time, or
  // reaches the end of its range.
  StopRecord stop_test(const StopPlan& plan, const JointSpan& span);
  // A speed one way, then the other, then zero: the readings from the second command on, positive in its direction.
  Speeds reversal_test(std::size_t joint, double speed, const JointSpan& span);

  // From rest a step to the speed, one to half of it, one to zero, each held until it must have been answered. One for which there is no room is cut
  // short.
  StepRecord step_test(const StepPlan& plan, const JointSpan& span);

  const Joints& fastest_reading() const { return fastest_; }  // rad/s, either direction
  double time_s() const { return now_.time_s; }

 private:
  void step(const Reading& reading);
  void move_to(const Joints& goal, const std::array<bool, 4>& moved);
  void go_to(std::size_t joint, double angle);
  // Goes to where the joint has this room in this direction.
  void make_room(std::size_t joint, double direction, double room, const JointSpan& span);
  void step_to(const StepPlan& plan, double speed, double seconds, const JointSpan& span, StepRecord& record);
  void learn(const StopRecord& stop);
  double stop_room(double speed, const JointSpan& span) const;
  double longest_stop_s(double speed) const;
  // Room for getting to a speed, holding it, and stopping.
  double test_room(double speed, const JointSpan& span) const;
  // Commands the speed until it is reached and held, or the room ends; appends the readings.
  void reach_speed(std::size_t joint, double velocity, const JointSpan& span, double hold_s, std::vector<Sample>& samples);
  void wait_for_rest(std::size_t joint, StopManner manner, double direction, std::vector<Sample>& samples);

  struct Way { double speed, angle, seconds; };  // from the command to standstill

  MachineLink& link_;
  const config::MachineFile& machine_;
  Reading now_;
  std::vector<Way> ways_;  // of the joint and pose under test
  Joints fastest_{};
  std::function<void()> watch_;
  long steps_ = 0;
};

}  // namespace berm::identify
