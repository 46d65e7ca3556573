#include "plant/process/plant_run.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "contract/berm_contract.h"
#include "plant/machine/kinematics.hpp"
#include "plant/machine/strict_table.hpp"
#include "plant/world/spinning_lidar.hpp"

namespace berm::plant {

namespace {

constexpr double kStandstillSpeed = radians(0.5);
constexpr int kStandstillCycles = 20;
constexpr double kFarthestClearance = 100.0;  // m, in the trace
constexpr double kAfterFinish = 1.0;  // s
constexpr double kLooksBeforeRun_s = 0.2;  // four frames of the panel
constexpr double kBesideReach = 2.0;  // m beyond the implements: nobody may be nearer when they are moved by hand
constexpr const char* kJointNames[] = {"swing", "boom", "stick", "bucket"};

const std::string& made_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw ConfigError(fmt::format("--out {}: {}", path, error.message()));
  return path;
}

can::Transport& opened(can::Transport& bus, const std::string& address) {
  const std::string refused = bus.open(address);
  if (!refused.empty()) throw ConfigError("--can " + refused);
  return bus;
}

const char* state_name(PeerState state) {
  if (state == PeerState::gone) return "gone";
  return state == PeerState::absent ? "absent" : "back";
}

bool lost(PeerState state) { return state == PeerState::gone || state == PeerState::absent; }

// Sleeps until the next multiple of the cycle on the monotonic clock.
void sleep_to(timespec& next) {
  next.tv_nsec += 10'000'000;
  if (next.tv_nsec >= 1'000'000'000) {
    next.tv_nsec -= 1'000'000'000;
    ++next.tv_sec;
  }
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr) != 0) {
  }
}

}  // namespace

PlantRun::PlantRun(const Scenario& scenario, const PlantProfile& profile, const RunOptions& options)
    : scenario_(scenario), profile_(profile), options_(options), scans_(options.scan_port),
      world_(scenario.world, profile_.shape, options.seed, options.trucks), dynamics_(profile.dynamics, profile.shape, options.seed, scenario.start),
      controller_(profile), base_(scenario.base_motions), operator_(scenario.operator_config ? std::optional<Operator>(std::in_place, *scenario.operator_config, options.seed) : std::nullopt), hand_lift_(profile), frames_(profile, options.seed), servo_{PanServo(profile.shape.scanner[0]), PanServo(profile.shape.scanner[1])},
      peers_(opened(bus_, options.can_address), options.peers, [this](const berm_can_frame& frame) { controller_.receive(frame, now_); }),
      trace_(made_folder(options.out) + "/trace.csv", world_.movers(), scenario.operator_config.has_value()), kernel_seen_(peers_.kernel()), app_seen_(peers_.app()) {
  if (options.lidar_port.size() != profile.shape.lidar.size())
    throw ConfigError(fmt::format("--lidar-port: given {} times, {} has {} lidars", options.lidar_port.size(), scenario.machine_file, profile.shape.lidar.size()));
  for (const std::uint16_t port : options.lidar_port) lidars_.push_back(std::make_unique<ScanSender>(port));
  if (lidars_.size() > 1 && std::thread::hardware_concurrency() > 1) side_.emplace();
}

void PlantRun::break_machine() {
  constexpr double kRounding = 1e-6;  // times are multiples of the cycle in floating point
  const auto comes_now = [this](double at_s) { return now_ + kRounding >= at_s && now_ + kRounding < at_s + kCycle; };
  for (const MachineFault& fault : scenario_.machine_fault) {
    const bool breaks = comes_now(fault.at_s), mended = fault.for_s && comes_now(fault.at_s + *fault.for_s);
    if (!breaks && !mended) continue;
    if (breaks) dynamics_.break_joint(fault);
    else dynamics_.mend_joint(fault);
    if (fault.kind == MachineFaultKind::stuck_angle) frames_.stick_angle(fault.joint, breaks);
    if (fault.kind == MachineFaultKind::own_error) frames_.report_error(breaks);
  }
}

