// The writer's end of the ring: whole records in order, each released to the kernel once it was copied.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "journal/journal_record.h"

namespace berm::record {

class RingReader {
 public:
  enum class Result { kRecord, kNothing, kBroken };
  // ring: the whole ring segment. Starts where the writer before left off, or at the head when its tail is not one.
  RingReader(const berm_journal_ring& ring, berm_journal_tail& tail);

  Result next(std::vector<std::uint8_t>& record);

  // As the kernel counts them; complete once the kernel has ended and next() says kNothing.
  std::uint64_t offered() const { return __atomic_load_n(&ring_.offered, __ATOMIC_ACQUIRE); }

 private:
  void copy(std::uint64_t from, void* to, std::size_t count) const;

  const berm_journal_ring& ring_;
  berm_journal_tail& tail_;
  const std::uint8_t* bytes_;
  std::uint64_t size_;
  std::uint64_t at_;
};

}  // namespace berm::record
