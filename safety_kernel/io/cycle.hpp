// One cycle of the kernel: a pure function of (state, inputs of the cycle) to (state, outputs). No I/O, no clock, no allocation; the same
// inputs always give the same outputs.
#pragma once

#include <cstdint>

#include "can/berm_can.h"
#include "config/parameter_block.h"
#include "contract/berm_contract.h"
#include "core/height_map.h"
#include "core/request_check.h"
#include "core/scanline_raster.h"
#include "core/stop_logic.h"
#include "geometry/joint_history.hpp"
#include "geometry/self_filter.hpp"
#include "geometry/terrain_registration.hpp"
#include "io/command_history.hpp"
#include "io/frame_intake.hpp"
#include "io/frame_output.hpp"
#include "io/lidar_intake.hpp"
#include "io/motion_check.hpp"
#include "io/motion_watch.hpp"
#include "io/own_cells.hpp"
#include "io/scan_intake.hpp"
#include "io/sector_watch.hpp"
#include "io/sight_watch.hpp"
#include "io/supervision.hpp"
#include "io/vlp16.hpp"
#include "io/workspace_watch.hpp"
#include "scan/scan_packet.h"

namespace berm::kernel {

// What arrived since the cycle before. Large: lives in static or preallocated storage.
struct CycleInputs {
  static constexpr int kFrames = 512;
  static constexpr int kPackets = 64;
  static constexpr int kVlp16Packets = 512;
  static constexpr int kLidarPackets = 64;
  static constexpr int kFootprints = kVlp16Packets * kVlp16MaxPoints;

  std::uint64_t cycle = 0;
  std::int64_t now_us = 0;
  bool clock_fault = false;              // the cycle came too late, or time ran backwards
  int frame_count = 0;
  berm_can_frame frame[kFrames];
  int packet_count = 0;
  berm_scan_packet packet[kPackets];
  int vlp16_count = 0;
  std::uint8_t vlp16[kVlp16Packets][kVlp16PacketBytes];  // as received; what the footprints were made of
  int footprint_count = 0;
  Vlp16Footprint footprint[kFootprints];  // last returns of a VLP-16, base frame
  sk_point lidar_head{};                  // its place, set with them
  int lidar_count = 0;
  struct LidarPacket {
    std::uint8_t lidar;
    std::uint8_t bytes[kVlp16PacketBytes];
  } lidar[kLidarPackets];                 // of the lidars on the upper body, as received
  bool app_connected = false;
  std::uint32_t app_connections = 0;     // since start
  std::uint8_t request[SK_REQUEST_BYTES] = {};  // private copy
  std::uint32_t cycle_cpu_us = 0;        // of the cycle before, for observers only
  std::uint32_t journal_lost = 0;        // before this cycle, for observers only

  void clear() { frame_count = packet_count = vlp16_count = footprint_count = lidar_count = 0; }
  // Takes a packet of a lidar on the upper body. False and nothing changed when there is no room or it has another size.
  bool take_lidar(int number, const std::uint8_t* bytes, std::size_t size);
  // Takes a lidar packet and makes its footprints (scratch holds its returns). False and nothing changed when there is no room or it is no packet.
  bool take_vlp16(const Vlp16Mount& mount, const std::uint8_t* bytes, std::size_t size, Vlp16Packet& scratch);
};

struct CycleOutputs {
  FrameList frames;
  ScanBlocks blocks;
  berm_state state;
  berm_decision decision;
};

class Cycle {
 public:
  // map_only: no machine; stays in INIT, makes no frames, no own body in the map. parameters must have passed sk_parameters_check.
  Cycle(const berm_parameters& parameters, bool map_only);

  void step(const CycleInputs& in, CycleOutputs& out);