void PlantRun::advance(double t) {
  break_machine();
  controller_.decide(now_, standing_cycles_ > 0);
  const JointState before = dynamics_.state();
  const PanState pan_before = pan_;
  dynamics_.step(kCycle, controller_.drive(), controller_.command(), soil_, world_.payload_kg());
  for (std::size_t i = 0; i < servo_.size(); ++i) {
    const PanGoal goal = controller_.pan(i, now_, servo_[i].angle());
    servo_[i].step(kCycle, goal.goal, goal.rate);
    pan_.angle[i] = servo_[i].angle();
    pan_.velocity[i] = servo_[i].velocity();
  }
  for (std::size_t j = 0; j < out_of_control_.size(); ++j) {
    if (!dynamics_.out_of_control(j) || out_of_control_[j]) continue;
    out_of_control_[j] = true;
    record_.fault(t, fmt::format("{} out of control", kJointNames[j]));
  }
  base_.step(t, dynamics_.state().angle[0]);
  if (base_.moving()) record_.fault(t, "base motion");
  attend(t);
  change_weather(t);
  world_.stand(base_pose());
  soil_ = world_.step(t, kCycle, dynamics_.state(), before);
  packets_.clear();
  lidar_packets_.clear();
  world_.sense(t, kCycle, before, dynamics_.state(), pan_before, pan_, packets_, lidar_packets_, side_ ? &*side_ : nullptr);
  scans_.send(packets_, epoch_us_);
  for (std::size_t i = 0; i < lidar_packets_.size();) {
    std::size_t next = i;
    while (next < lidar_packets_.size() && lidar_packets_[next].lidar == lidar_packets_[i].lidar) ++next;
    lidars_[lidar_packets_[i].lidar]->send({lidar_packets_.data() + i, next - i});
    i = next;
  }
  const auto& speed = dynamics_.state().velocity;
  const bool still = std::all_of(speed.begin(), speed.end(), [](double v) { return std::abs(v) < kStandstillSpeed; });
  standing_cycles_ = still ? standing_cycles_ + 1 : 0;
}

std::uint32_t PlantRun::datagrams() const {
  std::uint32_t sent = scans_.sent();
  for (const auto& lidar : lidars_) sent += lidar->sent();
  return sent;
}

// A move of the machine on its tracks, and what moves it against the operator's will.
BasePose PlantRun::base_pose() const {
  BasePose pose = base_.pose();
  if (!operator_) return pose;
  const BasePose& tram = operator_->base();
  pose.x += tram.x;
  pose.y += tram.y;
  pose.pitch += tram.pitch;
  return pose;
}

bool PlantRun::somebody_near() const {
  const std::vector<MoverPose> movers = world_.movers();
  const BasePose base = base_pose();
  const double near = reach(profile_.shape, dynamics_.state()) + kBesideReach;
  // Trucks come first, and stand where the spotter lets them.
  return std::any_of(movers.begin() + static_cast<std::ptrdiff_t>(std::min(movers.size(), world_.trucks())), movers.end(),
                     [&](const MoverPose& mover) { return std::hypot(mover.x - base.x, mover.y - base.y) < near; });
}

// The selector is at manual while the operator lifts, and the levers are all that the joints obey then.
void PlantRun::take_levers(double t) {
  if (operator_->hand_lifts().size() > lifts_told_) {
    ++lifts_told_;
    hand_lift_.begin(t);
    events_.hand_lift(t);
  }
  if (!operator_->lifts()) {
    controller_.select(std::nullopt);
    return;
  }
  hand_lift_.step(t, dynamics_.state(), somebody_near());
  controller_.select(hand_lift_.levers());
}

// Who starts the machine looks at the panel first: a run switch that was on before the kernel stood by would have to be switched off again.
void PlantRun::watch_start(double t) {
  if (may_start_ || !controller_.heartbeat_heard()) return;
  const int state = controller_.heartbeat().kernel_state;
  if (state != BERM_STATE_STANDBY) stands_by_s_ = -1.0;
  else if (stands_by_s_ < 0.0) stands_by_s_ = t;
  may_start_ = state == BERM_STATE_RUN || (stands_by_s_ >= 0.0 && t - stands_by_s_ >= kLooksBeforeRun_s);
}

PanelInput PlantRun::panel(double t) const {
  PanelInput keys = panel_at(scenario_, t);
  keys.run = keys.run && may_start_;
  return keys;
}

void PlantRun::attend(double t) {
  watch_start(t);
  const HornSignal signal = horn_.step(now_, controller_.horn());
  if (signal.what == HornSignal::What::truck_full && world_.truck_parked()) world_.release_truck(t);
  if (!operator_) return;
  Operator::Sees sees;
  sees.standing = standing_cycles_ >= kStandstillCycles;
  sees.truck_about = world_.truck_about();
  sees.panel = controller_.heartbeat_heard() ? &controller_.heartbeat() : nullptr;
  sees.base_yaw = base_.pose().yaw;
  sees.angle = dynamics_.state().angle;
  sees.implements_up = hand_lift_.done();
  sees.run_switch = panel(t).run;
  sees.dust = world_.dust(t);
  operator_->step(t, signal, sees);
  take_levers(t);
  if (operator_->wants_place()) world_.make_way(t);
  if (const BenchMove* move = operator_->moved()) {
    const double x = -move->distance_m * std::cos(sees.base_yaw), y = -move->distance_m * std::sin(sees.base_yaw);
    world_.machine_stands(t, x, y);
    events_.bench_move(t, move->distance_m, operator_->base().x);
  }
  for (; presses_told_ < operator_->presses().size(); ++presses_told_) {
    const Operator::Press& press = operator_->presses()[presses_told_];
    events_.press(t, press.reset ? "relearn and reset" : "relearn", press.reason);
  }
}

