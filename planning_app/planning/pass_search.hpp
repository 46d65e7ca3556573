// The search for the left-hand sides of a pass's script: how soon each joint may set out.
#pragma once

#include "planning/pass_script.hpp"

namespace berm::app {

// Finds the thresholds: starts from the soonest and simulates script, controllers and joint models against the skyline until the motion
// stays clear. One candidate a step, so that a cycle is never late.
class PassSearch {
public:
  // scripts must outlive it.
  PassSearch(const ScriptSet& scripts, const MachineModel& machine, const Skyline& skyline, const PassTask& task, const PassPoses& poses);

  bool done() const { return stage_ == Stage::done; }
  void step();
  const PassThresholds& thresholds() const { return thresholds_; }
  const PassPoses& poses() const { return poses_; }  // hovers lower over the dig where there is room
  bool clear() const { return clear_; }            // of the whole pass, by the models; false: the last candidate stands, the guard will slow it
  double seconds() const { return seconds_; }      // the models' time for the pass without the dig

private:
  enum class Stage { swing_out, sooner_out, over_bed, swing_back, hover, lower, done };  // in this order
  struct Outcome { bool clear_out = true, clear_over_bed = true, clear_back = true, finished = false; double seconds = 0.0; };  // out: until the arm reaches out over the bed
  void next(Stage stage);
  void start_of_swing();
  void sooner_swing();
  void reach_out_over_bed();
  void reach_out_over_dig();
  void hover_lower();
  void lower_sooner();
  void set_reach_over_bed();
  Outcome simulate(const PassThresholds& thresholds) const;

  const ScriptSet* scripts_;
  MachineModel machine_;
  Skyline skyline_;
  PassTask task_;
  PassPoses poses_;
  PassThresholds thresholds_;
  Stage stage_ = Stage::swing_out;
  double lead_ = 0.0;               // s before the swing stands that the bucket begins to open
  double too_soon_ = 0.0;           // boom angle at which the swing may not begin yet
  int candidate_ = 0;
  bool clear_out_ = false, clear_over_bed_ = false, clear_ = false;
  double seconds_ = 0.0;
};

}  // namespace berm::app
