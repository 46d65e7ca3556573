#include "io/cycle.hpp"

#include <algorithm>
#include <cmath>

namespace berm::kernel {

Cycle::Cycle(const berm_parameters& parameters, bool map_only)
    : parameters_(parameters),
      map_only_(map_only),
      frames_(parameters),
      scans_(parameters),
      lidars_(parameters),
      self_(parameters),
      commands_(parameters.command_latency_us + parameters.state_latency_us + parameters.cycle_us),
      own_cells_(parameters),
      motion_(parameters, own_cells_),
      motion_watch_(parameters),
      registration_(parameters),
      workspace_(parameters),
      sectors_(parameters),
      sight_(parameters) {
  sk_map_clear(&map_);
  sk_stop_init(&stop_);
}

bool CycleInputs::take_lidar(int number, const std::uint8_t* bytes, std::size_t size) {
  if (lidar_count >= kLidarPackets || size != kVlp16PacketBytes) return false;
  LidarPacket& to = lidar[lidar_count++];
  to.lidar = static_cast<std::uint8_t>(number);
  std::copy(bytes, bytes + kVlp16PacketBytes, to.bytes);
  return true;
}

bool CycleInputs::take_vlp16(const Vlp16Mount& mount, const std::uint8_t* bytes, std::size_t size, Vlp16Packet& scratch) {
  const bool room = vlp16_count < kVlp16Packets && footprint_count + kVlp16MaxPoints <= kFootprints;
  if (!room || vlp16_decode(bytes, size, scratch) != Vlp16Result::kOk) return false;
  std::copy(bytes, bytes + kVlp16PacketBytes, vlp16[vlp16_count++]);
  lidar_head = vlp16_head(mount);
  for (int i = 0; i < scratch.count; ++i) footprint[footprint_count++] = vlp16_project(mount, scratch.point[i]);
  return true;
}

void Cycle::step(const CycleInputs& in, CycleOutputs& out) {
  out.frames.count = 0;
  out.blocks.count = 0;
  const std::uint32_t points_before = scans_.points();
  map_points_ = 0;
  take_frames(in);
  if (!map_only_) learn_base(in.now_us);
  if (!map_only_ && joints_.size() > 0) workspace_.dig(joints_.at(in.now_us).angles, standstill_, in.now_us);
  take_scans(in, out.blocks);
  map_points_ += scans_.points() - points_before;
  take_points(in);
  take_lidars(in);
  sight_.step(in.now_us);
  if (!map_only_) {
    register_terrain(out.blocks, in.now_us);
    // Nothing is kept while the base has moved, for it may still be moving, nor while the operator has the map learned anew.
    if (frames_.base().moved || relearns(in.now_us)) begin_map();
    if (relearns(in.now_us)) sight_.begin();
    watch_workspace(out.blocks, in.now_us);
    own_cells_.stamp(map_, in.now_us, parameters_.generation_us);
    take_request(in);
    judge_motion(in.now_us);
    step_stop_logic(in);
    order(in, out.frames);
  }
  report_state(in, out.state);
  report_decision(in, out.decision);
}

// A frame may have come as soon as the cycle before had begun; what it waits more than a cycle for the next is not in the state latency.
void Cycle::take_frames(const CycleInputs& in) {
  const std::int64_t angle_before_us = frames_.angle_us(), velocity_before_us = frames_.velocity_us();
  frames_.begin_cycle();
  for (int i = 0; i < in.frame_count; ++i) frames_.take(in.frame[i], in.now_us);
  const std::int64_t waited_us = cycle_us_ < 0 ? 0 : std::max<std::int64_t>(in.now_us - cycle_us_ - parameters_.cycle_us, 0);
  if (frames_.angle_us() != angle_before_us) {
    joints_.push(in.now_us, frames_.picture().angle.angle_urad);
    angle_since_us_ = in.now_us - waited_us;
  }
  if (frames_.velocity_us() != velocity_before_us) velocity_since_us_ = in.now_us - waited_us;
  cycle_us_ = in.now_us;
}

void Cycle::take_scans(const CycleInputs& in, ScanBlocks& blocks) {
  // Without joint angles nothing can be placed in the base frame.
  if (map_only_ || joints_.size() == 0) return;
  for (int i = 0; i < in.packet_count; ++i) {
    const berm_scan_packet& packet = in.packet[i];
    if (scans_.take(packet, joints_, in.now_us, map_, blocks)) sight_.take(packet, joints_.at(static_cast<std::int64_t>(packet.time_us)).angles.swing, in.now_us);
    else ++scans_rejected_;
  }
  scans_.flush(joints_, in.now_us, map_, blocks);
}

void Cycle::take_points(const CycleInputs& in) {
  if (in.footprint_count == 0 || (!map_only_ && joints_.size() == 0)) return;
  const JointAngles angles = joints_.at(in.now_us).angles;
  const ImplementPose pose = self_.pose(angles);
  const Eigen::Matrix3d to_upper = Eigen::AngleAxisd(-angles.swing, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto own = [&](const sk_point& p) { return self_.is_own(to_upper * (Eigen::Vector3d(p.x_mm, p.y_mm, p.z_mm) * 1e-3), pose); };
  for (int i = 0; i < in.footprint_count; ++i) {
    Vlp16Footprint f = in.footprint[i];
    f.left.z_mm = f.right.z_mm = std::clamp(f.left.z_mm, -SK_HEIGHT_MAX_MM, SK_HEIGHT_MAX_MM);
    if (!map_only_ && own(f.left) && own(f.right)) {
      scans_.shadow().keep(OwnShadow::kLidar, in.lidar_head, f.left, in.now_us, map_);
      continue;
    }
    if (sk_raster_segment(&map_, &f.left, &f.right, in.now_us, parameters_.generation_us) > 0) ++map_points_;
  }
}

void Cycle::take_lidars(const CycleInputs& in) {
  if (map_only_ || joints_.size() == 0) return;
  const std::uint32_t before = lidars_.points();
  for (int i = 0; i < in.lidar_count; ++i) {
    const CycleInputs::LidarPacket& packet = in.lidar[i];
    if (!lidars_.take(packet.lidar, packet.bytes, kVlp16PacketBytes, joints_, in.now_us, map_, scans_.shadow())) {
      ++lidars_rejected_;
      continue;
    }
    const JointAngles then = joints_.at(lidars_.middle_us(packet.lidar)).angles;
    sight_.take(packet.lidar, packet.bytes, then.swing, in.now_us);
    watch_lidar(packet.lidar, then, in.now_us);
  }
  map_points_ += lidars_.points() - before;
}

void Cycle::watch_lidar(int lidar, const JointAngles& then, std::int64_t now_us) {
  if (frames_.base().moved || !workspace_.watched()) return;
  workspace_.take(lidar, lidars_.packet(), then, now_us);
  sectors_.take(workspace_.lidar_returns(lidar), now_us);
}

void Cycle::learn_base(std::int64_t now_us) {
  sk_base_state& base = frames_.base();
  const bool reset = frames_.operator_fresh(now_us) && frames_.picture().panel.reset && stop_.latched && stop_.reset_seen_released;
  const bool learns_anew = base.moved && standstill_ && (reset || stop_.code == SK_STATE_INIT);
  // The map begins with its reference.
  if ((!base.learned || learns_anew) && sk_base_learn(&base, &parameters_, now_us)) begin_map();
}

void Cycle::begin_map() {
  sk_map_clear(&map_);
  registration_.begin();
  workspace_.begin();
  sectors_.begin();
}

void Cycle::watch_workspace(const ScanBlocks& blocks, std::int64_t now_us) {
  if (frames_.base().moved) return;
  workspace_.take(blocks, joints_, now_us);
  sectors_.take(blocks, now_us);
  workspace_.trucks(frames_.spotter_fresh(now_us), frames_.truck_admitted(now_us), now_us);
  intruder_ = workspace_.step(now_us);
}

void Cycle::register_terrain(const ScanBlocks& blocks, std::int64_t now_us) {
  if (!frames_.base().moved) {
    for (int b = 0; b < blocks.count; ++b) {
      const berm_scan_block& block = blocks.block[b];
      for (int i = 0; i < block.count; ++i)
        if (block.used[i] != 0) registration_.take({block.point_mm[i][0], block.point_mm[i][1], block.point_mm[i][2]});
    }
  }
  registration_.step(now_us);
  if (registration_.slipped()) sk_base_slipped(&frames_.base());
}

// At standstill alone; a key that stays down keeps the map empty, and the machine where it stands.
bool Cycle::relearns(std::int64_t now_us) const { return standstill_ && frames_.operator_fresh(now_us) && frames_.picture().panel.relearn; }

void Cycle::take_request(const CycleInputs& in) {
  if (in.app_connections != app_connections_) {
    app_connections_ = in.app_connections;
    request_state_.primed = false;  // another app counts from where it likes
  }
  request_result_ = BERM_REQUEST_NONE;
  if (in.app_connected) request_result_ = sk_request_check(&request_state_, in.request, &parameters_, in.now_us, &request_);
  if (request_result_ == BERM_REQUEST_ACCEPTED) {
    app_.heard = true;
    app_.last_accept_us = in.now_us;
  }
  const bool usable = app_.heard && !app_.holds(in.now_us, parameters_.request_hold_us);
  motion_wanted_ = false;
  for (int j = 0; j < SK_JOINTS; ++j) {
    requested_urad_s_[j] = usable ? request_.joint_velocity_urad_s[j] : 0;
    motion_wanted_ = motion_wanted_ || requested_urad_s_[j] != 0;
  }
}

void Cycle::judge_motion(std::int64_t now_us) {
  const bool fresh = frames_.state_heard() && frames_.joints_fresh(now_us);
  const MachinePicture& picture = frames_.picture();
  standstill_ = standstill_watch_.check(picture.velocity.velocity_urad_s, fresh, parameters_, now_us);
  if (!fresh) {
    verdict_ = MotionVerdict{};
    verdict_.permission = Permission::kHeld;
    verdict_.reason = BERM_STOP_STATE_FRAME;
    motion_fault_ = BERM_STOP_NONE;
    motion_watch_.lose();
    return;
  }
  MotionQuery query{};
  query.now_us = now_us;
  query.late_us = now_us - std::min(angle_since_us_, velocity_since_us_);
  std::copy(picture.angle.angle_urad, picture.angle.angle_urad + SK_JOINTS, query.angle_urad);
  std::copy(picture.velocity.velocity_urad_s, picture.velocity.velocity_urad_s + SK_JOINTS, query.velocity_urad_s);
  std::copy(requested_urad_s_, requested_urad_s_ + SK_JOINTS, query.requested_urad_s);
  commands_.range(now_us - query.late_us, query.under_way_low_urad_s, query.under_way_high_urad_s);
  query.truck_admitted = frames_.truck_admitted(now_us);
  const bool dust = sight_.dust() == SK_DUST_SLOW;
  query.speed_permille = sk_speed_share(&parameters_, dust, workspace_.learns());
  query.lane_speed_permille = workspace_.learns_lanes() ? sk_speed_share(&parameters_, dust, true) : query.speed_permille;
  query.sectors = sectors_.evaluated() ? &sectors_ : nullptr;
  motion_.check(query, map_, verdict_);
  motion_fault_ = motion_watch_.check(query, verdict_.box, frames_.angle_us(), frames_.velocity_us());
}

std::uint8_t Cycle::judge_hold(std::int64_t now_us) const {
  // While latched nothing moves and only the operator can change that: a blocked box must not stand in the way of the reset.
  if (stop_.latched) return BERM_STOP_NONE;
  if (intruder_) return BERM_STOP_INTRUDER;
  if (app_.holds(now_us, parameters_.request_hold_us)) return BERM_STOP_REQUEST_HOLD;
  if (sight_.dust() == SK_DUST_STOP) return BERM_STOP_DUST;
  if (verdict_.permission == Permission::kHeld) return verdict_.reason;
  // Creep recovery counts as running only while it is used.
  const bool at_rest = !motion_wanted_ && !standstill_watch_.moving();
  return verdict_.permission == Permission::kCreep && at_rest ? verdict_.reason : static_cast<std::uint8_t>(BERM_STOP_NONE);
}

void Cycle::step_stop_logic(const CycleInputs& in) {
  const berm_operator& panel = frames_.picture().panel;
  const bool panel_fresh = frames_.operator_fresh(in.now_us);
  sk_stop_input stop_in{};
  stop_in.now_us = in.now_us;
  supervise(frames_, {scans_.health(), lidars_, sight_}, app_, in.clock_fault, parameters_, stop_in);
  if (motion_fault_ != BERM_STOP_NONE) {  // before any other fault: it alone removes power at once, but where a sensor lies and the joints may well obey
    stop_in.fault_reason = motion_fault_;
    stop_in.fault_category_0 = motion_fault_ != BERM_STOP_STATE_FRAME;
  }
  // Where the ground round the tail ends the own body begins, of which no sensor tells: who was seen there may have gone in, not away.
  const bool met_tail = verdict_.permission == Permission::kHeld && verdict_.reason == BERM_STOP_TAIL;
  if (met_tail) tail_met_ = verdict_;
  if (met_tail && stop_in.latch_reason == BERM_STOP_NONE) stop_in.latch_reason = BERM_STOP_TAIL;
  hold_reason_ = judge_hold(in.now_us);
  if (hold_reason_ != BERM_STOP_NONE) {
    last_hold_reason_ = hold_reason_;
    last_hold_cell_ = cell_of(hold_reason_);
  }
  stop_in.hold_reason = hold_reason_;
  stop_in.inputs_ready = inputs_ready(frames_, {scans_.health(), lidars_, sight_}, parameters_, in.now_us);
  stop_in.standstill = standstill_;
  stop_in.operator_run = panel_fresh && panel.run && app_.heard;
  stop_in.operator_run_off = panel_fresh && !panel.run;
  stop_in.operator_reset = panel_fresh && panel.reset;
  const sk_stop_state before = stop_;
  sk_stop_step(&stop_, &stop_in, &permit_);
  settled_ = sk_stop_is_settled(&stop_, &stop_in);
  count_stop(before);
}

void Cycle::count_stop(const sk_stop_state& before) {
  const std::uint8_t reason = stop_.reason;
  if (reason == BERM_STOP_NONE || reason >= BERM_STOP_REASONS) return;
  const bool latched_anew = stop_.latched && (!before.latched || before.reason != reason);
  // A hold of a machine that stands and is asked for nothing stops nothing.
  const bool left_run = before.code == SK_STATE_RUN && stop_.code != SK_STATE_RUN && (motion_wanted_ || standstill_watch_.moving());
  if (latched_anew || left_run) ++stop_count_[reason];
}

void Cycle::order(const CycleInputs& in, FrameList& frames) {
  MachineOrders orders{};
  const bool may_move = permit_.motion_enabled && verdict_.permission != Permission::kHeld;
  for (int j = 0; j < SK_JOINTS; ++j) {
    sent_urad_s_[j] = may_move ? verdict_.command_urad_s[j] : 0;
    orders.velocity_urad_s[j] = sent_urad_s_[j];
  }
  commands_.push(in.now_us, sent_urad_s_);
  for (int s = 0; s < BERM_SCANNERS; ++s) {
    orders.pan[s].scanner = static_cast<std::uint8_t>(s);
    orders.pan[s].goal_urad = app_.heard ? request_.pan_goal_urad[s] : scans_.pan_urad(s);
    orders.pan[s].rate_urad_s = app_.heard ? request_.pan_rate_urad_s[s] : 0;
  }
  orders.horn = app_.heard && (request_.flags & BERM_REQUEST_FLAG_HORN) != 0 && !app_.holds(in.now_us, parameters_.request_silent_us);
  orders.heartbeat.enable = permit_.heartbeat_enable;
  orders.heartbeat.stop_category = stop_.category;
  orders.heartbeat.kernel_state = contract_state(stop_.code);
  orders.heartbeat.stop_reason = published_reason();
  orders.heartbeat.cycle = static_cast<std::uint16_t>(in.cycle & 0xFFFFU);
  output_.make(orders, frames);
}

}  // namespace berm::kernel
