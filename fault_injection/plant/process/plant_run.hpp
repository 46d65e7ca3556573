// One run of the plant: the loop over cycles of 10 ms that moves machine and world, sends frames and scans, keeps step with the other
// processes, and writes what happened.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "can/can_transport.hpp"
#include "plant/machine/joint_dynamics.hpp"
#include "plant/machine/machine_controller.hpp"
#include "plant/machine/pan_servo.hpp"
#include "plant/machine/state_frames.hpp"
#include "plant/process/base_motion.hpp"
#include "plant/process/event_lines.hpp"
#include "plant/process/hand_lift.hpp"
#include "plant/process/horn_listener.hpp"
#include "plant/process/operator.hpp"
#include "plant/process/peers.hpp"
#include "plant/process/run_record.hpp"
#include "plant/process/scan_sender.hpp"
#include "plant/process/scenario.hpp"
#include "plant/process/trace_writer.hpp"
#include "plant/world/side_thread.hpp"
#include "plant/world/spinning_lidar.hpp"

namespace berm::plant {

struct RunOptions {
  std::uint64_t seed = 1;
  int trucks = 1;
  std::string can_address;
  std::uint16_t scan_port = 0;
  std::vector<std::uint16_t> lidar_port;  // one for each lidar of the profile
  std::string out;          // folder, made when missing
  bool realtime = false;
  int trace_every = 1;      // cycles
  double alone_s = 2.0;     // at standstill without kernel or app, after which the run ends
  std::array<double, 2> pause_kernel_s{};  // in lockstep: from when on, and for how long, the kernel is held up; for 0 s: never
  Peers::Descriptors peers;
  int stop_fd = -1;         // readable: end the run
};

class PlantRun {
 public:
  static constexpr double kCycle = 0.01;

  // Throws ConfigError for a CAN address or folder that cannot be used, std::runtime_error otherwise.
  PlantRun(const Scenario& scenario, const PlantProfile& profile, const RunOptions& options);
  // Runs to the end and writes the files; throws std::runtime_error.
  void run();

 private:
  static double time_of(std::uint64_t cycle) { return static_cast<double>(cycle) * kCycle; }
  void advance(double t);
  void break_machine();
  void attend(double t);    // the people round the machine: spotter and operator
  void take_levers(double t);
  bool somebody_near() const;
  BasePose base_pose() const;
  void watch_start(double t);
  PanelInput panel(double t) const;   // as the scenario has it; the run switch waits for the kernel at the start
  void change_weather(double t);
  void send(double t);
  std::uint32_t datagrams() const;  // to all sensor ports
  void use_spare_time(double t);
  void await_others();
  bool kernel_held_up(std::uint64_t cycle) const;
  void note_finish();
  void observe(double t);
  void observe_trucks(double t);
  void observe_peers(double t);
  bool stop_asked() const;
  // Why the run ends after this cycle; empty when it goes on.
  std::string end_reason(double t);
  void write_end(double t, const std::string& reason);

  Scenario scenario_;
  PlantProfile profile_;
  RunOptions options_;
  can::Transport bus_;
  ScanSender scans_;
  std::vector<std::unique_ptr<ScanSender>> lidars_;
  std::optional<SideThread> side_;    // with two lidars and two processors
  std::vector<berm_scan_packet> packets_;
  std::vector<LidarPacket> lidar_packets_;
  World world_;
  JointDynamics dynamics_;
  MachineController controller_;
  BaseMotion base_;
  HornListener horn_;
  std::optional<Operator> operator_;
  HandLift hand_lift_;
  double stands_by_s_ = -1.0;         // since when the panel has shown STANDBY, at the start; negative: it does not
  bool may_start_ = false;            // and the operator has seen it
  std::size_t soil_changes_ = 0;      // that have happened
  std::size_t presses_told_ = 0, lifts_told_ = 0;
  StateFrames frames_;
  std::array<PanServo, 2> servo_;
  Peers peers_;
  TraceWriter trace_;
  RunRecord record_;
  EventLines events_;

  std::uint64_t cycle_ = 0;
  double now_ = 0.0;                  // time of the newest cycle
  std::uint64_t epoch_us_ = 0;        // in real time: the monotonic clock, which the kernel reads too, when the run began
  PanState pan_;
  DigForces soil_;
  OracleVerdict verdict_;             // of the newest cycle
  bool parked_ = false, leaving_ = false, comes_back_ = false;  // comes_back_: the truck that made way for a tram is not another
  int truck_ = 0;                     // the newest that arrived, from 1
  int standing_cycles_ = 0;
  PeerState kernel_seen_, app_seen_;
  double finished_at_ = -1.0, alone_since_ = -1.0;
  bool panel_stop_ = false;
  std::array<bool, 4> out_of_control_{};  // noted
};

}  // namespace berm::plant
