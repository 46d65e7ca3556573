// The cycle sequencer: survey, wait for a truck, look where it stands and how large it is, then dig, lift, swing, dump, swing back, until the truck is full; next truck, until all are.
#pragma once

#include <optional>
#include <string>

#include "app/base_watch.hpp"
#include "app/bench_move.hpp"
#include "app/guard_account.hpp"
#include "app/hold_watch.hpp"
#include "app/joint_watch.hpp"
#include "app/load_check.hpp"
#include "app/look_watch.hpp"
#include "app/observation.hpp"
#include "app/pour_watch.hpp"
#include "app/progress_log.hpp"
#include "app/reach_again.hpp"
#include "app/recovery.hpp"
#include "app/restart_call.hpp"
#include "app/scan_wait.hpp"
#include "app/slow_down.hpp"
#include "app/standing_watch.hpp"
#include "app/start_call.hpp"
#include "app/swing_forecast.hpp"
#include "app/truck_look.hpp"
#include "app/truck_presence.hpp"
#include "app/weighing.hpp"
#include "motion/dig_path.hpp"
#include "motion/dig_stall.hpp"
#include "motion/soil_force.hpp"
#include "motion/swing_braking.hpp"
#include "perception/kernel_map.hpp"
#include "planning/bed_map.hpp"
#include "planning/dig_floor.hpp"
#include "planning/dig_regions.hpp"
#include "planning/dump_point.hpp"
#include "planning/face_reserve.hpp"
#include "planning/goal_shape.hpp"
#include "planning/heaped_bucket.hpp"
#include "planning/look_ahead.hpp"
#include "planning/pass_search.hpp"
#include "planning/sticking_soil.hpp"
#include "planning/truck_fill.hpp"

namespace berm::app {

class Sequencer {
public:
  // scripts and finder must outlive it.
  Sequencer(const MachineModel& machine, const SiteModel& site, int trucks, const ScriptSet& scripts, TruckFinder& finder, const ProgressLog& log);

  Sequencer(const Sequencer&) = delete;  // parts of it point into it
  Sequencer& operator=(const Sequencer&) = delete;

  // Once a cycle. The maps must hold the cycle's scan points and the kernel's published map already.
  Answer step(const Observation& o);

  bool finished() const { return stage_ == Stage::finished; }
  const SlowDown& slow_down() const { return slow_down_; }
  const ScanWait& scan_wait() const { return scan_wait_; }
  const GuardAccount& guard_account() const { return guard_account_; }
  const JointWatch& joint_watch() const { return joint_watch_; }
  KernelMap& kernel_map() { return kernel_map_; }
  TerrainMap& terrain() { return terrain_; }
  BedMap* bed() { return bed_ ? &*bed_ : nullptr; }  // of the truck that was recognised
  TruckSweep& sweep() { return look_.sweep(); }

private:
  enum class Stage { survey, wait_truck, go_look, look, approach, settle, dig, curl, pass, leave_bed, horn, wait_leave, raise_for_move, ask_move, being_moved, exhausted, finished };

