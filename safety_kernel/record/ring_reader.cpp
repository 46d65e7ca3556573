#include "record/ring_reader.hpp"

#include <algorithm>
#include <cstring>

namespace berm::record {

RingReader::RingReader(const berm_journal_ring& ring, berm_journal_tail& tail)
    : ring_(ring), tail_(tail), bytes_(reinterpret_cast<const std::uint8_t*>(&ring) + ring.header_bytes), size_(ring.size), at_(tail.tail) {
  const std::uint64_t head = __atomic_load_n(&ring_.head, __ATOMIC_ACQUIRE);
  if (head - at_ > size_) at_ = head;
}

void RingReader::copy(std::uint64_t from, void* to, std::size_t count) const {
  const std::size_t at = static_cast<std::size_t>(from & (size_ - 1));
  const std::size_t first = std::min<std::size_t>(count, static_cast<std::size_t>(size_) - at);
  std::memcpy(to, bytes_ + at, first);
  std::memcpy(static_cast<std::uint8_t*>(to) + first, bytes_, count - first);
}

RingReader::Result RingReader::next(std::vector<std::uint8_t>& record) {
  const std::uint64_t ready = __atomic_load_n(&ring_.head, __ATOMIC_ACQUIRE) - at_;
  if (ready == 0) return Result::kNothing;
  struct {
    std::uint32_t magic, bytes;
  } begin{};
  if (ready > size_ || ready < sizeof(berm_journal_cycle)) return Result::kBroken;
  copy(at_, &begin, sizeof begin);
  if (begin.magic != BERM_JOURNAL_RECORD_MAGIC || begin.bytes > ready || begin.bytes < sizeof(berm_journal_cycle)) return Result::kBroken;
  record.resize(begin.bytes);
  copy(at_, record.data(), record.size());
  at_ += begin.bytes;
  __atomic_store_n(&tail_.tail, at_, __ATOMIC_RELEASE);
  return Result::kRecord;
}

}  // namespace berm::record
