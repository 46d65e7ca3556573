// What a person at the machine makes of the horn: contract/horn_signals.h.
#pragma once

namespace berm::plant {

struct HornSignal {
  enum class What { none, truck_full, move_back } what = What::none;
  double distance_m = 0.0;  // of move_back
};

class HornListener {
 public:
  // Once a cycle: the signal that is complete at t.
  HornSignal step(double t, bool sounds);

 private:
  HornSignal end_group();

  bool sounds_ = false, told_ = false;  // told_: this blast was the long one
  double began_s_ = 0.0, fell_s_ = -1.0;
  int blasts_ = 0;                      // of the group
  bool asked_ = false;                  // the first group of "move back" was heard
};

}  // namespace berm::plant
