// The kernel's published map as ground for the skyline: what the kernel will check against.
#pragma once

#include <cstdint>
#include <vector>

#include "contract/berm_contract.h"
#include "planning/skyline.hpp"

namespace berm::app {

class KernelMap {
public:
  KernelMap();

  // Copies the published map; rows may be of different cycles.
  void take(const berm_state_segment& segment);

  enum class Unseen {
    level,    // as high as the ground the machine stands on: for plans, by then it will have been seen
    blocked   // infinitely high, as the kernel takes it
  };
  Ground ground(Unseen unseen) const;  // refers to this map

private:
  double cell_ = 0.3, origin_ = 0.0;  // m
  std::vector<double> height_;
  std::vector<std::uint8_t> status_;
};

}  // namespace berm::app
