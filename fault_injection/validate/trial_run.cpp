#include "validate/trial_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "config/whole_file.hpp"
#include "in_process/machine_loop.hpp"
#include "plant/machine/kinematics.hpp"
#include "plant/oracle/oracle.hpp"
#include "validate/commander.hpp"
#include "validate/seen_space.hpp"

namespace berm::validate {

namespace {

using in_process::make_kernel;
using in_process::make_obedient;
using in_process::Supervisor;

constexpr double cycle_s = 0.01;
constexpr double longest_survey_s = 15.0, longest_motion_s = 30.0, stopped_for_s = 1.5;
constexpr double still = 0.004;           // rad/s
constexpr double needless_beyond_m = 0.25;
constexpr double far_away_m = 60.0;
constexpr std::uint64_t note_every = 10;  // cycles
constexpr double seen_before_s = 0.5;     // what is seen later than this before the implements come is no help: they could not stand by then

constexpr const char* trace_header =
    "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,swing_rad_s,asked_urad_s,commanded_urad_s,kernel_state,stop_reason,blocked_x_mm,blocked_y_mm,blocked_height_mm,"
    "reach_low_swing_urad,reach_high_swing_urad,reach_low_boom_urad,reach_high_boom_urad,reach_low_stick_urad,reach_high_stick_urad,"
    "reach_low_bucket_urad,reach_high_bucket_urad\n";

struct PathPoint {
  double t;
  std::array<double, 4> joints;
};

// What is seen through is the beams' true way; a spurious return beyond the obstacle would have looked through it.
plant::WorldConfig without_noise(plant::WorldConfig world) {
  world.scanner.range_stddev = world.scanner.outlier_probability = world.scanner.dropout_probability = world.scanner.dust_probability = 0.0;
  return world;
}

// One motion, with whoever supervises.
class Loop {
 public:
  // seen: takes what the scanners look through, or null. path: the joints' angles every 0.1 s of the swing, or null.
  Loop(const Bench& bench, const Trial& trial, std::unique_ptr<Supervisor> supervisor, SeenSpace* seen = nullptr, std::vector<PathPoint>* path = nullptr)
      : seen_(seen), path_(path), looks_(supervisor->needs_scans() || seen != nullptr),
        machine_(bench.profile, seen == nullptr ? world_of(trial) : without_noise(world_of(trial)), seed_of(trial), {trial.from, trial.payload_kg, 0, looks_},
                 std::move(supervisor)),
        commander_(bench.machine, trial, std::max(plant::reach(bench.profile.shape, {trial.from, {}}), plant::reach(bench.profile.shape, {trial.to, {}})), looks_) {}

  Motion run(std::string* trace) {
    Motion motion;
    motion.closest_m = motion.ground_gap_m = 1e9;
    double began_s = 0.0, still_s = 0.0;
    const double end_s = longest_survey_s + longest_motion_s;
    for (double t = cycle_s; t < end_s; t = static_cast<double>(machine_.cycle() + 1) * cycle_s) {
      advance();
      const berm_state& state = machine_.state();
      judge(t, motion);
      if (trace != nullptr) write_row(*trace, t);
      if (motion.contact) break;
      if (!motion.began) {
        motion.began = commander_.swinging();
        began_s = t;
        if (motion.began || t <= longest_survey_s) continue;
        motion.stop_reason = state.stop_reason;
        break;
      }
      if (path_ != nullptr && machine_.cycle() % note_every == 0) path_->push_back({t, machine_.joints().angle});
      motion.seconds = t - began_s;
      if (motion.seconds > longest_motion_s) break;
      if (state.kernel_state != BERM_STATE_RUN && !motion.stopped) {
        motion.stopped = true;
        motion.stop_reason = state.stop_reason;
      }
      for (int j = 0; j < 4; ++j) motion.governed = motion.governed || std::abs(state.commanded_urad_s[j]) + 1000 < std::abs(machine_.asked().joint_velocity_urad_s[j]);
      if (commander_.arrived(state)) {
        motion.arrived = true;
        break;
      }
      const auto& speed = machine_.joints().velocity;
      const bool rests = std::all_of(speed.begin(), speed.end(), [](double v) { return std::fabs(v) < still; });
      still_s = rests && state.kernel_state != BERM_STATE_RUN ? still_s + cycle_s : 0.0;
      if (still_s > stopped_for_s) break;
    }
    return motion;
  }

 private:
  static std::uint64_t seed_of(const Trial& trial) { return trial.seed * 1000003U + static_cast<std::uint64_t>(trial.run); }

  void advance() {
    machine_.advance([this](const berm_state& state) { return commander_.answer(state); });
    if (seen_ == nullptr) return;
    for (const auto& packet : machine_.scans()) seen_->take(packet, machine_.time_s(), machine_.joints());
  }

  void judge(double t, Motion& motion) {
    const plant::OracleVerdict verdict = machine_.world().judge(t, machine_.joints());
    motion.closest_m = std::min(motion.closest_m, verdict.closest_m);
    motion.ground_gap_m = std::min(motion.ground_gap_m, verdict.ground_gap_m);
    if (verdict.contact && !motion.contact) motion.touched = verdict.what + (verdict.by_upper_body ? ", with the upper body" : "");
    motion.contact = motion.contact || verdict.contact;
  }

  void write_row(std::string& trace, double t) {
    const auto out = std::back_inserter(trace);
    const berm_state& s = machine_.state();
    const plant::JointState& q = machine_.joints();
    fmt::format_to(out, "{:.2f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{},{},{},{},{},{},{}", t, q.angle[0], q.angle[1], q.angle[2], q.angle[3], q.velocity[0], machine_.asked().joint_velocity_urad_s[0],
               s.commanded_urad_s[0], s.kernel_state, s.stop_reason, s.blocked_x_mm, s.blocked_y_mm, s.blocked_height_mm);
    for (int j = 0; j < 4; ++j) fmt::format_to(out, ",{},{}", s.reach_low_urad[j], s.reach_high_urad[j]);
    fmt::format_to(out, "\n");
  }

  SeenSpace* seen_;
  std::vector<PathPoint>* path_;
  bool looks_;
  in_process::MachineLoop machine_;
  Commander commander_;
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
  std::string rows{trace_header};
  result.kernel = Loop(bench, trial, make_kernel(bench.parameters)).run(trace.empty() ? nullptr : &rows);
  if (!trace.empty()) config::write_whole_file(trace, rows);
  result.nominal = Loop(bench, trial, make_obedient()).run(nullptr);
  judge(bench, result);
  return result;
}

}  // namespace berm::validate
