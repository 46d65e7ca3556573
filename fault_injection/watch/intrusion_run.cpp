#include "watch/intrusion_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "config/compile_parameters.hpp"
#include "config/whole_file.hpp"
#include "in_process/machine_loop.hpp"
#include "io/cycle.hpp"
#include "watch/swept_reach.hpp"

namespace berm::watch {

namespace {

constexpr double longest_learning_s = 120.0;
constexpr double not_yet_s = 1e9;
constexpr double stays_s = 15.0;             // at the end of its way
constexpr double a_pass_s = 20.0;            // who stands there when the machine goes over to its full speed meets a whole one
constexpr double after_it_left_s = 4.0;      // longer than the monitor lets what it saw wait
constexpr double after_standstill_s = 1.0;
constexpr double long_enough_inside_s = 1.0;
constexpr double beyond_reach_m = 3.0, far_away_m = 1e3;
constexpr std::uint64_t judge_reach_every = 5;  // cycles

constexpr const char* trace_header =
    "time_s,swing_rad,boom_rad,stick_rad,bucket_rad,swing_rad_s,kernel_state,stop_reason,blocked_x_mm,blocked_y_mm,present,x_m,y_m,in_region,"
    "implements_m,returns,"
    "pan_left_urad,pan_right_urad,passes\n";

bool still(const plant::JointState& joints) {
  return std::all_of(joints.velocity.begin(), joints.velocity.end(), [](double v) { return std::fabs(v) < standstill_rad_s; });
}

// Of a cycle without fresh joint angles the kernel publishes none.
ReachBox box_of(const berm_state& state, const std::array<double, 4>& joints) {
  ReachBox box{joints, joints};
  if (std::equal(state.reach_low_urad, state.reach_low_urad + 4, state.reach_high_urad)) return box;
  for (std::size_t j = 0; j < 4; ++j) {
    box.low[j] = state.reach_low_urad[j] * 1e-6;
    box.high[j] = state.reach_high_urad[j] * 1e-6;
  }
  return box;
}

plant::WorldConfig with_nobody(plant::WorldConfig world) {
  plant::MoverConfig nobody;
  nobody.appears_s = nobody.start_s = not_yet_s;
  world.movers = {nobody};
  return world;
}

berm_parameters parameters_of(const Bench& bench, bool follows) {
  config::MachineFile machine = bench.machine;
  machine.workspace.follows = follows;
  return config::compile_parameters(machine, bench.site);
}

// Of trials that share one, and of no others.
std::uint64_t noise_of(std::uint64_t seed, int number, bool follows) {
  return seed * 1000003U + 2U * static_cast<std::uint64_t>(number) + (follows ? 1U : 0U);
}

}  // namespace

class Preparation::Work {
 public:
  Work(const Bench& bench, std::uint64_t seed, int number, bool follows, std::string* trace)
      : bench_(bench), trace_(trace), motion_(bench.machine, bench.place), reach_(bench.profile.shape), watch_({""}),
        machine_(bench.profile, with_nobody(bench.world), noise_of(seed, number, follows), {first_pose(bench.place), 0.0, 1, true},
                 in_process::make_kernel(parameters_of(bench, follows))) {}

  bool wait(const Intrusion& intrusion) {
    const bool learned = intrusion.when == When::learned;
    while (learned && !motion_.learned() && machine_.time_s() < longest_learning_s && watch_.alarms().empty()) step();
    if (learned && !motion_.learned()) return false;
    if (learned && !learned_s_) learned_s_ = machine_.time_s();
    const double appears_s = (learned ? *learned_s_ : 0.0) + intrusion.waits_s;
    while (machine_.time_s() < appears_s && watch_.alarms().empty()) step();
    return watch_.alarms().empty();
  }

  IntrusionResult play(const Intrusion& intrusion) {
    result_.intrusion = intrusion;
    if (wait(intrusion)) {
      shape_ = intrusion.mover;
      watch_.rename(0, shape_.name);
      machine_.world().draw_sensors_anew(draw_of(intrusion));
      machine_.world().send_mover(0, shape_, machine_.time_s() + in_process::MachineLoop::cycle_s);
      result_.appeared_s = machine_.time_s();
      while (!over()) step();
    }
    result_.record = watch_.records().front();
    result_.alarms = watch_.alarms();
    result_.false_alarms = watch_.false_alarms();
    result_.ended_s = machine_.time_s();
    judge_outcome();
    return result_;
  }

 private:
  static std::uint64_t draw_of(const Intrusion& i) { return ~(i.seed * 1000003U + static_cast<std::uint64_t>(i.run)); }

