// One trial of the validation sweep (leger-1998 section 2.5, whole instead of partitioned): an obstacle's size and place, implement poses, swing and
// speed drawn together.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "plant/machine/implement_shape.hpp"
#include "plant/process/world_config.hpp"
#include "plant/world/world.hpp"

namespace berm::validate {

enum class Place { in_swing, beyond_target, anywhere };

struct Trial {
  std::uint64_t seed = 1;
  int run = 0;
  std::array<double, 4> from{}, to{};  // joint angles, rad: swing, boom, stick, bucket
  double swing_speed = 0.0;            // asked for at most, rad/s
  double payload_kg = 0.0;
  Place place = Place::anywhere;
  plant::BoxConfig obstacle;           // base frame
};

struct SwingLimits {
  double velocity_max;                 // rad/s
  double loaded_kg;
  double own_body_radius;              // m
  double fence;                        // m from the swing axis: no obstacle stands nearer; 0 for none, where the tail is watched
};

// The same seed and run give the same trial. Poses keep the implements at least 1 m above the ground, and
// stick and bucket 1 m clear of the machine's own cells, where the kernel lets them work; at the start the obstacle is 1 m away
// or more, and no part of it ever stands within the fence.
Trial draw_trial(std::uint64_t seed, int run, const plant::ImplementShape& shape, const SwingLimits& limits);

const char* place_name(Place place);
// What a person needs to see the trial before him, one line.
std::string describe(const Trial& trial);

// A level, slightly rough site with nothing but the obstacle, the scanners with noise and outliers.
plant::WorldConfig world_of(const Trial& trial);

}  // namespace berm::validate
