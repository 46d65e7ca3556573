#include "io/scan_intake.hpp"

#include <algorithm>
#include <cstring>

#include "core/scanline_raster.h"

namespace berm::kernel {

ScanIntake::ScanIntake(const berm_parameters& parameters) : parameters_(parameters), projection_(parameters), self_(parameters), shadow_(parameters.generation_us) {}

bool ScanIntake::continues(const berm_scan_packet& earlier, const berm_scan_packet& later) {
  return earlier.scanline == later.scanline && earlier.sequence + 1U == later.sequence && earlier.first_index + earlier.count == later.first_index &&
         earlier.samples_per_revolution == later.samples_per_revolution;
}

bool ScanIntake::take(const berm_scan_packet& packet, const JointHistory& joints, std::int64_t now_us, sk_height_map& map, ScanBlocks& blocks) {
  if (!health_.accept(packet, now_us)) return false;
  Line& line = line_[packet.scanner];
  const bool follows = line.packet.count > 0 && continues(line.packet, packet);
  if (line.waiting) work_off(line, follows ? &packet : nullptr, joints, now_us, map, blocks);
  if (follows) {
    std::uint32_t range[BERM_SCAN_PACKET_SAMPLES];
    std::uint8_t echoes[BERM_SCAN_PACKET_SAMPLES];
    last_echoes(line.packet, range, echoes);
    const int count = line.packet.count;
    for (int i = 0; i < kNeighbours; ++i) line.before[i] = count - kNeighbours + i >= 0 ? range[count - kNeighbours + i] : 0U;
    std::copy(line.last_own, line.last_own + kNeighbours, line.before_own);
  } else {
    std::fill(line.before, line.before + kNeighbours, 0U);
    line.chained = false;
  }
  line.packet = packet;
  line.arrived_us = now_us;
  line.waiting = true;
  line.pan_urad = packet.pan_end_urad;
  if ((packet.flags & BERM_SCAN_FLAG_LAST) != 0) work_off(line, nullptr, joints, now_us, map, blocks);
  return true;
}

void ScanIntake::flush(const JointHistory& joints, std::int64_t now_us, sk_height_map& map, ScanBlocks& blocks) {
  for (Line& line : line_)
    if (line.waiting && now_us - line.arrived_us >= kWaitUs) work_off(line, nullptr, joints, now_us, map, blocks);
}

void ScanIntake::filter(const Line& line, const berm_scan_packet* next, const std::uint32_t* raw, const Located* located, const JointHistory& joints,
                        std::uint32_t* kept) const {
  std::uint32_t window[kNeighbours + BERM_SCAN_PACKET_SAMPLES + kNeighbours] = {};
  std::uint8_t own[kNeighbours + BERM_SCAN_PACKET_SAMPLES + kNeighbours] = {};
  const int count = line.packet.count;
  // Nearer than the least range there is nothing: such a return is noise, and must not support another.
  const auto usable = [least = static_cast<std::uint32_t>(parameters_.range_min_mm)](std::uint32_t range_mm) { return range_mm < least ? 0U : range_mm; };
  std::transform(line.before, line.before + kNeighbours, window, usable);
  std::copy(line.before_own, line.before_own + kNeighbours, own);
  std::transform(raw, raw + count, window + kNeighbours, usable);
  for (int i = 0; i < count; ++i) own[kNeighbours + i] = located[i].own;
  if (next != nullptr) {
    std::uint32_t range[BERM_SCAN_PACKET_SAMPLES];
    std::uint8_t echoes[BERM_SCAN_PACKET_SAMPLES];
    last_echoes(*next, range, echoes);
    for (int i = 0; i < std::min<int>(kNeighbours, next->count); ++i) {
      window[kNeighbours + count + i] = usable(range[i]);
      own[kNeighbours + count + i] = locate(*next, i, range[i], joints).own;
    }
  }
  filter_spurious(window, own, kNeighbours + count + kNeighbours, static_cast<std::uint32_t>(parameters_.spurious_range_mm));
  std::copy(window + kNeighbours, window + kNeighbours + count, kept);
}

ScanIntake::Located ScanIntake::locate(const berm_scan_packet& packet, int sample, std::uint32_t range_mm, const JointHistory& joints) const {
  Located located{};
  Eigen::Vector3d upper;
  if (range_mm == 0 || !projection_.in_upper_body(packet, sample, range_mm, upper)) return located;
  const JointAngles angles = joints.at(sample_time_us(packet, sample)).angles;
  located.own = self_.is_own(upper, angles) ? 1 : 0;
  located.found = ScanProjection::in_base(upper, angles.swing, located.point) && ScanProjection::in_base(projection_.head(packet.scanner), angles.swing, located.head) ? 1 : 0;
  return located;
}

void ScanIntake::insert(Line& line, const sk_point& point, std::int64_t now_us, sk_height_map& map) const {
  const sk_point& from = line.chained ? line.last : point;
  sk_raster_segment(&map, &from, &point, now_us, parameters_.generation_us);
  line.last = point;
  line.chained = true;
}

void ScanIntake::start_block(const Line& line, berm_scan_block& block) const {
  const berm_scan_packet& packet = line.packet;
  std::memset(&block, 0, sizeof block);
  block.scanner = packet.scanner;
  block.count = packet.count;
  block.scanline = packet.scanline;
  block.sample_period_ns = packet.sample_period_ns;
  block.time_us = static_cast<std::int64_t>(packet.time_us);
  block.pan_start_urad = packet.pan_start_urad;
  block.pan_end_urad = packet.pan_end_urad;
  block.first_index = packet.first_index;
  block.samples_per_revolution = packet.samples_per_revolution;
}

void ScanIntake::work_off(Line& line, const berm_scan_packet* next, const JointHistory& joints, std::int64_t now_us, sk_height_map& map, ScanBlocks& blocks) {
  line.waiting = false;
  // More packets than blocks in one cycle: the map gets them all the same, observers miss the oldest.
  berm_scan_block& block = blocks.block[blocks.count < ScanBlocks::kCapacity ? blocks.count++ : ScanBlocks::kCapacity - 1];
  start_block(line, block);
  last_echoes(line.packet, block.range_mm, block.echoes);
  const int count = line.packet.count;
  Located located[BERM_SCAN_PACKET_SAMPLES];
  for (int i = 0; i < count; ++i) located[i] = locate(line.packet, i, block.range_mm[i], joints);
  std::uint32_t kept[BERM_SCAN_PACKET_SAMPLES];
  filter(line, next, block.range_mm, located, joints, kept);
  for (int i = 0; i < kNeighbours; ++i) line.last_own[i] = count - kNeighbours + i >= 0 ? located[count - kNeighbours + i].own : 0;
  for (int i = 0; i < count; ++i) {
    const sk_point& point = located[i].point;
    if (located[i].found != 0) {
      block.point_mm[i][0] = point.x_mm;
      block.point_mm[i][1] = point.y_mm;
      block.point_mm[i][2] = point.z_mm;
    }
    if (located[i].found == 0 || located[i].own != 0 || kept[i] == 0) {
      if (located[i].found != 0 && located[i].own != 0) shadow_.keep(line.packet.scanner, located[i].head, point, now_us, map);
      line.chained = false;
      continue;
    }
    insert(line, point, now_us, map);
    shadow_.note_view(line.packet.scanner, point, now_us);
    block.used[i] = 1;
    ++points_;
  }
}

}  // namespace berm::kernel