  void step() {
    machine_.advance([this](const berm_state& state) { return motion_.answer(state); });
    const plant::MoverPose pose = machine_.world().movers().back();
    const bool present = machine_.world().mover_present(0);
    const plant::oracle::Body body = body_of(shape_, pose);
    const double implements_m = present ? reach_.distance(machine_.joints().angle, body) : far_away_m;
    const berm_state& state = machine_.state();
    const auto& workspace = machine_.supervisor().cycle()->workspace();
    const bool stands = still(machine_.joints());
    const Region region{&workspace.rules(), &workspace.space()};
    watch_.step({machine_.time_s(), state.kernel_state, state.stop_reason, state.blocked_x_mm * 1e-3, state.blocked_y_mm * 1e-3,
                 state.blocked_height_mm * 1e-3, stands, monitors_of(workspace), region},
                {{present, footprint_of(shape_, pose.x, pose.y, pose.yaw), implements_m}});
    if (present) judge_danger(state, body, implements_m, stands);
    if (present) note_seen(region);
    if ((state.sight & BERM_SIGHT_LEARNS) != 0) heights_learned_s_ = machine_.time_s();
    if (watch_.records().front().detected_s && !result_.truck_distance_m)
      result_.truck_distance_m =
          std::max(0.0, distance_from_truck(bench_.intrusion_site.truck, pose.x, pose.y) - outer_radius(footprint_of(shape_, pose.x, pose.y, 0.0)));
    if (trace_ != nullptr) write_row(pose, present, implements_m);
  }

  void judge_danger(const berm_state& state, const plant::oracle::Body& body, double implements_m, bool stands) {
    if (stands) return;
    const double t = machine_.time_s();
    result_.closest_m = std::min(result_.closest_m, implements_m);
    if (implements_m <= 0.0 && !result_.contact_s) result_.contact_s = t;
    if (result_.unsafe_s) return;
    const bool near = std::hypot(body.middle.x(), body.middle.y()) < bench_.intrusion_site.implements_reach + beyond_reach_m;
    const bool due = near && machine_.cycle() % judge_reach_every == 0;
    if (implements_m <= 0.0 || (due && reach_.holds(box_of(state, machine_.joints().angle), body))) result_.unsafe_s = t;
  }

  void note_seen(const Region& region) {
    if (result_.seen_s) return;
    for (const auto& met : machine_.world().mover_returns())
      if (watched_at(region, met.x, met.y)) result_.seen_s = machine_.time_s();
  }

  bool over() const {
    const double t = machine_.time_s(), walked_s = *result_.appeared_s + way_time(shape_);
    const IntruderRecord& r = watch_.records().front();
    if (result_.contact_s) return true;
    if (r.detected_s && r.standstill_s && t > std::max(*r.standstill_s, *r.detected_s) + after_standstill_s) return true;
    if (!r.inside) return t > walked_s + after_it_left_s;
    return t > std::max(walked_s + stays_s, heights_learned_s_ + a_pass_s);
  }

  void judge_outcome() {
    const IntruderRecord& r = result_.record;
    if (!result_.appeared_s) {
      result_.outcome = watch_.alarms().empty() ? Outcome::not_judged : Outcome::false_alarm;
    } else if (!r.entered_s || (r.stood_at_entry && !result_.failed())) {
      result_.outcome = Outcome::not_judged;
    } else if (r.detected_s) {
      result_.outcome = Outcome::detected;
    } else if (r.stopped_s) {
      result_.outcome = Outcome::stopped;
    } else {
      result_.outcome = r.inside_s < long_enough_inside_s ? Outcome::brief : Outcome::undetected;
    }
  }

  void write_row(const plant::MoverPose& pose, bool present, double implements_m) {
    const berm_state& s = machine_.state();
    const auto& q = machine_.joints();
    const IntruderRecord& r = watch_.records().front();
    fmt::format_to(std::back_inserter(*trace_), "{:.2f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{},{},{},{},{},{:.4f},{:.4f},{},{:.4f},{},{},{},{}\n", machine_.time_s(),
               q.angle[0], q.angle[1], q.angle[2], q.angle[3], q.velocity[0], s.kernel_state, s.stop_reason, s.blocked_x_mm, s.blocked_y_mm,
               present ? 1 : 0, pose.x, pose.y, r.inside ? 1 : 0, implements_m, machine_.world().mover_returns().size(), s.pan_angle_urad[0],
               s.pan_angle_urad[1], motion_.cycles());
  }

  const Bench& bench_;
  plant::MoverConfig shape_;
  std::string* trace_;
  std::optional<double> learned_s_;
  double heights_learned_s_ = 0.0;         // the last cycle in which they were still learned
  LoadingMotion motion_;
  SweptReach reach_;
  IntruderWatch watch_;
  in_process::MachineLoop machine_;
  IntrusionResult result_;
};

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::detected: return "detected";
    case Outcome::stopped: return "stopped";
    case Outcome::brief: return "brief";
    case Outcome::undetected: return "undetected";
    case Outcome::false_alarm: return "false_alarm";
    default: return "not_judged";
  }
}

Preparation::Preparation(const Bench& bench, std::uint64_t seed, int number, bool follows, std::string* trace)
    : work_(std::make_unique<Work>(bench, seed, number, follows, trace)) {}

Preparation::~Preparation() = default;
bool Preparation::wait(const Intrusion& intrusion) { return work_->wait(intrusion); }
IntrusionResult Preparation::play(const Intrusion& intrusion) { return work_->play(intrusion); }

IntrusionResult run_intrusion(const Bench& bench, const Intrusion& intrusion, const std::string& trace) {
  std::string rows{trace_header};
  IntrusionResult result = Preparation(bench, intrusion.seed, preparation_of(intrusion.run), intrusion.follows, trace.empty() ? nullptr : &rows).play(intrusion);
  if (!trace.empty()) config::write_whole_file(trace, rows);
  return result;
}

}  // namespace berm::watch