  void enter(Stage stage, const Observation& o);
  void enter_phase(std::uint16_t phase, const Observation& o);
  static const char* phase_name(std::uint16_t phase);
  Joints plan(const Observation& o);          // the stage's motion of this cycle
  void hear(const Observation& o);            // what the kernel let out of the request before, and what it permits now
  void watch_joints(const Observation& o);    // against their models, with what is in the bucket
  Joints tempos() const;                      // of the script's active rules, with a slowed swing
  Joints run_script(const Observation& o, std::uint32_t events);
  void foresee(const Observation& o, std::uint32_t events);  // what the script will meet
  bool look_for_foresight(const Observation& o);
  void tell_change(const Observation& o, const LookAhead::Change& change) const;
  double carried_kg() const;
  Joints approach(const Observation& o);
  Joints settle(const Observation& o);
  bool swing_stands_at_goal(const Observation& o) const;
  Joints dig(const Observation& o);
  Joints curl(const Observation& o);
  Joints lift_and_curl(const Observation& o);
  Joints pass(const Observation& o);
  Joints pass_goals(const Observation& o);
  void plan_next_dig(const Observation& o, double dump_beyond);
  void tell_region(const Observation& o, const RegionDig& next) const;
  DigNeeds needs_for(double kg) const;
  void note_cut(const Observation& o);
  void plan_landing(const Observation& o);    // how hard the swing brakes
  void feel(const Observation& o);            // the implements' weight, or how hard the soil resists
  double stuck_kg() const;
  bool knows_what_stuck() const;
  void learn_yield(double weighed_kg, double brought_along_kg);
  void learn_heaped(const Observation& o, double lifted_kg);
  double full_bucket_kg() const;
  void hold_fill(double in_bucket_kg);
  void begin_script(const Script& script);
  void begin_approach(const Observation& o, bool lower);
  bool approach_dig(const Observation& o, double top, bool lower);
  static constexpr double over_heaps = 0.4;  // z, on the ground that it stands on: what raised implements are clear of
  std::optional<Script> raised(const Observation& o, double bearing) const;  // to that bearing, the implements up
  void begin_look(const Observation& o);
  void raise_to_wait(const Observation& o, double bearing);
  void wait_raised(const Observation& o);
  void end_survey(const Observation& o);
  std::optional<double> bearing_on_the_way(const Observation& o) const;
  bool go_look_on_the_way(const Observation& o);
  bool looks_on_the_way() const;              // swings to its first dig, or stands over it, and does not know the truck yet
  void look_on_the_way(const Observation& o);
  void follow_truck(const Observation& o);    // trucks come and go while the kernel keeps the machine, too
  void next_truck(const Observation& o);
  void expect_another_truck();                // what the operator was told of the one before is not said of it
  void forget_bed();
  void finish(const Observation& o);
  void leave_truck(const Observation& o);     // it left before it was full
  bool works() const;
  Awaited awaited_of_look(const Observation& o) const;
  void watch_look(const Observation& o);
  Recovery::Advice recover(const Observation& o);
  bool digs_or_comes_to_dig() const;
  bool comes_down() const;
  bool has_poured() const;
  void go_on_from_a_stand(const Observation& o);
  void begin_dig_from_here(const Observation& o);
  bool begins_anew_where_moved() const;
  void go_on_with_script(const Observation& o);
  void take_load_back(const Observation& o);
  void keep_load();
  void miss_approach(const Observation& o);
  void miss_dig(const Observation& o);
  void refuse_truck(const Observation& o);
  void call_for_truck(const Observation& o);  // when none comes, or the full one does not leave
  bool sounds_full(const Observation& o) const;
  Joints go_look(const Observation& o);
  Joints look_for_truck(const Observation& o);
  void begin_books(const Observation& o);
  void take_bed(const Observation& o, const TruckBed& bed);
  void begin_truck(const Observation& o, const TruckBed& bed);
  void begin_dig(const Observation& o);
  bool comes_down_to_goal(const Observation& o, const ArmPoints& now) const;
  void begin_curl(const Observation& o, const char* why);
  void plan_dump(const Observation& o);
  DumpPoint dump_point(const Observation& o, double goal_kg, double dig_bearing) const;
  double next_goal_kg(const Observation& o, double dig_bearing) const;
  bool more_fits(const Observation& o) const;
  void begin_pass_search(const Observation& o, const Joints& lifted_from);
  static constexpr double empty_share = 0.05;  // of a full bucket: what holds no more than that and what sticks is empty
  BedPoint along_way_back(double way, double radius) const;
  bool over_bed_on_way_back(double way) const;
  bool runs_out_over_bed() const;
  bool let_out_slowly() const;
  bool waits_with_pour(const Observation& o) const;
  bool pours_onto_heap() const;
  double share_that_may_trail() const;
  BedPoint lies_at(double payload_kg) const;
  std::uint32_t pass_events(const Observation& o);
  bool swings() const;
  bool swings_back() const;
  SwingForecast::Work work_before_swing() const;
  ComingSwing coming_swing(const Observation& o);
  std::uint32_t scan_event(const Observation& o, std::uint32_t events);
  void note_swing_began(const Observation& o, bool left_before, bool returned_before);
  bool carries_level(const Observation& o) const;
  double pressed_kg(const Observation& o) const;
  void watch_pour(const Observation& o, double kg);
  std::optional<double> weighed_kg() const;   // what the bucket carried to the truck, which may be nothing
  double lifted_kg() const { return weighed_kg().value_or(0.0); }
  double over_walls_kg(double poured_kg);
  void book_pass(const Observation& o);
  void end_pass(const Observation& o);
  void go_on_after_pass(const Observation& o, bool lowered);
  bool back_from_bed(const Observation& o) const;
  bool begin_leave_bed(const Observation& o);
  Joints leave_bed(const Observation& o);
  bool face_too_poor_for_a_truck();
  void begin_move_back(const Observation& o, const char* why);
  Joints raise_for_move(const Observation& o);
  void await_move(const Observation& o);
  void hand_over(const Observation& o);       // to the operator, for the move
  void begin_anew(const Observation& o);
  void note_slip(const Observation& o);
  void begin_anew_after_slip(const Observation& o);
  void forget_surroundings(const Observation& o);
  bool truck_is_begun() const;
  void look(const Observation& o);            // renews the skyline now and then
  // What the kernel last stopped the machine for.
  bool too_high_stands() const;
  bool unseen_lies_there() const;
  void log_held(const Observation& o, const Joints& wanted) const;
  Joints slowed(const Observation& o, const Joints& wanted);

