// The sequencer between two stands of the machine: when the face is dug out, what the operator is told, and how work is taken up after the move, or after the base
// has slipped.
#include <cmath>
#include <utility>

#include "app/move_bearing.hpp"
#include "app/sequencer.hpp"
#include "contract/horn_signals.h"

namespace berm::app {

namespace {

constexpr double bank_kg_m3 = 1474.0;
constexpr double reserve_share = 2.2;        // of a truck's soil: with less within reach the last passes of a truck find little
constexpr double raising_patience = 20.0;    // s
constexpr double worth_a_move_kg = 3000.0;   // two buckets
constexpr int vain_moves = 2;

}  // namespace

// Between two trucks nobody waits for a bucket: the face is left before a truck would be filled from its rest.
bool Sequencer::face_too_poor_for_a_truck() {
  ground_.observe(terrain_);
  const FaceReserve face = face_reserve(site_, ground_, dig_floor_.lowest(), bucket_width(machine_));
  log_.event("face", {{"truck", truck_}, {"volume_m3", face.volume}, {"crest_m", face.crest}});
  return face.volume < reserve_share * site_.place.target_kg / bank_kg_m3;
}

void Sequencer::begin_move_back(const Observation& o, const char* why) {
  enter_phase(BERM_PHASE_WAIT, o);
  vain_moves_ = loaded_here_kg_ < worth_a_move_kg ? vain_moves_ + 1 : 0;
  if (vain_moves_ > vain_moves) {
    log_.event("face_exhausted", {{"time_s", o.time_s}, {"truck", truck_}, {"loaded_kg", fill_.loaded_kg()}});
    log_.event("operator_needed", {{"time_s", o.time_s}, {"reason", "face exhausted"},
                                   {"advice", "moving back did not help: set the machine before another face, where there is soil over the dig zone's floor, and start anew"}});
    enter(Stage::exhausted, o);
    return;
  }
  ground_.observe(terrain_);
  const FaceReserve face = face_reserve(site_, ground_, dig_floor_.lowest(), bucket_width(machine_));
  back_m_ = back_distance(site_, face, BERM_HORN_MOVE_BACK_STEP_M, BERM_HORN_MOVE_BACK_STEPS);
  log_.event("move_back", {{"time_s", o.time_s}, {"truck", truck_}, {"distance_m", back_m_}, {"why", why}, {"face_m3", face.volume}, {"crest_m", face.crest}});
  log_.event("operator_needed", {{"time_s", o.time_s}, {"reason", "move back"},
                                 {"advice", "switch run off, have the truck make way, tram the machine straight back by the distance, press relearn and reset, switch run on"}});
  const double middle = 0.5 * (site_.dig_swing_left + site_.dig_swing_right);
  const auto pose = raised_pose(machine_, over_heaps, brings_load_);
  if (const auto script = pose ? raised(o, move_bearing(machine_, *pose, middle, kernel_map_.cell())) : std::nullopt) begin_script(*script);
  else script_s_ = -1.0;
  enter(Stage::raise_for_move, o);
}

// The implements go up and ahead, where they are in nobody's way.
Joints Sequencer::raise_for_move(const Observation& o) {
  if (o.time_s - stage_s_ < raising_patience) {
    const Joints command = run_script(o, event_none);
    const Joints goals = script_.goals();
    constexpr Joints close{radians(0.5), radians(4.0), radians(4.0), radians(4.0)};  // of the swing: move_bearing
    bool near = true;
    for (std::size_t j = 0; j < joints; ++j) near = near && std::fabs(goals[j] - o.angle[j]) < close[j];
    if (!(script_.at_last() && near)) return command;
  }
  saw_run_ = false;
  enter(Stage::ask_move, o);
  return {};
}

// Until the operator takes over, or the base has moved without him.
void Sequencer::await_move(const Observation& o) {
  saw_run_ = saw_run_ || (o.run_switch && o.running());
  const bool taken_over = saw_run_ && !o.run_switch, moves = o.stop_reason == BERM_STOP_BASE_MOVED;
  if (stage_ == Stage::ask_move && (taken_over || moves)) hand_over(o);
  else if (stage_ == Stage::being_moved && o.running()) begin_anew(o);
  run_was_off_ = run_was_off_ || !o.run_switch;
}

void Sequencer::hand_over(const Observation& o) {
  recovery_ = Recovery(machine_);  // what kept the machine here has no part in what keeps it there
  run_was_off_ = false;
  enter(Stage::being_moved, o);
}

// What was seen is not where it was. What was learned of the soil and of the machine holds, and so do the books.
void Sequencer::forget_surroundings(const Observation& o) {
  terrain_ = TerrainMap();
  ground_ = DigGround(site_);
  kernel_map_ = KernelMap();
  search_.reset();
  skyline_.reset();
  ahead_.reset();
  look(o);
  missed_digs_ = stands_ = 0;
  region_ = DigRegion{};
  scanners_.begin_full_sweep();
}

// The machine stands elsewhere: what was known of the ground holds no more, but where the face was dug to, and what is in the truck.
void Sequencer::begin_anew(const Observation& o) {
  log_.event("moved", {{"time_s", o.time_s}, {"truck", truck_}, {"distance_m", back_m_}});
  presence_.begin();  // the truck made way, and comes back
  expect_another_truck();
  DigGround before = DigGround(site_, ground_, back_m_);
  forget_bed();
  cut_.reset();
  forget_surroundings(o);
  ground_ = std::move(before);
  poor_passes_ = 0;
  face_yield_.clear();
  yield_ = 1.0;  // what was learned last was of loose soil at the foot of the old face
  loaded_here_kg_ = 0.0;
  slipped_ = false;
  after_survey_ = Stage::wait_truck;
  enter(Stage::survey, o);
}

// Whether this truck's load is in the books already, or will be.
bool Sequencer::truck_is_begun() const { return part_filled_ || digs_or_comes_to_dig() || stage_ == Stage::curl || stage_ == Stage::pass || stage_ == Stage::leave_bed; }

// The operator has reset a stop in which the base moved. Unlike after a bench move nobody knows by how far, so that not even where the face was dug to holds.
void Sequencer::note_slip(const Observation& o) {
  if (stage_ == Stage::exhausted || stage_ == Stage::finished) return;
  forget_surroundings(o);
  slipped_ = true;
}

// The face is the same, and so is the truck, if nobody has said that it left. Booked is only now: what mends a stop may have poured on from an open bucket.
void Sequencer::begin_anew_after_slip(const Observation& o) {
  slipped_ = false;
  part_filled_ = truck_is_begun();
  take_load_back(o);  // with the bed that it was poured into
  log_.event("base_moved", {{"time_s", o.time_s}, {"truck", truck_}, {"loaded_kg", part_filled_ ? fill_.loaded_kg() : 0.0}, {"brings_load", brings_load_}});
  const bool had_bed = bed_slipped_ || site_.bed;
  forget_bed();
  bed_slipped_ = had_bed;
  cut_.reset();
  skyline_.reset();
  ahead_.reset();
  look(o);
  if (stage_ == Stage::raise_for_move) {  // after the move all is begun anew once more
    go_on_with_script(o);
    return;
  }
  const bool full_stands = stage_ == Stage::horn || stage_ == Stage::wait_leave || (stage_ == Stage::survey && after_survey_ == Stage::wait_leave);
  after_survey_ = full_stands ? Stage::wait_leave : Stage::wait_truck;
  enter_phase(BERM_PHASE_WAIT, o);
  raise_to_wait(o, o.angle[swing]);  // when all has been seen
  enter(Stage::survey, o);
}

}  // namespace berm::app
