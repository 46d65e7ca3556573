// What is kept of one stop: what was asked, and what the bus showed. Angles and speeds count positive in the direction of the motion.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "identify/acceleration.hpp"
#include "identify/machine_link.hpp"

namespace berm::identify {

struct Sample { double time_s, angle, speed; };

struct StopPlan {
  std::size_t joint = 0;
  std::size_t row = 0;      // of the braking table; for the swing alone
  std::size_t column = 0;
  std::size_t station = 0;  // number of the pose
  bool between = false;     // halfway from the column before to this one: holds the table against what lies between its speeds
  double speed = 0.0;       // rad/s
  double direction = 1.0;
  StopManner manner = StopManner::zero_command;
};

struct StopRecord {
  StopPlan plan;
  std::uint64_t seed = 0;
  bool loaded = true;
  double held_speed = 0.0;          // mean of the readings just before the stop
  double sent_s = 0.0;              // the command to stop answered the reading of this time
  double farthest_angle = 0.0;      // largest reading from then on
  double rest_s = 0.0;              // bound of the time from which it stands
  std::optional<double> obeyed_s;   // when the speed began to fall, by a line through the falling speeds; none when too few were seen
  Speeds approach;                  // from standstill to the held speed
  std::vector<Sample> first;        // from the reading before the command on, until the speed has halved
};

// Evaluates the samples of a stop; sent: index of the reading that the command answered. speed_error: bound of a reading's error.
StopRecord evaluate_stop(const StopPlan& plan, const std::vector<Sample>& samples, std::size_t sent, double speed_error);

// Angle on the way at a time within record.first, between readings by a straight line.
double angle_at(const StopRecord& record, double time_s);

}  // namespace berm::identify
