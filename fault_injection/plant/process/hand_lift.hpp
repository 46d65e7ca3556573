// An operator who lifts the implements by hand, with the selector at manual and the run switch off: what the bucket hides in a face or under
// itself the sensors see again. He moves the boom alone, up, and looks about first.
#pragma once

#include <array>

#include "plant/machine/plant_profile.hpp"
#include "plant/world/world.hpp"

namespace berm::plant {

class HandLift {
 public:
  // Until the bucket's underside is above the scanners' heads, or the boom at its stop.
  explicit HandLift(const PlantProfile& profile);

  void begin(double t);
  // Once a cycle while he has the levers. somebody_near: within the implements' reach; nothing is moved then.
  void step(double t, const JointState& joints, bool somebody_near);
  // Speeds by the levers, rad/s, joints in the plant's order.
  const std::array<double, 4>& levers() const { return levers_; }
  bool done() const { return stage_ == Stage::done; }

 private:
  enum class Stage { looks, lifts, rests, done };

  ImplementShape shape_;
  double height_ = 0.0;      // m above the ground under the machine
  double boom_stop_ = 0.0;   // rad
  Stage stage_ = Stage::done;
  double since_s_ = 0.0;
  std::array<double, 4> levers_{};
};

}  // namespace berm::plant