void PlantRun::change_weather(double t) {
  const std::vector<SoilChange>& changes = scenario_.world.soil_changes;
  for (; soil_changes_ < changes.size() && t >= changes[soil_changes_].at_s; ++soil_changes_) world_.change_soil(changes[soil_changes_]);
}

void PlantRun::send(double t) {
  MachineSnapshot snapshot;
  snapshot.joints = dynamics_.state();
  snapshot.base = base_pose();
  snapshot.payload_kg = world_.payload_kg();
  const auto& factor = soil_.resist_speed_factor;
  snapshot.digging = std::any_of(factor.begin(), factor.end(), [](double f) { return f < 1.0; });
  snapshot.edge = soil_.edge;
  snapshot.pilot_unlocked = controller_.pilot_unlocked();
  snapshot.panel = panel(t);
  if (operator_) {
    snapshot.panel.run = snapshot.panel.run && operator_->run();
    snapshot.panel.reset = snapshot.panel.reset || operator_->reset();
    snapshot.panel.relearn = snapshot.panel.relearn || operator_->relearn();
  }
  snapshot.truck_parked = world_.truck_parked();
  snapshot.truck_leaving = world_.truck_leaving();
  const bool stop = snapshot.panel.stop || snapshot.panel.emergency;
  if (stop && !panel_stop_) record_.fault(t, snapshot.panel.stop ? "operator stop" : "emergency stop");
  panel_stop_ = stop;
  std::vector<berm_can_frame> out = frames_.frames(cycle_, snapshot);
  if (!options_.realtime && !kernel_held_up(cycle_)) {
    const berm_sim_clock clock{static_cast<std::uint32_t>(cycle_), datagrams()};
    out.push_back(berm_encode_sim_clock(&clock));
  }
  bus_.send(out.data(), static_cast<int>(out.size()));
}

// While kernel and app have this cycle's messages: what needs no answer of theirs, and what the lidars will see if the kernel lets the joints go on
// as they do, until it has answered.
void PlantRun::use_spare_time(double t) {
  verdict_ = world_.judge(t, dynamics_.state());
  if (options_.realtime || !side_ || kernel_held_up(cycle_)) return;
  JointDynamics next = dynamics_;
  next.step(kCycle, controller_.drive(), controller_.command(), soil_, world_.payload_kg());
  world_.foresee(time_of(cycle_ + 1), kCycle, dynamics_.state(), next.state(), [this] { return peers_.kernel_has_answered(cycle_); });
}

// Its computer does something else, and it begins no cycle: what is sent meanwhile waits for it, and neither it nor the app has anything to answer.
bool PlantRun::kernel_held_up(std::uint64_t cycle) const {
  constexpr double kRounding = 1e-6;
  const auto [from_s, for_s] = options_.pause_kernel_s;
  const double t = time_of(cycle) + kRounding;
  return t >= from_s && t < from_s + for_s;
}

// The app answers the newest cycle while the next is computed here: that needs the kernel's answer alone, and nothing of it is sent before.
void PlantRun::await_others() {
  if (cycle_ > 1 && !kernel_held_up(cycle_ - 1)) peers_.wait_for(cycle_ - 1, options_.stop_fd);
  note_finish();
}

void PlantRun::note_finish() {
  if (peers_.app_finished() && finished_at_ < 0.0) finished_at_ = now_;
}

void PlantRun::observe_trucks(double t) {
  const bool parked = world_.truck_parked(), leaving = world_.truck_leaving() && !world_.truck_makes_way();
  if (world_.truck_makes_way()) comes_back_ = true;
  const auto load = [&](const Truth& truth) {
    const auto i = static_cast<std::size_t>(std::max(truck_ - 1, 0));
    return i < truth.truck_load_kg.size() ? truth.truck_load_kg[i] : 0.0;
  };
  if (parked && !parked_) {
    if (!comes_back_) ++truck_;
    comes_back_ = false;
    events_.truck("truck_arrived", t, truck_, load(world_.truth()));
  }
  if (leaving && !leaving_) {
    const Truth truth = world_.truth();
    record_.truck_left(t, truth);
    events_.truck("truck_left", t, truck_, load(truth));
  }
  parked_ = parked;
  leaving_ = leaving;
}

