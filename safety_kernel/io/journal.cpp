#include "io/journal.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace berm::kernel {

namespace {

static_assert((BERM_JOURNAL_RING_BYTES & (BERM_JOURNAL_RING_BYTES - 1U)) == 0, "the ring's size is a power of two");
static_assert(BERM_JOURNAL_VLP16_BYTES == kVlp16PacketBytes && BERM_JOURNAL_MAP_ROWS == SK_MAP_CELLS, "the journal's layout is the kernel's");
static_assert(sizeof berm_journal_cycle::request == SK_REQUEST_BYTES, "a request fits");

constexpr std::uint64_t kMask = BERM_JOURNAL_RING_BYTES - 1U;
constexpr std::size_t up8(std::size_t bytes) { return (bytes + 7U) / 8U * 8U; }
constexpr std::size_t kVlp16Room = up8(BERM_JOURNAL_VLP16_BYTES);

// The largest record a cycle can make must fit several times, or a burst would always be lost.
constexpr std::size_t kScanMax = sizeof(berm_journal_scan) + BERM_SCAN_PACKET_SAMPLES * BERM_SCAN_ECHOES * 2;
constexpr std::size_t kRecordMax = sizeof(berm_journal_cycle) + (CycleInputs::kFrames + FrameList::kCapacity) * sizeof(berm_journal_frame) +
                                   CycleInputs::kPackets * kScanMax + (CycleInputs::kVlp16Packets + CycleInputs::kLidarPackets) * kVlp16Room;
static_assert(kRecordMax * 8 < BERM_JOURNAL_RING_BYTES, "the ring holds eight of the largest records");

std::size_t range_bytes(const berm_scan_packet& packet) { return static_cast<std::size_t>(packet.count) * packet.echoes_per_sample * 2U; }

std::size_t record_bytes(const CycleInputs& in, const CycleOutputs& out) {
  std::size_t bytes = sizeof(berm_journal_cycle) + static_cast<std::size_t>(in.frame_count + out.frames.count) * sizeof(berm_journal_frame);
  for (int i = 0; i < in.packet_count; ++i) bytes += sizeof(berm_journal_scan) + up8(range_bytes(in.packet[i]));
  return bytes + static_cast<std::size_t>(in.vlp16_count + in.lidar_count) * kVlp16Room;
}

constexpr std::uint64_t kHashStart = 14695981039346656037ULL, kHashPrime = 1099511628211ULL;
std::uint64_t hashed(std::uint64_t hash, std::uint64_t word) { return (hash ^ word) * kHashPrime; }

}  // namespace

std::uint64_t map_row_hash(const sk_height_map& map, int row) {
  std::uint64_t hash = kHashStart;
  for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
    const std::uint64_t heights = static_cast<std::uint32_t>(map.height_mm[row][ix]) | (static_cast<std::uint64_t>(static_cast<std::uint32_t>(map.previous_mm[row][ix])) << 32);
    hash = hashed(hash, heights);
    hash = hashed(hash, static_cast<std::uint64_t>(map.began_us[row][ix]));
    hash = hashed(hash, static_cast<std::uint64_t>(map.seen_us[row][ix]));
  }
  return hash;
}

int map_row_of(std::uint64_t cycle) { return static_cast<int>(cycle % SK_MAP_CELLS); }

bool Journal::create(const berm_parameters& parameters, bool map_only, const Vlp16Mount& mount, std::string& error) {
  if (!ring_.create("berm_journal_ring", BERM_JOURNAL_HEADER_BYTES + BERM_JOURNAL_RING_BYTES, SegmentAccess::kKernelWrites, error)) return false;
  if (!tail_.create("berm_journal_tail", sizeof(berm_journal_tail), SegmentAccess::kPeerWrites, error)) return false;
  header_ = static_cast<berm_journal_ring*>(ring_.memory());
  bytes_ = static_cast<std::uint8_t*>(ring_.memory()) + BERM_JOURNAL_HEADER_BYTES;
  header_->magic = BERM_JOURNAL_MAGIC;
  header_->size = BERM_JOURNAL_RING_BYTES;
  header_->header_bytes = BERM_JOURNAL_HEADER_BYTES;
  berm_journal_start& start = header_->start;
  start.version = BERM_JOURNAL_VERSION;
  start.contract_version = BERM_CONTRACT_VERSION;
  start.cell_mm = SK_CELL_MM;
  start.map_only = map_only ? 1U : 0U;
  start.parameter_bytes = sizeof parameters;
  start.mount[0] = mount.x_m;
  start.mount[1] = mount.y_m;
  start.mount[2] = mount.z_m;
  start.mount[3] = mount.yaw_rad;
  start.parameters = parameters;
  return true;
}

std::uint32_t Journal::lost_before() const { return static_cast<std::uint32_t>(std::min<std::uint64_t>(lost_, std::numeric_limits<std::uint32_t>::max())); }

