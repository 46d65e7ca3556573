// How long a pass took from the end of its dig to the start of the next, over the least time that its joints' limits allow.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "run/trace_file.hpp"

namespace berm::run {

struct JointLimit { double velocity, acceleration; };  // rad/s, rad/s2
using JointLimits = std::array<JointLimit, 4>;         // swing, boom, stick, bucket
using Pose = std::array<double, 4>;                    // rad

// Least time from rest to rest over an angle: full acceleration, full velocity where it is reached, full deceleration.
double rest_to_rest_s(double angle, const JointLimit& limit);

// Least time of one joint from rest at start through dump to rest at end. Where the dump lies between the two it is passed without a rest; else the
// joint turns round at it.
double through_dump_s(double start, double dump, double end, const JointLimit& limit);

// The slowest joint's least time, no joint minding the others.
double kinematic_bound_s(const Pose& start, const Pose& dump, const Pose& end, const JointLimits& limits);

// The times of one pass, by the app's events "phase": "lift" ends the dig, "swing to dig" ends the dump, "dig" begins the next.
struct PassSpan { double lift_s, emptied_s, dig_s; };

// Of each pass that a dig of the same truck follows; a dig or dump that was begun anew counts from its last begin.
std::vector<PassSpan> pass_spans(const std::vector<nlohmann::json>& app_events);

// Of each such pass the time taken over its bound. rows: the trace.
std::vector<double> kinematic_ratios(const std::vector<nlohmann::json>& app_events, const std::vector<TraceRow>& rows, const JointLimits& limits);

}  // namespace berm::run
