// The four joint controllers together: goals or a moving reference in, velocity requests out, kept inside every joint's range with the room
// that a stop needs.
#pragma once

#include "motion/joint_controller.hpp"

namespace berm::app {

// Shares of the speed limits, 0.5..1, of motions towards the left or up, and towards the right or down; of the decelerations planned with, their squares.
struct LearnedPaces { Joints up{1.0, 1.0, 1.0, 1.0}, down{1.0, 1.0, 1.0, 1.0}; };

class ArmController {
public:
  explicit ArmController(const MachineModel& machine);

  // To be told once a cycle, first: what the kernel told the machine, between which speeds it permits requests now, and how many cycles have
  // passed since the last (those not seen are taken to have been as this one).
  void heard(const Joints& commanded, const Joints& permitted_low, const Joints& permitted_high, int cycles = 1);
  // What is in the bucket from now on, kg: the joints answer accordingly.
  void carries(double payload_kg) { payload_kg_ = payload_kg; }
  // What toward keeps to from now on: learned (OverrunLimits).
  void limit(const LearnedPaces& paces) { learned_ = paces; }
  // paces scale the speed limits, tempos the whole motion in time; 0..1.
  Joints toward(const Joints& goals, const Joints& paces, const Joints& tempos, const Joints& angle, const Joints& velocity);
  Joints toward(const Joints& goals, const Joints& paces, const Joints& angle, const Joints& velocity) { return toward(goals, paces, {1.0, 1.0, 1.0, 1.0}, angle, velocity); }
  Joints follow(const Joints& reference, const Joints& reference_velocity, const Joints& angle, const Joints& velocity);
  // Landings of the swing are planned with no less than this deceleration (rad/s2), whatever the machine file's table says: learned (SwingBraking).
  void brake_swing(double at_least) { swing_at_least_ = at_least; }
  double swing_deceleration() const { return swing_deceleration_; }  // that toward planned with last
  // To be told once a cycle, last: what was requested in the end.
  void asked(const Joints& command);
  // Both, where there is no kernel to cut anything.
  void sent(const Joints& command);
  // Angles when a request made now begins to act, by what the kernel let out.
  Joints predicted(const Joints& angle, const Joints& velocity) const;
  // Angles most of a lag later, until when joints have gone on as they were.
  Joints taken_up(const Joints& angle, const Joints& velocity) const;

  // Of each joint, as JointController's.
  const JointModel& model(std::size_t joint) const { return controller_[joint].model(); }
  Joints shares() const;
  bool cut(std::size_t joint) const { return controller_[joint].cut(); }

private:
  // Of a joint at this reach (m), which from now on answers as it does there.
  ControllerLimits limits_at(std::size_t joint, double reach_m);

  const MachineModel* machine_;
  std::array<JointController, joints> controller_;
  double payload_kg_ = 0.0;
  LearnedPaces learned_;
  double swing_at_least_ = 0.0, swing_deceleration_ = 0.0;
};

}  // namespace berm::app
