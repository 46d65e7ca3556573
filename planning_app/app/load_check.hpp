// Whether a lifted bucket holds more than may go into the truck. It is weighed while it swings there; of one that holds too much a part is poured over the
// bed, tilt by tilt, and the rest goes back to the dig.
#pragma once

#include "app/progress_log.hpp"
#include "app/weighing.hpp"
#include "planning/truck_fill.hpp"

namespace berm::app {

class LoadCheck {
public:
  // load_scale: what the bucket holds beside that of the machine on which the tilting was tried out (ImplementScale).
  explicit LoadCheck(double load_scale = 1.0) : load_scale_(load_scale) {}

  // The bucket has left the soil. A check that is not needed is passed at once.
  void begin(double time_s, bool needed);

  // The bucket as it is lifted.
  struct Lifted {
    double time_s = 0.0;
    double payload_kg = 0.0;  // on-board weighing; negative: unknown, as while it digs and shortly after
    double attitude = 0.0;    // absolute angle of the bucket, rad
    bool over_bed = false;    // it may pour
    double stays_kg = 0.0;    // of its load, in the bucket after the dump
    bool lifts = false;       // on its way up: may be in the soil yet, and the weighing blind until some seconds after it
    double pressed_kg = -1.0; // by the cylinders' pressures, now; negative: unknown
    double carried_kg = -1.0; // by them, before anything slid; negative: unknown
    double beside_kg = 0.0;   // was seen to fall beside the bed: as much more may go into it
  };
  // Once a cycle from then on. How fast the bucket is to tilt towards the dump, rad/s; negative: nothing is asked for.
  double step(const Lifted& now, const TruckFill& fill, const ProgressLog& log);

  bool weighed() const { return stage_ == Stage::pours || stage_ == Stage::passed; }  // or need not be, or cannot: it may go over the bed
  bool pours_part() const { return stage_ == Stage::pours; }                          // as soon as it is there
  bool keeps_rest() const { return keeps_rest_; }                                     // has poured a part
  double rest_kg() const { return rest_; }                                            // what was to stay in it then, less what fell beside
  bool passed() const { return stage_ == Stage::passed; }
  // What was in it before anything was poured; negative when it was not weighed.
  double lifted_kg() const { return lifted_; }

private:
  enum class Stage { blind, weighs, pours, passed };
  void enter(Stage stage, double time_s);
  void decide(double lifted_kg, const Lifted& now, const TruckFill& fill, const ProgressLog& log);

  double load_scale_;
  Stage stage_ = Stage::passed;
  double stage_s_ = 0.0, began_s_ = 0.0, last_s_ = 0.0;
  double lifted_ = -1.0, rest_ = 0.0;  // rest_: what is to stay in it
  bool keeps_rest_ = false;
  MeanWeight mean_;
  RecentWeight recent_;
};

}  // namespace berm::app
