// One bucket on its way to the truck, by its weight in every cycle: what it carried before anything slid, and how much left it where its lip was not over the
// bed. That lies on the ground beside the truck and is not in the bed, though the weighings before and after the dump say so.
#pragma once

#include <vector>

#include "motion/arm_kinematics.hpp"
#include "planning/skyline.hpp"

namespace berm::app {

// Of the stream that leaves the lip, the share that falls outside the bed's walls. half_width: of the bucket.
double share_beside(const MachineModel& machine, const TruckBed& bed, const Joints& angle, double half_width);

class PourWatch {
public:
  // What a full bucket holds: the pressures' noise is a share of it.
  explicit PourWatch(double full_kg = 1600.0) : full_kg_(full_kg) {}

  void begin();
  // Once a cycle while the bucket is in the air, until it has emptied.
  struct Bucket {
    double kg = -1.0;        // in it; negative: unknown
    bool rests = false;      // level: nothing slides yet
    double beside = 0.0;     // share_beside
  };
  void step(const Bucket& now);
  // While, after a stop, the bucket is held level and brought over the bed again: where what has left it meanwhile fell is not known, and is not counted.
  // poured: some of it had left it already.
  void pause(bool poured);

  // Before anything slid.
  bool carried_known() const;
  double carried_kg() const { return rested_ > 0 ? rested_sum_ / rested_ : 0.0; }
  // Fell beside the bed, at least: 0 where it cannot be told from the noise, else less by the noise, for a truck must not be overloaded for it.
  double beside_kg() const;
  // With what falls off a heap meanwhile, which no lip shows: in simulation 0.3 to 1.6 times as much (measured terrain, four trucks).
  static constexpr double falls_unseen = 0.3;
  double booked_beside_kg(bool onto_heap) const { return (onto_heap ? 1.0 + falls_unseen : 1.0) * beside_kg(); }

private:
  void weighed(double kg, double share);

  static constexpr int block = 10;  // cycles: a mean over so many
  double full_kg_;
  int rested_ = 0;
  double rested_sum_ = 0.0;
  int count_ = 0;                   // of the block that is filled
  double sum_ = 0.0, share_sum_ = 0.0;
  bool slid_ = false, paused_ = false;
  double last_kg_ = 0.0, last_share_ = 0.0;  // of the block before
  int unseen_ = 0;                  // cycles since the last block, not at rest and with the weight unknown
  double unseen_share_sum_ = 0.0;
  // What has left the bucket, by where its lip was: from so much in it down to so much. A weight that rises again had not left it.
  struct Left { double from_kg, to_kg, share; };
  std::vector<Left> left_;
};

}  // namespace berm::app