  const ScriptSet& scripts_;
  MachineModel machine_;
  ImplementScale scale_;
  DigStall stall_;
  HeapedBucket heaped_;                       // what the bucket holds of this soil
  SiteModel site_;
  DigFloor dig_floor_;
  ProgressLog log_;
  int trucks_;

  KernelMap kernel_map_;
  TerrainMap terrain_;
  DigGround ground_;
  std::optional<BedMap> bed_;
  std::optional<Skyline> skyline_;
  double skyline_s_ = 0.0;
  ArmController arm_;
  SwingBraking brakes_;                       // with an empty bucket
  JointWatch joint_watch_;
  ScanScheduler scanners_;
  SwingForecast swing_forecast_;
  ScanWait scan_wait_;
  bool awaits_scan_ = false;                  // the swing would begin but for the scanner that leads it
  double dug_share_ = 0.0;                    // of this dig's goal that is in the bucket
  GuardAccount guard_account_;
  TruckLook look_;
  Recovery recovery_;
  RestartCall restart_call_;
  StartCall start_call_;
  LookWatch look_watch_;
  BaseWatch base_;
  bool slipped_ = false;                      // the base, and the plan is not in charge again yet
  bool bed_slipped_ = false;                  // this truck's, and is not known again yet: the bucket may stand over it
  SlowDown slow_down_;
  StandingWatch standing_;
  int stands_ = 0, missed_digs_ = 0;          // in a row
  int refused_truck_ = 0;                     // which the operator was told of
  std::uint64_t heard_cycle_ = 0;
  DigFollower follower_;
  Script script_;
  double script_s_ = 0.0;
  LookAhead look_ahead_;
  std::optional<LookAhead::Pass> ahead_pass_;  // that the script was bound with, if it is a pass's
  std::optional<Skyline> ahead_;              // of what has ever been seen
  double ahead_from_s_ = 0.0;
  std::optional<PassSearch> search_;
  PassTask task_;
  PassPoses poses_;

  Stage stage_ = Stage::survey, after_survey_ = Stage::wait_truck;
  double stage_s_ = 0.0;
  std::uint16_t phase_ = BERM_PHASE_WAIT;
  DigPlan dig_;
  std::optional<GoalProfile> dig_goal_;       // of this dig
  DigRegion region_;                          // that is worked
  std::optional<CutModel> cut_;               // of this dig
  ImplementWeight weight_;
  std::optional<double> soil_n_;              // force of the soil on the bucket, while that can be told
  DigFill filled_;                            // of this dig, by force
  std::vector<double> planned_fill_;          // of this dig: bank m3 in the bucket, evenly along its path
  bool can_lift_ = false;                     // a way out of the soil is known
  bool comes_from_deep_ = false;              // the bucket, from under a bank
  bool holds_nothing_ = true;
  double yield_ = 1.0;                        // what a modelled cubic metre brings, of what bank soil weighs
  HoldWatch hold_;                            // by the guard
  bool looked_ = false;                       // in this hold
  int poor_passes_ = 0;
  FaceYield face_yield_;
  double back_m_ = 0.0;                       // asked for
  double loaded_here_kg_ = 0.0;               // since the machine stands where it does
  int vain_moves_ = 0;                        // in a row
  bool run_was_off_ = false;                  // since the operator took over for a bench move
  bool saw_run_ = false, part_filled_ = false;  // part_filled_: of this truck the bed is not known any more, or not yet again; what is in it is
  bool waits_raised_ = false;                 // for the next truck
  TruckPresence presence_;                    // of the truck that is looked at, loaded or full
  bool called_for_truck_ = false;             // in this stage
  bool brings_load_ = false;                  // the bucket still holds what was meant for a truck that is gone
  LoadCheck load_check_;
  ReachAgain reach_again_;
  DumpPoint dump_;
  struct Dump { BedPoint at; double kg; };
  std::vector<Dump> dumps_;                   // into this truck
  int truck_ = 1;
  int pass_ = 0;
  TruckFill fill_;
  StickingSoil sticking_;
  double goal_kg_ = 0.0;
  double pass_began_s_ = 0.0, truck_began_s_ = 0.0, open_since_s_ = -1.0;
  bool pours_ = false;                        // has begun to, in this pass
  bool emptied_ = false;
  PourWatch pour_;
  RecentWeight recent_;
  MeanWeight before_, after_;
  MeanWeight swung_;                          // by the pressures on the way to the truck, at any tilt
};

}  // namespace berm::app
