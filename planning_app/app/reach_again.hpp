// After a stop on a pass's way to the truck. What reaches the arm out over the bed and opens the bucket waits for the swing, once; where the stop and its
// mending left the swing short of the dump or beyond it, towards the cab, that has happened and would not be waited for again. So the arm is drawn in and the
// bucket held level until the swing stands at its goal; then the arm reaches out; then the script has the bucket again.
#pragma once

#include <optional>

#include "planning/pass_script.hpp"

namespace berm::app {

class ReachAgain {
public:
  explicit ReachAgain(const MachineModel& machine) : machine_(machine) {}

  // The plan is in charge again, with the bucket not emptied.
  void resumed(const Script& script, const Joints& angle);
  void end() { state_ = State::none; }

  bool active() const { return state_ != State::none; }
  // In place of the script's, rad. stands: the swing, at its goal. carry: the pose for the way to the truck; its swing is not used.
  Joints goals(const Joints& of_script, const Joints& carry, const Joints& angle, bool stands);

private:
  enum class State { none, draws_in, reaches_out };
  MachineModel machine_;
  State state_ = State::none;
};

}  // namespace berm::app