void PlantRun::observe_peers(double t) {
  const auto look = [&](const char* who, PeerState now, PeerState& seen) {
    if (now == seen) return;
    seen = now;
    events_.peer(t, who, state_name(now));
    if (lost(now)) record_.fault(t, fmt::format("{} {}", who, state_name(now)));
  };
  look("kernel", peers_.kernel(), kernel_seen_);
  look("app", peers_.app(), app_seen_);
}

void PlantRun::observe(double t) {
  observe_peers(t);
  observe_trucks(t);
  if (record_.judge(t, verdict_)) events_.contact(t, verdict_.what);
  record_.standstill(t, standing_cycles_ >= kStandstillCycles);
  if (cycle_ % static_cast<std::uint64_t>(options_.trace_every) == 0)
    trace_.row(t, dynamics_.state(), controller_.heartbeat(), world_.soil_masses(), std::min(verdict_.closest_m, kFarthestClearance), world_.movers(), base_pose());
  if (cycle_ % 100 == 0) events_.time(t);
}

bool PlantRun::stop_asked() const {
  if (options_.stop_fd < 0) return false;
  pollfd p{options_.stop_fd, POLLIN, 0};
  return poll(&p, 1, 0) > 0;
}

std::string PlantRun::end_reason(double t) {
  constexpr double kRounding = 1e-6;
  if (stop_asked()) return "terminated";
  note_finish();
  if (finished_at_ >= 0.0 && t - finished_at_ + kRounding >= kAfterFinish) return "finished";
  const bool alone = finished_at_ < 0.0 && (lost(peers_.kernel()) || lost(peers_.app())) && standing_cycles_ >= kStandstillCycles;
  if (!alone) alone_since_ = -1.0;
  if (alone && alone_since_ < 0.0) alone_since_ = t;
  if (alone && t - alone_since_ + kRounding >= options_.alone_s) {
    const bool kernel = lost(peers_.kernel());
    return fmt::format("{} {}", kernel ? "kernel" : "app", state_name(kernel ? peers_.kernel() : peers_.app()));
  }
  if (operator_ && operator_->refuses() && t - operator_->asked_s() >= kAfterFinish) return "bench ends";
  if (t + kRounding >= scenario_.max_time_s) return "time limit";
  return {};
}

void PlantRun::run() {
  world_.write_terrain(options_.out + "/terrain_start.csv");
  timespec next{};
  clock_gettime(CLOCK_MONOTONIC, &next);
  if (options_.realtime) epoch_us_ = static_cast<std::uint64_t>(next.tv_sec) * 1'000'000 + static_cast<std::uint64_t>(next.tv_nsec) / 1000;
  std::string reason;
  double t = 0.0;
  while (reason.empty()) {
    if (options_.realtime) sleep_to(next);
    ++cycle_;
    t = time_of(cycle_);
    if (options_.realtime) peers_.drain();
    advance(t);
    if (!options_.realtime) await_others();
    now_ = t;
    send(t);
    use_spare_time(t);
    if (!options_.realtime && !kernel_held_up(cycle_)) peers_.wait_for_kernel(cycle_, options_.stop_fd);
    observe(t);
    reason = end_reason(t);
  }
  if (!options_.realtime && !kernel_held_up(cycle_)) peers_.wait_for(cycle_, options_.stop_fd);  // what the app says last belongs to the run
  write_end(t, reason);
  events_.finished(t, reason);
}

void PlantRun::write_end(double t, const std::string& reason) {
  RunRecord::End end;
  end.scenario = scenario_.name;
  end.reason = reason;
  end.seed = options_.seed;
  end.time_s = t;
  end.target_kg = scenario_.world.trucks.front().target_kg;
  end.refused_frames = controller_.refused_frames();
  end.scan_packets = datagrams();
  end.truth = world_.truth();
  end.disturbances = disturbances(scenario_);
  if (operator_) {
    end.moves = operator_->moves();
    for (const BenchMove& move : end.moves) end.disturbances.push_back({"tram", move.from_s, move.to_s});
    end.hand_lifts = operator_->hand_lifts();
    for (const HandLiftTime& lift : end.hand_lifts) end.disturbances.push_back({"levers", lift.from_s, lift.to_s});
    for (const Operator::Press& press : operator_->presses()) end.presses.push_back(press);
  }
  trace_.finish();
  world_.write_terrain(options_.out + "/terrain_end.csv");
  record_.write(options_.out + "/truth.json", end);
}

}  // namespace berm::plant
