// The motion that every party is asked about: 3 s in 45 steps, a swing with boom, stick and bucket moving.
#pragma once

#include <array>
#include <cstdint>

#include "config/parameter_block.h"
#include "core/reach_box.h"

namespace berm::bench {

inline constexpr int kSteps = 45;
inline constexpr double kHorizonS = 3.0;

struct Joints {
  double angle[4];  // rad: swing, boom, stick, bucket
};

// Angles at the beginning of step 0..kSteps (the last is the end of the horizon).
Joints joints_at(double step);
// The joints' intervals over one step, rounded outward to the microradian.
sk_reach_box box_of_step(int step);

// A vertex of a part, side -1 or +1, in the base frame, m. (The bench's own kinematics.)
struct Vec3 {
  double x, y, z;
};
Vec3 part_point(const berm_parameters& parameters, const berm_part& part, const Joints& joints, double x_m, double z_m, double y_m);

}  // namespace berm::bench