  const sk_height_map& map() const { return map_; }
  const SliceSet& slices() const { return motion_.slices(); }
  const TerrainRegistration& registration() const { return registration_; }
  const WorkspaceWatch& workspace() const { return workspace_; }
  const SectorWatch& sectors() const { return sectors_; }
  const SightWatch& sight() const { return sight_; }
  std::uint64_t frames_rejected() const { return frames_.rejected(); }
  std::uint64_t scans_rejected() const { return scans_rejected_; }
  std::uint64_t lidars_rejected() const { return lidars_rejected_; }

 private:
  void take_frames(const CycleInputs& in);
  void take_scans(const CycleInputs& in, ScanBlocks& blocks);
  void take_points(const CycleInputs& in);
  void take_lidars(const CycleInputs& in);
  void learn_base(std::int64_t now_us);
  void register_terrain(const ScanBlocks& blocks, std::int64_t now_us);
  void begin_map();
  void watch_lidar(int lidar, const JointAngles& then, std::int64_t now_us);
  void watch_workspace(const ScanBlocks& blocks, std::int64_t now_us);
  bool relearns(std::int64_t now_us) const;
  void take_request(const CycleInputs& in);
  void judge_motion(std::int64_t now_us);
  std::uint8_t judge_hold(std::int64_t now_us) const;
  void step_stop_logic(const CycleInputs& in);
  void count_stop(const sk_stop_state& before);
  void order(const CycleInputs& in, FrameList& frames);
  void report_state(const CycleInputs& in, berm_state& state) const;
  void report_decision(const CycleInputs& in, berm_decision& decision) const;
  std::uint32_t panel_flags(std::int64_t now_us) const;
  std::uint8_t published_reason() const;
  struct ShownCell {
    bool has_cell;
    std::int32_t x_mm, y_mm, height_mm;
    std::uint32_t link;
  };
  ShownCell cell_of(std::uint8_t reason) const;
  ShownCell shown_cell() const;
  bool held() const { return stop_.code == SK_STATE_STOPPED && !stop_.latched; }

  const berm_parameters& parameters_;
  const bool map_only_;
  FrameIntake frames_;
  FrameOutput output_;
  ScanIntake scans_;
  LidarIntake lidars_;
  SelfFilter self_;
  JointHistory joints_;
  CommandHistory commands_;
  OwnCells own_cells_;
  MotionCheck motion_;
  MotionWatch motion_watch_;
  StandstillWatch standstill_watch_;
  sk_height_map map_;
  TerrainRegistration registration_;
  WorkspaceWatch workspace_;
  SectorWatch sectors_;
  SightWatch sight_;
  sk_request_state request_state_{};
  sk_request request_{};            // newest accepted
  sk_stop_state stop_{};
  sk_stop_output permit_{};
  AppPulse app_;
  std::int64_t cycle_us_ = -1;                             // start of the cycle before; -1: none
  std::int64_t angle_since_us_ = 0, velocity_since_us_ = 0;  // the newest came no earlier
  std::uint32_t app_connections_ = 0;
  std::uint64_t scans_rejected_ = 0, lidars_rejected_ = 0;
  std::uint32_t stop_count_[BERM_STOP_REASONS] = {};

  // of the newest cycle
  std::int32_t request_result_ = BERM_REQUEST_NONE;
  std::int32_t requested_urad_s_[4] = {};
  bool motion_wanted_ = false;
  bool standstill_ = false;
  bool intruder_ = false;
  std::uint8_t hold_reason_ = BERM_STOP_NONE;
  MotionVerdict verdict_{};
  std::uint8_t motion_fault_ = BERM_STOP_NONE;
  std::uint8_t last_hold_reason_ = BERM_STOP_NONE;
  ShownCell last_hold_cell_{};
  bool settled_ = true;  // the last that held has stayed away for long enough
  MotionVerdict tail_met_{};  // when the tail was last stopped: while that is latched its place is shown
  std::int32_t sent_urad_s_[4] = {};
  std::uint32_t map_points_ = 0;
};

// BERM_STATE_* of a state code of the stop logic; BERM_STATE_FAULT for any other.
std::uint8_t contract_state(std::uint16_t code);

}  // namespace berm::kernel
