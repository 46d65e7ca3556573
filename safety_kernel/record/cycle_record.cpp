#include "record/cycle_record.hpp"

#include <algorithm>

#include "journal/bytes.hpp"
#include "journal/scan_record.hpp"

namespace berm::record {

namespace {

using kernel::CycleInputs;

constexpr std::int64_t kTimeMaxUs = std::int64_t{1} << 60;

bool take_frame(ByteReader& from, berm_can_frame& to) {
  berm_journal_frame frame{};
  if (!from.copy(frame) || frame.length > sizeof frame.data) return false;
  to = berm_can_frame{};
  to.id = frame.id;
  to.length = frame.length;
  std::copy(frame.data, frame.data + sizeof frame.data, to.data);
  return true;
}

bool take_lidar(ByteReader& from, const kernel::Vlp16Mount& mount, CycleInputs& in) {
  const std::uint8_t* bytes = from.raw(up8(kernel::kVlp16PacketBytes));
  kernel::Vlp16Packet scratch;
  return bytes != nullptr && in.take_vlp16(mount, bytes, kernel::kVlp16PacketBytes, scratch);
}

bool take_upper_lidar(ByteReader& from, CycleInputs& in) {
  const std::uint8_t* bytes = from.raw(up8(kernel::kVlp16PacketBytes + 1));
  if (bytes == nullptr) return false;
  const std::uint8_t number = bytes[kernel::kVlp16PacketBytes];
  return number < BERM_LIDARS && in.take_lidar(number, bytes, kernel::kVlp16PacketBytes);
}

bool fits(const berm_journal_cycle& head, std::size_t size) {
  return head.magic == BERM_JOURNAL_RECORD_MAGIC && head.bytes == size && head.frames_in <= CycleInputs::kFrames &&
         head.frames_out <= kernel::FrameList::kCapacity && head.scan_packets <= CycleInputs::kPackets &&
         head.vlp16_packets <= CycleInputs::kVlp16Packets && head.lidar_packets <= CycleInputs::kLidarPackets && head.now_us >= 0 && head.now_us <= kTimeMaxUs;
}

}  // namespace

bool decode_cycle(const std::uint8_t* bytes, std::size_t size, const kernel::Vlp16Mount& mount, CycleInputs& in, RecordedOutputs& out, std::string& error) {
  ByteReader from(bytes, size);
  berm_journal_cycle head{};
  error = "not a record of a cycle";
  if (!from.copy(head) || !fits(head, size)) return false;
  in.clear();
  in.cycle = head.cycle;
  in.now_us = head.now_us;
  in.clock_fault = (head.flags & BERM_JOURNAL_CLOCK_FAULT) != 0;
  in.app_connected = (head.flags & BERM_JOURNAL_APP_CONNECTED) != 0;
  in.app_connections = head.app_connections;
  in.cycle_cpu_us = 0;
  in.journal_lost = static_cast<std::uint32_t>(std::min<std::uint64_t>(head.lost, UINT32_MAX));
  std::copy(head.request, head.request + sizeof head.request, in.request);
  out.sequence = head.sequence;
  out.map_row_hash = head.map_row_hash;
  out.state = head.state;
  out.decision = head.decision;
  out.frames.count = head.frames_out;
  error = "a frame of cycle " + std::to_string(head.cycle) + " is damaged";
  for (int i = 0; i < head.frames_in; ++i)
    if (!take_frame(from, in.frame[in.frame_count++])) return false;
  for (int i = 0; i < head.frames_out; ++i)
    if (!take_frame(from, out.frames.frame[i])) return false;
  error = "a scan of cycle " + std::to_string(head.cycle) + " is damaged";
  for (int i = 0; i < head.scan_packets; ++i)
    if (!take_scan(from, in.packet[in.packet_count++])) return false;
  error = "a lidar packet of cycle " + std::to_string(head.cycle) + " is damaged";
  for (int i = 0; i < head.vlp16_packets; ++i)
    if (!take_lidar(from, mount, in)) return false;
  for (int i = 0; i < head.lidar_packets; ++i)
    if (!take_upper_lidar(from, in)) return false;
  error = "the record of cycle " + std::to_string(head.cycle) + " has another length than its parts";
  if (from.left() != 0) return false;
  error.clear();
  return true;
}

}  // namespace berm::record
