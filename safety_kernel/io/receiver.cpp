#include "io/receiver.hpp"

#include <poll.h>

#include <algorithm>

#include "io/clock.hpp"

namespace berm::kernel {

namespace {
constexpr std::int64_t kLockstepCycleUs = 10000;
}

bool Receiver::open(std::string& error) {
  if (!options_.map_only) error = can_.open(options_.can);
  if (!error.empty()) return false;
  if (options_.scan_port != 0 && !options_.map_only && !scan_.open(options_.scan_port, error)) return false;
  for (int i = 0; i < options_.lidar_ports && !options_.map_only; ++i)
    if (!lidar_[i].open(options_.lidar_port[i], error)) return false;
  if (!options_.map_only || options_.vlp16_port == 0) return true;
  return vlp16_.open(options_.vlp16_port, error);
}

void Receiver::add_frame(const berm_can_frame& frame, CycleInputs& in) {
  if (in.frame_count < CycleInputs::kFrames) {
    in.frame[in.frame_count++] = frame;
  } else {
    ++counters_.frames_overrun;
  }
}

bool Receiver::take_scan(CycleInputs& in) {
  std::uint8_t bytes[BERM_SCAN_PACKET_MAX_BYTES];
  const ssize_t n = scan_.is_open() ? scan_.receive(bytes, sizeof bytes) : -1;
  if (n < 0) return false;
  ++datagrams_;
  const bool room = in.packet_count < CycleInputs::kPackets;
  const bool whole = static_cast<std::size_t>(n) <= sizeof bytes;
  if (room && whole && berm_scan_decode(bytes, static_cast<std::size_t>(n), &in.packet[in.packet_count]) == BERM_SCAN_OK) {
    ++in.packet_count;
    ++counters_.scan_packets;
  } else {
    ++counters_.scan_rejected;
  }
  return true;
}

bool Receiver::take_vlp16(CycleInputs& in) {
  std::uint8_t bytes[kVlp16PacketBytes];
  const ssize_t n = vlp16_.is_open() ? vlp16_.receive(bytes, sizeof bytes) : -1;
  if (n < 0) return false;
  ++datagrams_;
  if (!in.take_vlp16(options_.vlp16_mount, bytes, static_cast<std::size_t>(n), vlp16_packet_)) {
    ++counters_.vlp16_rejected;
    return true;
  }
  ++counters_.vlp16_packets;
  counters_.vlp16_points += static_cast<std::uint64_t>(vlp16_packet_.count);
  return true;
}

bool Receiver::take_lidar(CycleInputs& in) {
  bool any = false;
  for (int i = 0; i < options_.lidar_ports; ++i) {
    std::uint8_t bytes[kVlp16PacketBytes];
    const ssize_t n = lidar_[i].is_open() ? lidar_[i].receive(bytes, sizeof bytes) : -1;
    if (n < 0) continue;
    any = true;
    ++datagrams_;
    ++(in.take_lidar(i, bytes, static_cast<std::size_t>(n)) ? counters_.lidar_packets : counters_.lidar_rejected);
  }
  return any;
}

void Receiver::gather(CycleInputs& in) {
  berm_can_frame frame{};
  if (!options_.map_only)
    for (int i = 0; i < CycleInputs::kFrames && can_.receive(frame); ++i) add_frame(frame, in);
  for (int i = 0; i < kDatagramsPerCycle && take_scan(in); ++i) continue;
  for (int i = 0; i < CycleInputs::kVlp16Packets && take_vlp16(in); ++i) continue;
  for (int i = 0; i < CycleInputs::kLidarPackets && take_lidar(in); ++i) continue;
}

bool Receiver::gather_lockstep(CycleInputs& in, const volatile int& stop, PeerServer& peers) {
  berm_can_frame frame{};
  while (stop == 0) {
    if (!can_.receive(frame, kWaitMs)) {
      peers.poll();  // app and recorder may come before the first clock frame
      continue;
    }
    berm_sim_clock clock{};
    if (frame.id != BERM_CAN_SIMULATION_CLOCK) {
      add_frame(frame, in);
    } else if (berm_decode_sim_clock(&frame, &clock) && clock.cycle > last_clock_) {
      last_clock_ = clock.cycle;
      in.cycle = clock.cycle;
      in.now_us = static_cast<std::int64_t>(clock.cycle) * kLockstepCycleUs;
      await_scans(clock.scan_packets, in);
      return true;
    }
  }
  return false;
}

void Receiver::await_scans(std::uint32_t announced, CycleInputs& in) {
  const std::int64_t until_us = monotonic_us() + kScanWaitMs * 1000;
  const auto missing = [&] { return static_cast<std::int32_t>(announced - datagrams_); };
  while (missing() > 0) {
    bool any = false;
    while (missing() > 0 && take_scan(in)) any = true;
    while (missing() > 0 && take_vlp16(in)) any = true;
    while (missing() > 0 && take_lidar(in)) any = true;
    if (any) continue;
    const std::int64_t left_us = until_us - monotonic_us();
    if (left_us <= 0) {
      // Lost on the way: not waited for again.
      counters_.scan_missing += static_cast<std::uint64_t>(missing());
      datagrams_ = announced;
      return;
    }
    pollfd wait[2 + BERM_LIDARS] = {{scan_.fd(), POLLIN, 0}, {vlp16_.fd(), POLLIN, 0}};
    for (int i = 0; i < BERM_LIDARS; ++i) wait[2 + i] = {lidar_[i].fd(), POLLIN, 0};
    poll(wait, 2 + BERM_LIDARS, static_cast<int>(std::min<std::int64_t>(left_us / 1000 + 1, kScanWaitMs)));
  }
}

}  // namespace berm::kernel
