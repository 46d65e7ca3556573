// Frames from the bus: which are used, and the newest picture of machine, operator and spotter they give.
//
// A guarded message counts only behind its guard frame (core/frame_guard.h). Identifiers that are not Berm's are foreign traffic and
// pass unnoticed; Berm's own identifiers with a wrong length, guard or value are refused and counted.
#pragma once

#include <cstdint>

#include "can/berm_can.h"
#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "core/base_motion.h"
#include "core/frame_guard.h"

namespace berm::kernel {

struct MachinePicture {
  berm_front_angle angle{};
  berm_front_velocity velocity{};
  berm_machine_state state{};
  berm_estop estop{};
  berm_operator panel{};
  berm_spotter spotter{};
  std::int32_t payload_kg = -1;        // not trusted
  std::int32_t cylinder_kpa[BERM_CYLINDERS][2] = {};  // bottom and rod side; not trusted
};

class FrameIntake {
 public:
  explicit FrameIntake(const berm_parameters& parameters);

  // Before the frames of a cycle: what those of the cycle before said counts no longer, but for the newest.
  void begin_cycle() { said_ = Said{}; }
  void take(const berm_can_frame& frame, std::int64_t now_us);

  const MachinePicture& picture() const { return picture_; }
  // Roll_Pitch and Vehicle_Azimuth have no guard on the real machine's bus either: they stop, and never permit.
  const sk_base_state& base() const { return base_; }
  sk_base_state& base() { return base_; }
  std::uint64_t rejected() const { return rejected_; }
  // True once a usable angle frame came in this cycle or before; when it came.
  std::int64_t angle_us() const { return guard_[kAngle].last_us; }
  std::int64_t velocity_us() const { return guard_[kVelocity].last_us; }

  // Each message of the group was accepted at least once since start.
  bool state_heard() const;     // angle, velocity, machine state, e-stop status
  bool operator_heard() const { return guard_[kOperator].last_us >= 0; }
  // Newest accepted frames are young enough for the limits of the parameters.
  bool joints_fresh(std::int64_t now_us) const;    // angle and velocity
  bool machine_fresh(std::int64_t now_us) const;   // machine state and e-stop status
  bool operator_fresh(std::int64_t now_us) const;
  bool spotter_fresh(std::int64_t now_us) const;
  // By a fresh word of the spotter: a truck stands to be loaded, and is not leaving. So say the newest frame and all of this cycle.
  bool truck_admitted(std::int64_t now_us) const;
  // The spotter is optional: silent from the start is no matter, falling silent is.
  bool spotter_lost(std::int64_t now_us) const;

  // What stops, or takes an admission back: said by the newest frame, or by any that was accepted in this cycle. Several may come at once, and a key
  // that was pressed and let go between two cycles was pressed.
  bool estop_pressed() const { return picture_.estop.pressed || said_.estop_pressed; }
  bool operator_stop() const { return picture_.panel.stop || said_.operator_stop; }
  bool spotter_stop() const { return picture_.spotter.stop || said_.spotter_stop; }
  bool truck_parked() const { return picture_.spotter.truck_parked && !said_.no_truck; }
  bool truck_leaving() const { return picture_.spotter.truck_leaving || said_.truck_leaving; }
  bool machine_healthy() const;  // no error of the machine's own is reported

 private:
  enum Message { kAngle, kVelocity, kMachineState, kEstop, kOperator, kSpotter, kMessages };

  void take_guard(const berm_can_frame& frame, std::int64_t now_us);
  bool take_guarded(int message, const berm_can_frame& frame, std::int64_t now_us);
  bool take_plain(const berm_can_frame& frame, std::int64_t now_us);
  bool decode(int message, const berm_can_frame& frame);
  bool decode_machine_state(const berm_can_frame& frame);
  bool decode_estop(const berm_can_frame& frame);
  bool decode_operator(const berm_can_frame& frame);
  bool decode_spotter(const berm_can_frame& frame);
  bool heard(int message) const { return guard_[message].last_us >= 0; }

  // By any accepted frame of this cycle.
  struct Said {
    bool estop_pressed = false, operator_stop = false, spotter_stop = false, truck_leaving = false, no_truck = false, machine_error = false;
  };

  const berm_parameters& parameters_;
  Said said_;
  sk_guard_state guard_[kMessages];
  MachinePicture picture_;
  sk_base_state base_;
  std::uint64_t rejected_ = 0;
};

}  // namespace berm::kernel
