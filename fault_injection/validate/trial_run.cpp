#include "validate/trial_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "plant/machine/kinematics.hpp"
#include "plant/machine/machine_controller.hpp"
#include "plant/machine/pan_servo.hpp"
#include "plant/machine/state_frames.hpp"
#include "plant/oracle/oracle.hpp"
#include "validate/commander.hpp"
#include "validate/seen_space.hpp"
#include "validate/supervisor.hpp"

namespace berm::validate {

namespace {

constexpr double cycle_s = 0.01;
constexpr double longest_survey_s = 15.0, longest_motion_s = 30.0, stopped_for_s = 1.5;
constexpr double still = 0.004;           // rad/s
constexpr double needless_beyond_m = 0.25;
constexpr double far_away_m = 60.0;
constexpr std::uint64_t note_every = 10;  // cycles
constexpr double seen_before_s = 0.5;     // what is seen later than this before the implements come is no help: they could not stand by then

struct PathPoint {
  double t;
  std::array<double, 4> joints;
};

// What is seen through is the beams' true way; a spurious return beyond the obstacle would have looked through it.
plant::WorldConfig without_noise(plant::WorldConfig world) {
  world.scanner.range_stddev = world.scanner.outlier_probability = world.scanner.dropout_probability = world.scanner.dust_probability = 0.0;
  return world;
}

// Machine, world, commander and whoever supervises, in one loop of virtual time: the plant's own parts, in the order of its process.
class Loop {
 public:
  // seen: takes what the scanners look through, or null. path: the joints' angles every 0.1 s of the swing, or null.
  Loop(const Bench& bench, const Trial& trial, std::unique_ptr<Supervisor> supervisor, SeenSpace* seen = nullptr, std::vector<PathPoint>* path = nullptr)
      : trial_(trial), scans_(supervisor->needs_scans() || seen != nullptr), seen_(seen), path_(path), supervisor_(std::move(supervisor)),
        world_(seen == nullptr ? world_of(trial) : without_noise(world_of(trial)), bench.profile.shape, seed_of(trial), 0),
        dynamics_(bench.profile.dynamics, bench.profile.shape, seed_of(trial), {trial.from, {}}), controller_(bench.profile), frames_(bench.profile, seed_of(trial)),
        servo_{plant::PanServo(bench.profile.shape.scanner[0]), plant::PanServo(bench.profile.shape.scanner[1])},
        commander_(bench.machine, trial, std::max(plant::reach(bench.profile.shape, {trial.from, {}}), plant::reach(bench.profile.shape, {trial.to, {}})), scans_) {}

  Motion run(std::FILE* trace) {
    Motion motion;
    motion.closest_m = motion.ground_gap_m = 1e9;
    double began_s = 0.0, still_s = 0.0;
    const double end_s = longest_survey_s + longest_motion_s;
    for (double t = cycle_s; t < end_s; t = static_cast<double>(++cycle_) * cycle_s) {
      advance(t);
      const berm_state& state = supervisor_->state();
      judge(t, motion);
      if (trace != nullptr) write_row(trace, t);
      if (motion.contact) break;
      if (!motion.began) {
        motion.began = commander_.swinging();
        began_s = t;
        if (motion.began || t <= longest_survey_s) continue;
        motion.stop_reason = state.stop_reason;
        break;
      }
      if (path_ != nullptr && cycle_ % note_every == 0) path_->push_back({t, dynamics_.state().angle});
      motion.seconds = t - began_s;
      if (motion.seconds > longest_motion_s) break;
      if (state.kernel_state != BERM_STATE_RUN && !motion.stopped) {
        motion.stopped = true;
        motion.stop_reason = state.stop_reason;
      }
      for (int j = 0; j < 4; ++j) motion.governed = motion.governed || std::abs(state.commanded_urad_s[j]) + 1000 < std::abs(asked_.joint_velocity_urad_s[j]);
      if (commander_.arrived(state)) {
        motion.arrived = true;
        break;
      }
      const auto& speed = dynamics_.state().velocity;
      const bool rests = std::all_of(speed.begin(), speed.end(), [](double v) { return std::fabs(v) < still; });
      still_s = rests && state.kernel_state != BERM_STATE_RUN ? still_s + cycle_s : 0.0;
      if (still_s > stopped_for_s) break;
    }
    return motion;
  }

