// The four joint controllers together: goals or a moving reference in, velocity requests out, kept inside every joint's range with the room
// that a stop needs.
#pragma once

#include "motion/joint_controller.hpp"

namespace berm::app {

class ArmController {
public:
  explicit ArmController(const MachineModel& machine);

  // paces scale the speed limits, 0..1.
  Joints toward(const Joints& goals, const Joints& paces, const Joints& angle, const Joints& velocity);
  Joints follow(const Joints& reference, const Joints& reference_velocity, const Joints& angle, const Joints& velocity);
  // To be told once a cycle what was requested in the end.
  void sent(const Joints& command);
  // Angles when a request made now begins to act.
  Joints predicted(const Joints& angle, const Joints& velocity) const;

private:
  const MachineModel* machine_;
  std::array<JointController, joints> controller_;
};

}  // namespace berm::app