// A tail ahead of the head, or behind by more than the ring holds, leaves no room. Any other only lets records be overwritten that the
// writer itself says it has read.
bool Journal::room(std::uint64_t bytes) const {
  const std::uint64_t tail = __atomic_load_n(&static_cast<const berm_journal_tail*>(tail_.view())->tail, __ATOMIC_ACQUIRE);
  const std::uint64_t used = head_ - tail;
  return used <= BERM_JOURNAL_RING_BYTES && bytes <= BERM_JOURNAL_RING_BYTES - used;
}

void Journal::put(const void* from, std::size_t count) {
  const std::size_t at = static_cast<std::size_t>(cursor_ & kMask);
  const std::size_t first = std::min<std::size_t>(count, BERM_JOURNAL_RING_BYTES - at);
  std::memcpy(bytes_ + at, from, first);
  std::memcpy(bytes_, static_cast<const std::uint8_t*>(from) + first, count - first);
  cursor_ += count;
}

void Journal::fill(std::size_t written) {
  static constexpr std::uint8_t zeros[8] = {};
  put(zeros, up8(written) - written);
}

void Journal::put_frame(const berm_can_frame& frame) {
  berm_journal_frame to{};
  to.id = frame.id;
  to.length = frame.length;
  std::copy(frame.data, frame.data + sizeof frame.data, to.data);
  put(&to, sizeof to);
}

void Journal::put_scan(const berm_scan_packet& packet) {
  berm_journal_scan to{};
  to.time_us = packet.time_us;
  to.sequence = packet.sequence;
  to.scanline = packet.scanline;
  to.sample_period_ns = packet.sample_period_ns;
  to.pan_start_urad = packet.pan_start_urad;
  to.pan_end_urad = packet.pan_end_urad;
  to.flags = packet.flags;
  to.first_index = packet.first_index;
  to.samples_per_revolution = packet.samples_per_revolution;
  to.count = packet.count;
  to.scanner = packet.scanner;
  to.echoes_per_sample = packet.echoes_per_sample;
  to.window_percent = packet.window_percent;
  put(&to, sizeof to);
  if (packet.echoes_per_sample == BERM_SCAN_ECHOES) {
    put(packet.range, range_bytes(packet));
  } else {
    for (int i = 0; i < packet.count; ++i) put(packet.range[i], packet.echoes_per_sample * sizeof packet.range[i][0]);
  }
  fill(range_bytes(packet));
}

void Journal::put_cycle(const CycleInputs& in, const CycleOutputs& out, const sk_height_map& map, std::uint32_t bytes) {
  berm_journal_cycle record{};
  record.magic = BERM_JOURNAL_RECORD_MAGIC;
  record.bytes = bytes;
  record.sequence = offered_;
  record.lost = lost_;
  record.cycle = in.cycle;
  record.now_us = in.now_us;
  record.flags = (in.clock_fault ? BERM_JOURNAL_CLOCK_FAULT : 0U) | (in.app_connected ? BERM_JOURNAL_APP_CONNECTED : 0U);
  record.app_connections = in.app_connections;
  record.frames_in = static_cast<std::uint16_t>(in.frame_count);
  record.frames_out = static_cast<std::uint16_t>(out.frames.count);
  record.scan_packets = static_cast<std::uint16_t>(in.packet_count);
  record.vlp16_packets = static_cast<std::uint16_t>(in.vlp16_count);
  record.lidar_packets = static_cast<std::uint16_t>(in.lidar_count);
  record.map_row_hash = map_row_hash(map, map_row_of(in.cycle));
  std::copy(in.request, in.request + sizeof in.request, record.request);
  record.state = out.state;
  record.state.cycle_cpu_us = 0;
  record.decision = out.decision;
  put(&record, sizeof record);
}

void Journal::offer(const CycleInputs& in, const CycleOutputs& out, const sk_height_map& map, bool readable) {
  if (header_ == nullptr) return;
  const std::size_t bytes = record_bytes(in, out);
  if (readable && room(bytes)) {
    cursor_ = head_;
    put_cycle(in, out, map, static_cast<std::uint32_t>(bytes));
    for (int i = 0; i < in.frame_count; ++i) put_frame(in.frame[i]);
    for (int i = 0; i < out.frames.count; ++i) put_frame(out.frames.frame[i]);
    for (int i = 0; i < in.packet_count; ++i) put_scan(in.packet[i]);
    for (int i = 0; i < in.vlp16_count; ++i) {
      put(in.vlp16[i], kVlp16PacketBytes);
      fill(kVlp16PacketBytes);
    }
    for (int i = 0; i < in.lidar_count; ++i) {
      put(in.lidar[i].bytes, kVlp16PacketBytes);
      put(&in.lidar[i].lidar, 1);
      fill(kVlp16PacketBytes + 1);
    }
    head_ = cursor_;
  } else {
    ++lost_;
  }
  ++offered_;
  __atomic_store_n(&header_->lost, lost_, __ATOMIC_RELAXED);
  __atomic_store_n(&header_->offered, offered_, __ATOMIC_RELAXED);
  __atomic_store_n(&header_->head, head_, __ATOMIC_RELEASE);
}

}  // namespace berm::kernel