 private:
  static std::uint64_t seed_of(const Trial& trial) { return trial.seed * 1000003U + static_cast<std::uint64_t>(trial.run); }

  void advance(double t) {
    now_ = t - cycle_s;
    controller_.decide(now_, resting_);
    const plant::JointState before = dynamics_.state();
    const plant::PanState pan_before = pan_;
    dynamics_.step(cycle_s, controller_.drive(), controller_.command(), plant::DigForces{}, trial_.payload_kg);
    for (std::size_t i = 0; i < servo_.size(); ++i) {
      const plant::PanGoal goal = controller_.pan(i, now_, servo_[i].angle());
      servo_[i].step(cycle_s, goal.goal, goal.rate);
      pan_.angle[i] = servo_[i].angle();
      pan_.velocity[i] = servo_[i].velocity();
    }
    world_.step(t, cycle_s, dynamics_.state(), before);
    Arrived arrived;
    if (scans_) world_.scan(t, cycle_s, before, dynamics_.state(), pan_before, pan_, arrived.scans);
    if (seen_ != nullptr)
      for (const auto& packet : arrived.scans) seen_->take(packet, t, dynamics_.state());
    if (supervisor_->needs_scans()) world_.scan_lidars(t, cycle_s, before, dynamics_.state(), arrived.lidars);
    const auto& speed = dynamics_.state().velocity;
    resting_ = std::all_of(speed.begin(), speed.end(), [](double v) { return std::fabs(v) < still; });

    plant::MachineSnapshot snapshot;
    snapshot.joints = dynamics_.state();
    snapshot.payload_kg = trial_.payload_kg;
    snapshot.pilot_unlocked = controller_.pilot_unlocked();
    snapshot.panel.run = true;
    const bool has_request = cycle_ > 1;
    if (has_request) asked_ = commander_.answer(supervisor_->state());
    arrived.frames = frames_.frames(cycle_, snapshot);
    for (const auto& frame : supervisor_->step(cycle_, arrived, has_request ? &asked_ : nullptr)) controller_.receive(frame, t);
  }

  void judge(double t, Motion& motion) {
    const plant::OracleVerdict verdict = world_.judge(t, dynamics_.state());
    motion.closest_m = std::min(motion.closest_m, verdict.closest_m);
    motion.ground_gap_m = std::min(motion.ground_gap_m, verdict.ground_gap_m);
    if (verdict.contact && !motion.contact) motion.touched = verdict.what + (verdict.by_upper_body ? ", with the upper body" : "");
    motion.contact = motion.contact || verdict.contact;
  }

  void write_row(std::FILE* trace, double t) {
    const berm_state& s = supervisor_->state();
    const plant::JointState& q = dynamics_.state();
    fmt::print(trace, "{:.2f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{},{},{},{},{},{},{}", t, q.angle[0], q.angle[1], q.angle[2], q.angle[3], q.velocity[0], asked_.joint_velocity_urad_s[0],
               s.commanded_urad_s[0], s.kernel_state, s.stop_reason, s.blocked_x_mm, s.blocked_y_mm, s.blocked_height_mm);
    for (int j = 0; j < 4; ++j) fmt::print(trace, ",{},{}", s.reach_low_urad[j], s.reach_high_urad[j]);
    fmt::print(trace, "\n");
  }

