// Step responses: what was commanded, and what the bus showed. Speeds count positive in the direction of the motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace berm::identify {

struct StepPlan {
  std::size_t joint = 0;
  std::size_t reach = 0;    // number of the reach; 0 for boom, stick and bucket
  bool loaded = true;
  double speed = 0.0;       // rad/s, of the first step
  double direction = 1.0;
};

struct StepSample {
  double time_s;
  double command;           // sent in answer to this reading, rad/s
  double speed;             // rad/s
};

struct StepRecord {
  StepPlan plan;
  std::uint64_t seed = 0;
  std::vector<StepSample> samples;  // every cycle
};

}  // namespace berm::identify
