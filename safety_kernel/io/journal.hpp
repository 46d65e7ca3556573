// The kernel's end of the journal: one record a cycle into a bounded ring that only the kernel writes. It never waits: no room, or no writer
// any more, and the record is dropped and counted. What the writer says about how far it has read is not believed beyond "is there room".
#pragma once

#include <cstdint>
#include <string>

#include "io/cycle.hpp"
#include "io/shared_memory.hpp"
#include "journal/journal_record.h"

namespace berm::kernel {

// Hash of one row of the map (FNV-1a over its 64-bit words), as JOURNAL.md has it. row below SK_MAP_CELLS.
std::uint64_t map_row_hash(const sk_height_map& map, int row);
// The row whose hash goes with this cycle: the whole map within 104 cycles.
int map_row_of(std::uint64_t cycle);

class Journal {
 public:
  // Both segments, and the start conditions in the ring's header. Until then everything below does nothing.
  bool create(const berm_parameters& parameters, bool map_only, const Vlp16Mount& mount, std::string& error);

  const SharedSegment& ring() const { return ring_; }
  const SharedSegment& tail() const { return tail_; }

  // After a cycle: one record of it, or one more lost. readable: whether anyone reads, or may still come to read. Bounded, no allocation.
  void offer(const CycleInputs& in, const CycleOutputs& out, const sk_height_map& map, bool readable);

  std::uint64_t offered() const { return offered_; }
  std::uint64_t lost() const { return lost_; }
  std::uint32_t lost_before() const;  // for the published state: stays at the largest number

 private:
  bool room(std::uint64_t bytes) const;
  void put(const void* bytes, std::size_t count);
  void fill(std::size_t written);
  void put_frame(const berm_can_frame& frame);
  void put_scan(const berm_scan_packet& packet);
  void put_cycle(const CycleInputs& in, const CycleOutputs& out, const sk_height_map& map, std::uint32_t bytes);

  SharedSegment ring_;
  SharedSegment tail_;
  berm_journal_ring* header_ = nullptr;
  std::uint8_t* bytes_ = nullptr;
  std::uint64_t head_ = 0;     // private: what is in the segment is a copy
  std::uint64_t cursor_ = 0;   // head_ and what of the record is there already
  std::uint64_t offered_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace berm::kernel