  const Trial& trial_;
  bool scans_;
  SeenSpace* seen_;
  std::vector<PathPoint>* path_;
  std::unique_ptr<Supervisor> supervisor_;
  plant::World world_;
  plant::JointDynamics dynamics_;
  plant::MachineController controller_;
  plant::StateFrames frames_;
  std::array<plant::PanServo, 2> servo_;
  Commander commander_;
  plant::PanState pan_;
  berm_request asked_{};
  std::uint64_t cycle_ = 1;
  double now_ = 0.0;
  bool resting_ = true;
};

plant::oracle::Body column_of(const SeenSpace::Hidden& hidden) {
  constexpr double half = 0.5 * SeenSpace::side;
  return plant::oracle::body_of({"hidden", hidden.x, hidden.y, 0.0, 0.0, {-half, -half, 0.0}, {half, half, hidden.top}});
}

// Whether some implement comes within reach of a column of space that was hidden until shortly before.
bool passes(const plant::ImplementShape& shape, const std::vector<PathPoint>& path, const SeenSpace& seen, const SeenSpace& without, double reach_m) {
  const plant::oracle::Oracle oracle(shape);
  for (const auto& point : path) {
    const auto machine = oracle.machine(point.joints);
    for (const auto& h : seen.hidden_against(without, point.t - seen_before_s)) {
      const plant::oracle::Body column = column_of(h);
      const auto near = [&](const plant::oracle::Body& part) {
        return (column.middle - part.middle).norm() <= column.reach + part.reach + reach_m && plant::oracle::distance(part, column).upper <= reach_m;
      };
      const auto implements_end = machine.begin() + static_cast<std::ptrdiff_t>(shape.parts.size());  // the upper body comes after them
      if (std::any_of(machine.begin(), implements_end, near)) return true;
    }
  }
  return false;
}

// The nominal motion once more, scanning as with the kernel, with the obstacle and without it.
bool past_hidden(const Bench& bench, const Trial& trial, double reach_m) {
  SeenSpace seen(bench.profile.shape), seen_without(bench.profile.shape);
  std::vector<PathPoint> path;
  Loop(bench, trial, make_obedient(), &seen, &path).run(nullptr);
  Trial without = trial;
  without.obstacle.x = without.obstacle.y = far_away_m;
  Loop(bench, without, make_obedient(), &seen_without).run(nullptr);
  return passes(bench.profile.shape, path, seen, seen_without, reach_m);
}

void judge(const Bench& bench, TrialResult& result) {
  const Motion &kernel = result.kernel, &nominal = result.nominal;
  const double kept = std::min(nominal.closest_m, nominal.ground_gap_m), margin = bench.parameters.margin_mm * 1e-3;
  if (kernel.contact) {
    result.outcome = Outcome::miss;
    result.why = "touched: " + kernel.touched;
  } else if (!kernel.arrived && nominal.arrived && !nominal.contact && kept > margin + needless_beyond_m) {
    result.outcome = Outcome::needless_stop;
    result.why = !kernel.began ? fmt::format("never began, reason {}", kernel.stop_reason)
                               : fmt::format("{}, reason {}; the nominal motion keeps {:.2f} m", kernel.stopped ? "stopped" : "did not arrive", kernel.stop_reason, kept);
  } else if (kernel.stopped && nominal.arrived && !nominal.contact && kept > margin + needless_beyond_m) {
    result.outcome = Outcome::needless_stop;
    result.why = fmt::format("stopped on the way, reason {}; the nominal motion keeps {:.2f} m", kernel.stop_reason, kept);
  }
  result.past_hidden = result.outcome == Outcome::needless_stop && past_hidden(bench, result.trial, margin + needless_beyond_m);
  if (result.past_hidden) result.why += "; it passes space that the obstacle hid";
  if (kernel.arrived && nominal.arrived) result.time_lost_s = kernel.seconds - nominal.seconds;
}

}  // namespace

TrialResult run_trial(const Bench& bench, const Trial& trial, const std::string& trace) {
  TrialResult result;
  result.trial = trial;
  std::FILE* file = nullptr;
  if (!trace.empty()) {
    file = std::fopen(trace.c_str(), "we");
    if (file == nullptr) throw std::runtime_error("cannot write " + trace);
    fmt::print(file, "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,swing_rad_s,asked_urad_s,commanded_urad_s,kernel_state,stop_reason,blocked_x_mm,blocked_y_mm,blocked_height_mm,"
                     "reach_low_swing_urad,reach_high_swing_urad,reach_low_boom_urad,reach_high_boom_urad,reach_low_stick_urad,reach_high_stick_urad,"
                     "reach_low_bucket_urad,reach_high_bucket_urad\n");
  }
  result.kernel = Loop(bench, trial, make_kernel(bench.parameters)).run(file);
  if (file != nullptr && std::fclose(file) != 0) throw std::runtime_error("cannot write " + trace);
  result.nominal = Loop(bench, trial, make_obedient()).run(nullptr);
  judge(bench, result);
  return result;
}

}  // namespace berm::validate
