#include "gathering/cloud_store.hpp"

#include <algorithm>
#include <stdexcept>

namespace berm::app {
namespace {

std::size_t hash_of(const std::array<std::int32_t, 3>& key) {
  std::uint64_t h = static_cast<std::uint32_t>(key[0]) * 0x9E3779B97F4A7C15ULL;
  h = (h ^ h >> 29) + static_cast<std::uint32_t>(key[1]) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ h >> 31) + static_cast<std::uint32_t>(key[2]) * 0x94D049BB133111EBULL;
  return static_cast<std::size_t>(h ^ h >> 32);
}

}  // namespace

CloudStore::CloudStore(double voxel_m, std::size_t capacity) : voxel_(voxel_m), inverse_voxel_(1.0 / voxel_m), capacity_(capacity) {
  if (!(voxel_m >= 0.01) || capacity == 0 || capacity >= kNone)
    throw std::invalid_argument("cloud store: voxel of at least 0.01 m and 1 to 2^32 - 2 points");
  rehash(64);
}

std::size_t CloudStore::slot_of(const std::array<std::int32_t, 3>& key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(key) & mask;
  while (slots_[slot] != kNone && blocks_[slots_[slot]].key != key) slot = (slot + 1) & mask;
  return slot;
}

const CloudStore::Block* CloudStore::block(std::int32_t x, std::int32_t y, std::int32_t z) const {
  const std::uint32_t number = slots_[slot_of({x, y, z})];
  return number == kNone ? nullptr : &blocks_[number];
}

void CloudStore::rehash(std::size_t slots) {
  slots_.assign(slots, kNone);
  for (std::uint32_t number = 0; number < blocks_.size(); ++number) slots_[slot_of(blocks_[number].key)] = number;
}

std::uint32_t CloudStore::make_block(const std::array<std::int32_t, 3>& key) {
  const std::size_t slot = slot_of(key);
  if (slots_[slot] != kNone) return slots_[slot];
  const auto number = static_cast<std::uint32_t>(blocks_.size());
  Block fresh{key, 0, 0.0F, {}};
  fresh.first.fill(kNone);
  blocks_.push_back(fresh);
  slots_[slot] = number;
  if (blocks_.size() * 2 > slots_.size()) rehash(slots_.size() * 2);
  return number;
}

// The last block takes the place of the dropped one; slots close up behind it, so that no probe ends early.
void CloudStore::drop_block(std::uint32_t number) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t hole = slot_of(blocks_[number].key);
  for (std::size_t slot = (hole + 1) & mask; slots_[slot] != kNone; slot = (slot + 1) & mask) {
    const std::size_t home = hash_of(blocks_[slots_[slot]].key) & mask;
    if (((slot - home) & mask) < ((slot - hole) & mask)) continue;
    slots_[hole] = slots_[slot];
    hole = slot;
  }
  slots_[hole] = kNone;
  const auto last = static_cast<std::uint32_t>(blocks_.size() - 1);
  if (number != last) {
    slots_[slot_of(blocks_[last].key)] = number;
    blocks_[number] = blocks_[last];
  }
  blocks_.pop_back();
}

void CloudStore::link(std::uint32_t index) {
  GatheredPoint& p = points_[index];
  const std::int32_t x = voxel_of(static_cast<double>(p.x)), y = voxel_of(static_cast<double>(p.y)), z = voxel_of(static_cast<double>(p.z));
  Block& block = blocks_[make_block({x >> 2, y >> 2, z >> 2})];
  const auto voxel = static_cast<std::size_t>((z & 3) << 4 | (y & 3) << 2 | (x & 3));
  p.next = block.first[voxel];
  block.first[voxel] = index;
  block.occupied |= std::uint64_t{1} << voxel;
  block.widest = std::max(block.widest, static_cast<float>(largest_half_width(p.covariance, 1.0)));
}

void CloudStore::unlink(std::uint32_t index) {
  const GatheredPoint& p = points_[index];
  const std::int32_t x = voxel_of(static_cast<double>(p.x)), y = voxel_of(static_cast<double>(p.y)), z = voxel_of(static_cast<double>(p.z));
  const std::uint32_t number = slots_[slot_of({x >> 2, y >> 2, z >> 2})];
  Block& block = blocks_[number];
  const auto voxel = static_cast<std::size_t>((z & 3) << 4 | (y & 3) << 2 | (x & 3));
  std::uint32_t* at = &block.first[voxel];
  while (*at != index) at = &points_[*at].next;
  *at = p.next;
  if (block.first[voxel] != kNone) return;
  block.occupied &= ~(std::uint64_t{1} << voxel);
  if (block.occupied == 0) drop_block(number);
}

std::uint32_t CloudStore::insert(const GatheredPoint& point, std::uint32_t epoch) {
  if (size_ == capacity_) make_room();
  std::uint32_t index = free_;
  if (index != kNone) {
    free_ = points_[index].next;
    points_[index] = point;
    epochs_[index] = epoch;
  } else {
    index = static_cast<std::uint32_t>(points_.size());
    if (points_.size() == points_.capacity()) {
      const std::size_t wanted = std::min(capacity_, points_.size() + points_.size() / 2 + 1024);
      points_.reserve(wanted);
      epochs_.reserve(wanted);
    }
    points_.push_back(point);
    epochs_.push_back(epoch);
  }
  ++size_;
  link(index);
  return index;
}

void CloudStore::move(std::uint32_t index, const GatheredPoint& point, std::uint32_t epoch) {
  GatheredPoint& old = points_[index];
  epochs_[index] = epoch;
  const auto same = [this](float a, float b) { return voxel_of(static_cast<double>(a)) == voxel_of(static_cast<double>(b)); };
  const bool wider = largest_half_width(point.covariance, 1.0) > largest_half_width(old.covariance, 1.0);
  if (same(old.x, point.x) && same(old.y, point.y) && same(old.z, point.z) && !wider) {
    const std::uint32_t next = old.next;
    old = point;
    old.next = next;
    return;
  }
  unlink(index);
  points_[index] = point;
  link(index);
}

void CloudStore::remove(std::uint32_t index) {
  unlink(index);
  epochs_[index] = 0;
  points_[index].next = free_;
  free_ = index;
  --size_;
}

// A batch, so that the search for the lowest epoch costs a few comparisons an insertion.
void CloudStore::make_room() {
  std::size_t wanted = std::max<std::size_t>(1, capacity_ / 64);
  while (wanted > 0 && size_ > 0) {
    std::uint32_t lowest = kNone;
    for (const std::uint32_t epoch : epochs_) lowest = std::min(lowest, epoch - 1);  // of a free place the largest number
    for (std::uint32_t index = 0; index < epochs_.size() && wanted > 0; ++index) {
      if (epochs_[index] != lowest + 1) continue;
      remove(index);
      ++overflowed_;
      --wanted;
    }
  }
}

std::size_t CloudStore::bytes() const {
  return points_.capacity() * sizeof(GatheredPoint) + epochs_.capacity() * sizeof(std::uint32_t) + blocks_.capacity() * sizeof(Block) +
         slots_.capacity() * sizeof(std::uint32_t);
}

}  // namespace berm::app
