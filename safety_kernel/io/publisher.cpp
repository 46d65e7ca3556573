#include "io/publisher.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>

#include "io/own_cells.hpp"

namespace berm::kernel {

namespace {

static_assert(BERM_MAP_CELLS == SK_MAP_CELLS, "the published map is the kernel's");
static_assert(SK_SLICE_VERTICES == BERM_SLICE_VERTICES, "published slices hold every vertex");
static_assert(BERM_SCAN_BLOCK_SAMPLES == BERM_SCAN_PACKET_SAMPLES, "a block holds a packet");

// Writer's side of a sequence lock: odd while the protected bytes change.
class WriteLock {
 public:
  explicit WriteLock(std::uint32_t& guard) : guard_(guard), value_(guard) {
    __atomic_store_n(&guard_, value_ + 1U, __ATOMIC_RELAXED);
    __atomic_thread_fence(__ATOMIC_RELEASE);
  }
  ~WriteLock() { __atomic_store_n(&guard_, value_ + 2U, __ATOMIC_RELEASE); }
  WriteLock(const WriteLock&) = delete;
  WriteLock& operator=(const WriteLock&) = delete;

 private:
  std::uint32_t& guard_;
  std::uint32_t value_;
};

}  // namespace

Publisher::Publisher(berm_state_segment& segment, const berm_parameters& parameters, bool own_body)
    : segment_(segment), parameters_(parameters), own_cells_radius_mm_(own_body ? own_and_rim_radius_mm(parameters) : 0) {
  segment_.magic = BERM_CONTRACT_MAGIC;
  segment_.version = BERM_CONTRACT_VERSION;
  segment_.size = sizeof(berm_state_segment);
  segment_.cell_mm = SK_CELL_MM;
  segment_.map_origin_mm = SK_MAP_ORIGIN_MM;
  segment_.parameter_crc32 = static_cast<std::uint32_t>(parameters.crc32);
  segment_.kernel_pid = static_cast<std::uint32_t>(getpid());
}

void Publisher::state(const berm_state& state) {
  const WriteLock lock(segment_.state_guard);
  std::memcpy(&segment_.state, &state, sizeof state);
}

void Publisher::decision(const berm_decision& decision) {
  const std::uint32_t head = segment_.decision_head;
  std::memcpy(&segment_.decision[head % BERM_DECISION_RING], &decision, sizeof decision);
  __atomic_store_n(&segment_.decision_head, head + 1U, __ATOMIC_RELEASE);
}

void Publisher::scans(const ScanBlocks& blocks) {
  constexpr std::size_t head_bytes = sizeof(berm_scan_block::sequence);
  for (int i = 0; i < blocks.count; ++i) {
    const std::uint32_t head = segment_.scan_head;
    berm_scan_block& to = segment_.scan[head % BERM_SCAN_RING];
    to.sequence = 2U * head;
    {
      const WriteLock lock(to.sequence);
      std::memcpy(reinterpret_cast<char*>(&to) + head_bytes, reinterpret_cast<const char*>(&blocks.block[i]) + head_bytes, sizeof to - head_bytes);
    }
    __atomic_store_n(&segment_.scan_head, head + 1U, __ATOMIC_RELEASE);
  }
}

void Publisher::slices(const SliceSet& slices) {
  const WriteLock lock(segment_.slice_guard);
  const int count = std::min(slices.count, BERM_SLICE_SNAPSHOT);
  segment_.slice_count = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count; ++i) {
    const sk_slice& from = slices.slice[i];
    berm_slice& to = segment_.slice[i];
    to.link = static_cast<std::uint32_t>(from.link);
    to.vertices = static_cast<std::uint32_t>(from.vertices);
    for (int v = 0; v < SK_SLICE_VERTICES; ++v)
      for (int axis = 0; axis < 3; ++axis) to.vertex_mm[v][axis] = from.xyz_mm[axis][v];
  }
}

std::uint8_t Publisher::status(const sk_height_map& map, int iy, int ix, std::int64_t now_us) const {
  const auto far_edge = [](int i) {
    const std::int64_t low = SK_MAP_ORIGIN_MM + static_cast<std::int64_t>(i) * SK_CELL_MM;
    return std::max(std::llabs(low), std::llabs(low + SK_CELL_MM));
  };
  const std::int64_t x = far_edge(ix), y = far_edge(iy);
  if (x * x + y * y <= own_cells_radius_mm_ * own_cells_radius_mm_) return BERM_CELL_OWN_BODY;
  if (map.seen_us[iy][ix] < 0) return BERM_CELL_UNKNOWN;
  return now_us - map.seen_us[iy][ix] > parameters_.fresh_us ? BERM_CELL_STALE : BERM_CELL_OBSERVED;
}

void Publisher::map_rows(const sk_height_map& map, std::int64_t now_us) {
  for (int row = 0; row < kMapRows; ++row) {
    for (int ix = 0; ix < SK_MAP_CELLS; ++ix) {
      const std::uint8_t kind = status(map, next_row_, ix, now_us);
      const bool measured = kind == BERM_CELL_OBSERVED || kind == BERM_CELL_STALE;
      segment_.map_height_mm[next_row_][ix] = measured ? sk_map_top(&map, next_row_, ix) : 0;
      segment_.map_status[next_row_][ix] = kind;
    }
    next_row_ = (next_row_ + 1) % SK_MAP_CELLS;
  }
}

void Publisher::wake() {
  __atomic_fetch_add(&segment_.wake, 1U, __ATOMIC_RELEASE);
  syscall(SYS_futex, &segment_.wake, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace berm::kernel
